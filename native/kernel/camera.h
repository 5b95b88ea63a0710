/// Camera rays and the first stage of the wavefront.
#pragma once

#include "kernel/path_queues.h"

namespace trg {

/// The ray through (x, y) in pixels of the whole picture. Its t is the depth along the camera's -Z.
TRG_FN Ray make_camera_ray(const RenderView& view, float x, float y) {
    const CameraView& c = view.scene.camera;
    const float sx = c.left + (c.right - c.left) * (x / static_cast<float>(view.width));
    const float sy = c.bottom + (c.top - c.bottom) * (y / static_cast<float>(view.height));
    const Vec3 across = c.axis_x * sx + c.axis_y * sy;
    Ray ray;
    ray.origin = c.perspective ? c.origin : c.origin + across;
    ray.direction = c.perspective ? across - c.axis_z : -c.axis_z;
    ray.t_min = c.clip_start;
    ray.t_max = c.clip_end;
    return ray;
}

/// Starts the paths of `chunk`; returns how many.
TRG_FN int32_t generate_paths(const RenderView& view, const Chunk& chunk, PathQueues& queues) {
    const int32_t count = chunk.pixel_count * chunk.samples;
    for (int32_t i = 0; i < count; ++i) {
        const Pixel pixel = chunk.pixels[i / chunk.samples];
        const uint32_t sample = chunk.first_sample + static_cast<uint32_t>(i % chunk.samples);
        const SampleKey key = make_sample_key(static_cast<uint32_t>(pixel.x),
                                              static_cast<uint32_t>(pixel.y), sample, view.seed);
        const Sample2 uv = sample_uniform2(key, kPixelDimension);
        queues.keys[i] = key;
        queues.rays[i] = make_camera_ray(view, static_cast<float>(pixel.x) + uv.u,
                                         static_cast<float>(pixel.y) + uv.v);
        queues.states[i] = {{1.0f, 1.0f, 1.0f}, 0.0f, i};
        queues.results[i] = {{0.0f, 0.0f, 0.0f}, {0.0f, 0.0f, 0.0f}, false};
    }
    return count;
}

}  // namespace trg
