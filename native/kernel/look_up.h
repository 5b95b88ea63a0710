/// Values of textures at a surface point: images directly, programs with all that they may ask.
#pragma once

#include "kernel/shape_surface.h"
#include "shade/texture_program.h"

namespace trg {

/// A surface point and who looks at it; what programs need is filled in for the first of them.
struct LookUp {
    const SceneView& scene;
    const Surface& surface;
    Vec3 wo;
    bool ready;
    TexturePoint point;
    Instance moved;  // of one that moves
};

/// A step for bumps: about a pixel as the camera would see the point, and no finer than rounding
/// allows.
TRG_FN float bump_step(const SceneView& scene, Vec3 position) {
    const Vec3 to = position - scene.camera.pose.origin;
    const float distance = scene.camera.kind != CameraKind::orthographic ? length(to) : 1.0f;
    const float size = max_component(absolute(position));
    return larger(scene.pixel_spread * distance, 2e-4f * size + 1e-9f);
}

TRG_FN void set_normals(const SceneView& scene, const Surface& s, Vec3 wo, TexturePoint* p) {
    const float facing = dot(s.outside, wo);
    p->outside = facing >= 0.0f;
    p->flat = p->outside ? s.outside : -s.outside;
    const Vec3 smooth = smooth_normal(scene, s);
    const Vec3 turned = p->outside ? smooth : -smooth;
    p->normal = is_black(turned) ? p->flat : turned;
}

TRG_RARE_FN void fill_point(LookUp* look) {
    const SceneView& scene = look->scene;
    const Surface& s = look->surface;
    Instance& moved = look->moved;
    const Instance& instance = instance_at(scene, s.at.instance, s.time, &moved);
    TexturePoint& p = look->point;
    p.position = s.position;
    p.wo = look->wo;
    set_normals(scene, s, look->wo, &p);
    p.u = s.u;
    p.v = s.v;
    p.mesh = &scene.texture_meshes[instance.mesh];
    p.instance = &instance;
    p.triangle = s.at.triangle;
    p.b1 = s.b1;
    p.b2 = s.b2;
    p.random = scene.randoms ? scene.randoms[s.at.instance] : 0.0f;
    p.step = bump_step(scene, s.position);
    p.edge1 = p.edge2 = {0.0f, 0.0f, 0.0f};
    if (p.mesh->shape != Shape::triangles) {
        p.local = transform_point(instance.world_to_object, s.position);
    } else {
        const Corners c = triangle_corners(scene.meshes[instance.mesh], s.at.triangle);
        p.local = c.p0 + (c.e1 * s.b1 + c.e2 * s.b2);
        p.edge1 = transform_vector(instance.object_to_world, c.e1);
        p.edge2 = transform_vector(instance.object_to_world, c.e2);
    }
    look->ready = true;
}

/// The texture coordinates that a plain image asks for.
TRG_FN Vec3 place_of(LookUp* look, const Texture& texture) {
    const Surface& s = look->surface;
    if (texture.uv_map == 0) return {s.u, s.v, 0.0f};
    if (!look->ready) fill_point(look);
    float place[4];
    eval_attribute(look->point, texture.uv_map, place);
    return {place[0], place[1], 0.0f};
}

/// Value of texture number `index`.
template <uint32_t F>
TRG_FN Vec3 look_up(LookUp* look, int32_t index) {
    const TextureSet& set = look->scene.textures;
    const Texture& texture = set.textures[index];
    if constexpr (has(F, kPrograms)) {
        if (texture.program >= 0) {
            if (!look->ready) fill_point(look);
            return eval_program(set, texture.program, look->point);
        }
        const Vec3 place = place_of(look, texture);
        return eval_texture(set.images, texture, place.x, place.y);
    }
    return eval_texture(set.images, texture, look->surface.u, look->surface.v);
}

}  // namespace trg
