/// Camera rays and the first stage of the wavefront.
#pragma once

#include "kernel/antialiasing.h"
#include "kernel/path_queues.h"

namespace trg {

/// A point of the aperture, even by area: a disc or a regular polygon with corners on its rim.
TRG_FN Vec3 sample_aperture(const CameraView& c, Sample2 uv) {
    float x, y;
    if (c.blades < 3) {
        sample_disc(uv.u, uv.v, &x, &y);
    } else {
        const float blades = static_cast<float>(c.blades), scaled = uv.u * blades;
        const float blade = std::floor(scaled);
        const float outwards = std::sqrt(scaled - blade), half = kPi / blades;
        const float along = outwards * std::cos(half);
        const float aside = outwards * std::sin(half) * (2.0f * uv.v - 1.0f);
        const float turn = c.blade_turn + 2.0f * half * blade;
        x = along * std::cos(turn) - aside * std::sin(turn);
        y = along * std::sin(turn) + aside * std::cos(turn);
    }
    return c.pose.axis_x * (x * c.aperture * c.squeeze) + c.pose.axis_y * (y * c.aperture);
}

/// Unit direction of longitude `x` to the right and latitude `y`.
TRG_FN Vec3 panorama_direction(const CameraView& c, float x, float y) {
    const float rim = std::cos(y);
    return c.pose.axis_x * (rim * std::sin(x)) + c.pose.axis_y * std::sin(y) -
           c.pose.axis_z * (rim * std::cos(x));
}

/// The ray through (x, y) in pixels of the whole picture, its lens point drawn by `lens`. Its t is
/// the depth along the camera's -Z, of a panorama the distance.
TRG_FN Ray make_camera_ray(const RenderView& view, float x, float y, Sample2 lens) {
    const CameraView& c = view.scene.camera;
    const float sx = c.left + (c.right - c.left) * (x / static_cast<float>(view.width));
    const float sy = c.bottom + (c.top - c.bottom) * (y / static_cast<float>(view.height));
    const bool perspective = c.kind == CameraKind::perspective;
    const Vec3 across = c.pose.axis_x * sx + c.pose.axis_y * sy;
    Ray ray;
    ray.origin = c.kind == CameraKind::orthographic ? c.pose.origin + across : c.pose.origin;
    ray.direction = perspective ? across - c.pose.axis_z : -c.pose.axis_z;
    if (c.kind == CameraKind::panorama) ray.direction = panorama_direction(c, sx, sy);
    ray.t_min = c.clip_start;
    ray.t_max = c.clip_end;
    if (c.aperture > 0.0f) {
        const Vec3 off = sample_aperture(c, lens);
        ray.origin = ray.origin + off;
        ray.direction = ray.direction - off * (1.0f / c.focus);
    }
    return ray;
}

/// The middle of the aperture: blades apart, both numbers are the disc's centre.
TRG_FN Ray make_camera_ray(const RenderView& view, float x, float y) {
    RenderView sharp = view;
    sharp.scene.camera.aperture = 0.0f;
    return make_camera_ray(sharp, x, y, {0.5f, 0.5f});
}

TRG_FN CameraPose pose_at(const CameraPose& a, const CameraPose& b, float part) {
    return {point_at(a.axis_x, b.axis_x, part), point_at(a.axis_y, b.axis_y, part),
            point_at(a.axis_z, b.axis_z, part), point_at(a.origin, b.origin, part)};
}

/// The view from where a camera that moves is at `time`.
TRG_FN RenderView view_at(const RenderView& view, float time) {
    const SceneView& scene = view.scene;
    RenderView moved = view;
    const MotionStep at = motion_step(scene.camera_key_count, time);
    const CameraPose* key = scene.camera_keys + at.key;
    moved.scene.camera.pose = pose_at(key[0], key[1], at.part);
    return moved;
}

/// Where in or about a pixel `u` of the filter falls, from its lower edge.
TRG_FN float filter_place(const RenderView& view, float u) {
    if (!view.scene.filter) return u;
    const float place = u * kFilterSteps;
    const int32_t step = static_cast<int32_t>(place);
    const float part = place - static_cast<float>(step);
    return 0.5f + view.scene.filter[step] * (1.0f - part) + view.scene.filter[step + 1] * part;
}

/// A sample of a pixel, with two even numbers for its place there.
struct PathStart {
    Pixel pixel;
    uint32_t sample;
    SampleKey key;
    Sample2 even;
};

/// Starts path `i`.
TRG_FN void start_path(const RenderView& view, const PathStart& start, PathQueues& queues,
                       int32_t i) {
    const SampleKey key = start.key;
    const Sample2 uv = place_in_pixel(view.scene.antialiasing, key, start.sample, start.even);
    queues.keys[i] = key;
    const Sample2 lens = view.scene.camera.aperture > 0.0f ? sample_uniform2(key, kLensDimension)
                                                           : Sample2{0.5f, 0.5f};
    const float x = static_cast<float>(start.pixel.x) + filter_place(view, uv.u);
    const float y = static_cast<float>(start.pixel.y) + filter_place(view, uv.v);
    if (view.scene.timed) queues.times[i] = sample_uniform2(key, kTimeDimension).u;
    queues.rays[i] = view.scene.camera_key_count > 0
                         ? make_camera_ray(view_at(view, queues.times[i]), x, y, lens)
                         : make_camera_ray(view, x, y, lens);
    queues.states[i] = {{1.0f, 1.0f, 1.0f}, 0.0f, i};
    queues.media[i].count = 0;
    queues.results[i] = {{0.0f, 0.0f, 0.0f}, {0.0f, 0.0f, 0.0f}, false};
}

/// Starts the paths of `chunk`; returns how many.
TRG_FN int32_t generate_paths(const RenderView& view, const Chunk& chunk, PathQueues& queues) {
    int32_t i = 0;
    for (int32_t p = 0; p < chunk.pixel_count; ++p) {
        const Pixel pixel = chunk.pixels[p];
        for (int32_t first = 0; first < chunk.samples; first += kSampleLanes) {
            const uint32_t sample = chunk.first_sample + static_cast<uint32_t>(first);
            KeyBlock block;
            draw_keys(
                {static_cast<uint32_t>(pixel.x), static_cast<uint32_t>(pixel.y), sample, view.seed},
                kPixelDimension, &block);
            for (int k = 0; k < kSampleLanes && first + k < chunk.samples; ++k)
                start_path(view,
                           {pixel,
                            sample + static_cast<uint32_t>(k),
                            {block.stream[k], block.reversed_index[k]},
                            {block.u[k], block.v[k]}},
                           queues, i++);
        }
    }
    return i;
}

}  // namespace trg
