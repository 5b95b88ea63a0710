/// Where on its surface a texture point lies, in every system of coordinates, and how it moves.
#pragma once

#include "geom/shapes.h"
#include "shade/texture_set.h"

namespace trg {

/// Interpolated values of a corner attribute; (0, 0, 0, 1) where the mesh has none.
TRG_FN void eval_attribute(const TexturePoint& p, int32_t number, float* out) {
    for (int k = 0; k < 4; ++k) out[k] = k == 3 ? 1.0f : 0.0f;
    if (number == 0) {
        out[0] = p.u;
        out[1] = p.v;
        return;
    }
    if (number >= p.mesh->attribute_count || !p.mesh->attributes[number].values) return;
    const CornerView& view = p.mesh->attributes[number];
    const float* corner = view.values + static_cast<int64_t>(p.triangle) * 3 * view.width;
    const float b0 = 1.0f - p.b1 - p.b2;
    for (int k = 0; k < view.width; ++k)
        out[k] = b0 * corner[k] + p.b1 * corner[view.width + k] + p.b2 * corner[2 * view.width + k];
}

TRG_FN Vec3 generated_place(const TexturePoint& p) {
    return p.local * p.mesh->space_scale + p.mesh->space_offset;
}

/// A world normal in the object's space, unit.
TRG_FN Vec3 normal_into(const Instance& instance, Vec3 n) {
    return normalize_safe(transform_transposed(instance.object_to_world, n));
}
/// An object's normal in the world, unit.
TRG_FN Vec3 normal_out_of(const Instance& instance, Vec3 n) {
    return normalize_safe(transform_transposed(instance.world_to_object, n));
}

/// Texture coordinates of a place on a shape.
TRG_FN void set_shape_coordinates(TexturePoint* p) {
    if (p->mesh->shape == Shape::plane) {
        p->u = p->local.x;
        p->v = p->local.y;
        return;
    }
    const ShapeCoordinates c = sphere_coordinates(to_double(p->local));
    p->u = static_cast<float>(c.u);
    p->v = static_cast<float>(c.v);
}

/// `p` moved by `by`, a small vector of the world along the surface. `corner_uvs` are the texture
/// coordinates that u and v come from; attributes follow by their barycentrics.
TRG_FN TexturePoint move_point(const TexturePoint& p, Vec3 by) {
    TexturePoint moved = p;
    moved.position = p.position + by;
    moved.local = p.local + transform_vector(p.instance->world_to_object, by);
    if (p.mesh->shape != Shape::triangles) {
        set_shape_coordinates(&moved);
        return moved;
    }
    const float aa = dot(p.edge1, p.edge1), ab = dot(p.edge1, p.edge2), bb = dot(p.edge2, p.edge2);
    const float det = aa * bb - ab * ab, a = dot(by, p.edge1), b = dot(by, p.edge2);
    if (!(det > 0.0f)) return moved;
    const float d1 = (a * bb - b * ab) / det, d2 = (b * aa - a * ab) / det;
    moved.b1 += d1;
    moved.b2 += d2;
    if (const float* uv = p.mesh->attribute_count > 0 ? p.mesh->attributes[0].values : nullptr) {
        uv += static_cast<int64_t>(p.triangle) * 6;
        moved.u += d1 * (uv[2] - uv[0]) + d2 * (uv[4] - uv[0]);
        moved.v += d1 * (uv[3] - uv[1]) + d2 * (uv[5] - uv[1]);
    }
    return moved;
}

/// Box projection's weights of the three axes for the object normal `n` (blend 0: one of them).
TRG_FN Vec3 box_weights(Vec3 n, float blend) {
    const Vec3 a = absolute(n);
    const float limit = 0.5f * (1.0f + blend);
    if (a.x > limit * (a.x + a.y) && a.x > limit * (a.x + a.z)) return {1.0f, 0.0f, 0.0f};
    if (a.y > limit * (a.x + a.y) && a.y > limit * (a.y + a.z)) return {0.0f, 1.0f, 0.0f};
    if (a.z > limit * (a.x + a.z) && a.z > limit * (a.y + a.z)) return {0.0f, 0.0f, 1.0f};
    if (!(blend > 0.0f)) return {1.0f, 0.0f, 0.0f};
    const auto share = [blend](float one, float two) {
        return clamp01((one / (one + two) - 0.5f * (1.0f - blend)) / blend);
    };
    if (a.z < (1.0f - limit) * (a.y + a.x)) {
        const float x = share(a.x, a.y);
        return {x, 1.0f - x, 0.0f};
    }
    if (a.x < (1.0f - limit) * (a.y + a.z)) {
        const float y = share(a.y, a.z);
        return {0.0f, y, 1.0f - y};
    }
    if (a.y < (1.0f - limit) * (a.x + a.z)) {
        const float x = share(a.x, a.z);
        return {x, 0.0f, 1.0f - x};
    }
    const float sum = a.x + a.y + a.z, scale = 1.0f / (2.0f * limit - 1.0f);
    const auto mid = [&](float w) { return ((2.0f - limit) * w / sum + limit - 1.0f) * scale; };
    return {mid(a.x), mid(a.y), mid(a.z)};
}

/// Sphere (mode 0) or tube (mode 1) projection of a place in the unit cube.
TRG_FN Vec3 project_place(Vec3 at, int32_t mode) {
    const Vec3 p{at.x * 2.0f - 1.0f, at.y * 2.0f - 1.0f, at.z * 2.0f - 1.0f};
    const float across = std::sqrt(p.x * p.x + p.y * p.y);
    constexpr float kTurn = 2.0f * kPi;
    if (mode == 1) {
        if (!(across > 0.0f)) return {0.0f, 0.0f, 0.0f};
        return {0.5f * (1.0f - std::atan2(p.x / across, p.y / across) * kInvPi),
                0.5f * (p.z + 1.0f), 0.0f};
    }
    const float size = length(p);
    if (!(size > 0.0f)) return {0.0f, 0.0f, 0.0f};
    const float u = across > 0.0f ? 0.5f - std::atan2(p.x, p.y) / kTurn : 0.0f;
    return {u, 1.0f - std::acos(smaller(larger(p.z / size, -1.0f), 1.0f)) * kInvPi, 0.0f};
}

}  // namespace trg
