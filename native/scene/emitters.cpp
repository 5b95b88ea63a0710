#include "scene/emitters.h"

#include <algorithm>
#include <numeric>

#include "kernel/path_queues.h"
#include "kernel/surface.h"

namespace trg {

namespace {

std::vector<uint32_t> cumulate(const std::vector<double>& weights) {
    std::vector<uint32_t> limits(weights.size());
    cumulate_shares(weights.data(), weights.size(), limits.data());
    return limits;
}

void corners_of(const Scene& scene, const EmissiveTriangle& at, Vec3 p[3]) {
    const Instance& instance = scene.world.instances[at.instance];
    const Mesh& mesh = scene.world.meshes[instance.mesh];
    const Triangle& t = mesh.triangles[at.triangle];
    for (int k = 0; k < 3; ++k)
        p[k] = transform_point(instance.object_to_world, mesh.vertices[t.vertex[k]]);
}

double world_area(const Scene& scene, const EmissiveTriangle& at) {
    Vec3 p[3];
    corners_of(scene, at, p);
    const Vec3d n = cross(to_double(p[1]) - to_double(p[0]), to_double(p[2]) - to_double(p[0]));
    const double area = 0.5 * std::sqrt(dot(n, n));
    return std::isfinite(area) ? area : 0.0;
}

/// Of a sphere, that of one as large that was not stretched; the kernel sets it right point by
/// point.
double sphere_area(const Instance& instance) {
    const double radius = std::cbrt(std::fabs(determinant(instance.object_to_world)));
    return 4.0 * kPi * radius * radius;
}

bool any_slot_emits(const Scene& scene, int32_t instance) {
    const int64_t first = scene.first_slot[instance];
    if (scene.slot_count[instance] == 0) return scene.tables.materials[0].emission_weight > 0.0f;
    for (int32_t k = 0; k < scene.slot_count[instance]; ++k)
        if (scene.tables.materials[scene.slot_materials[first + k]].emission_weight > 0.0f)
            return true;
    return false;
}

int32_t material_index(const Scene& scene, const EmissiveTriangle& at) {
    const int32_t count = scene.slot_count[at.instance];
    if (count == 0) return 0;
    const std::vector<int32_t>& slots =
        scene.attributes[scene.world.instances[at.instance].mesh].slots;
    const int32_t slot = slots.empty() ? 0 : slots[at.triangle];
    return scene.slot_materials[scene.first_slot[at.instance] + std::min(slot, count - 1)];
}

/// Fills in the emissive triangles; returns the area times luminance of each.
std::vector<double> gather_triangles(const Scene& scene, EmitterTables* tables) {
    std::vector<double> weights;
    for (size_t i = 0; i < scene.world.instances.size(); ++i) {
        if (!any_slot_emits(scene, static_cast<int32_t>(i))) continue;
        const Instance& instance = scene.world.instances[i];
        const Mesh& mesh = scene.world.meshes[instance.mesh];
        if (mesh.shape == Shape::plane) tables->endless = true;
        const bool sphere = mesh.shape == Shape::sphere;
        const size_t count = sphere ? 1 : mesh.triangles.size();
        for (size_t t = 0; t < count; ++t) {
            const EmissiveTriangle at{static_cast<int32_t>(i), static_cast<int32_t>(t)};
            const double weight =
                scene.tables.materials[material_index(scene, at)].emission_weight *
                (sphere ? sphere_area(instance) : world_area(scene, at));
            if (!(weight > 0.0)) continue;
            tables->triangles.push_back(at);
            weights.push_back(weight);
        }
    }
    return weights;
}

Vec3 absolute_axes(Vec3 a, Vec3 b) {
    return absolute(a) + absolute(b);
}

/// A light for the tree; false for those that stay in the list.
bool bounds_light(const Light& light, int32_t index, EmitterBounds* e) {
    const double brightness = std::fabs(luminance(light.color));
    Vec3 half{light.radius, light.radius, light.radius};
    *e = {light.position, light.position, {0.0f, 0.0f, 1.0f}, kPi,
          0.5f * kPi,     false,          brightness,         index};
    switch (light.kind) {
        case LightKind::sun:
            return false;
        case LightKind::point:
        case LightKind::spot:
            if (!light.inverse_square) return false;
            if (light.extended)
                e->power *= kPi * light.radius * light.radius;
            else
                half = {0.0f, 0.0f, 0.0f};
            if (light.kind == LightKind::point) break;
            e->axis = light.direction;
            e->spread = 0.0f;
            e->reach = std::acos(std::clamp(light.cos_outer, -1.0f, 1.0f)) + 1e-3f;
            break;
        default:
            half = absolute_axes(light.axis_u, light.axis_v);
            e->axis = light.direction;
            e->spread = 0.0f;
            e->power *= light.area;
    }
    e->low = light.position - half;
    e->high = light.position + half;
    return true;
}

EmitterBounds bounds_triangle(const Scene& scene, const EmissiveTriangle& at, int32_t index) {
    const Instance& instance = scene.world.instances[at.instance];
    EmitterBounds e{{}, {}, {0.0f, 0.0f, 1.0f}, kPi, 0.5f * kPi, true, 0.0, ~index};
    if (scene.world.meshes[instance.mesh].shape == Shape::sphere) {
        const auto& m = instance.object_to_world.m;
        const Vec3 centre{m[0][3], m[1][3], m[2][3]};
        const auto reach = [&](int k) { return length(Vec3{m[k][0], m[k][1], m[k][2]}); };
        const Vec3 half{reach(0), reach(1), reach(2)};
        e.low = centre - half;
        e.high = centre + half;
        return e;
    }
    Vec3 p[3];
    corners_of(scene, at, p);
    e.low = {std::min({p[0].x, p[1].x, p[2].x}), std::min({p[0].y, p[1].y, p[2].y}),
             std::min({p[0].z, p[1].z, p[2].z})};
    e.high = {std::max({p[0].x, p[1].x, p[2].x}), std::max({p[0].y, p[1].y, p[2].y}),
              std::max({p[0].z, p[1].z, p[2].z})};
    const Vec3 n = normalize_safe(cross(p[1] - p[0], p[2] - p[0]));
    if (is_black(n)) return e;
    e.axis = n;
    e.spread = 0.0f;
    return e;
}

double power_of(const Light& light) {
    const double brightness = std::fabs(luminance(light.color));
    switch (light.kind) {
        case LightKind::sun:
            return brightness * (light.extended ? light.solid_angle : 1.0f);
        case LightKind::point:
        case LightKind::spot: {
            const double sphere = light.extended ? kPi * light.radius * light.radius : 1.0;
            const double cone =
                light.kind == LightKind::spot ? std::max(0.5 * (1.0 - light.cos_outer), 1e-3) : 1.0;
            return 4.0 * kPi * brightness * sphere * cone;
        }
        default:
            return kPi * brightness * light.area;
    }
}

/// Splits the lights into those always sampled and the pool, whose powers are returned.
std::vector<double> split_lights(const std::vector<Light>& lights, EmitterTables* tables) {
    std::vector<int32_t> suns;
    std::vector<double> powers;
    for (size_t k = 0; k < lights.size(); ++k)
        if (lights[k].kind == LightKind::sun) suns.push_back(static_cast<int32_t>(k));
    std::stable_sort(suns.begin(), suns.end(), [&](int32_t a, int32_t b) {
        return power_of(lights[a]) > power_of(lights[b]);
    });
    for (int32_t sun : suns)
        if (power_of(lights[sun]) > 0.0 && tables->always.size() < kMostAlwaysLights)
            tables->always.push_back(sun);
    for (size_t k = 0; k < lights.size(); ++k) {
        const int32_t index = static_cast<int32_t>(k);
        const bool taken = std::count(tables->always.begin(), tables->always.end(), index) > 0;
        if (taken || !(power_of(lights[k]) > 0.0)) continue;
        tables->pool.push_back(index);
        powers.push_back(power_of(lights[k]));
    }
    return powers;
}

/// Where the leaves of the triangles lie in the tree.
void index_leaves(const Scene& scene, EmitterTables* tables) {
    tables->first_leaf.assign(scene.world.instances.size(), -1);
    for (const EmissiveTriangle& at : tables->triangles) {
        int32_t& first = tables->first_leaf[at.instance];
        if (first >= 0) continue;
        first = static_cast<int32_t>(tables->leaves.size());
        const size_t count =
            scene.world.meshes[scene.world.instances[at.instance].mesh].triangles.size();
        tables->leaves.resize(tables->leaves.size() + std::max<size_t>(count, 1), -1);
    }
    for (size_t k = 0; k < tables->tree.size(); ++k) {
        const LightNode& node = tables->tree[k];
        if (node.second >= 0 || node.emitter >= 0) continue;
        const EmissiveTriangle& at = tables->triangles[~node.emitter];
        tables->leaves[tables->first_leaf[at.instance] + at.triangle] = static_cast<int32_t>(k);
    }
}

/// Moves what can be there from the pool, whose `powers` go along, into a tree; returns the power
/// of all that is in it, 0 where a list does as well.
double plant_tree(const Scene& scene, const std::vector<double>& weights,
                  std::vector<double>* powers, EmitterTables* tables) {
    const std::vector<Light>& lights = scene.tables.lights;
    std::vector<EmitterBounds> bounds;
    std::vector<int32_t> left;
    std::vector<double> left_powers;
    double total = 0.0;
    for (size_t k = 0; k < tables->pool.size(); ++k) {
        EmitterBounds e;
        if (bounds_light(lights[tables->pool[k]], tables->pool[k], &e)) {
            bounds.push_back(e);
            total += (*powers)[k];
        } else {
            left.push_back(tables->pool[k]);
            left_powers.push_back((*powers)[k]);
        }
    }
    if (bounds.size() + weights.size() <= kMostListed) return 0.0;
    for (const EmitterBounds& e : bounds)
        tables->tree_has_extended = tables->tree_has_extended || lights[e.emitter].extended;
    for (size_t k = 0; k < weights.size(); ++k) {
        bounds.push_back(bounds_triangle(scene, tables->triangles[k], static_cast<int32_t>(k)));
        bounds.back().power = weights[k];
        total += 2.0 * kPi * weights[k];
    }
    tables->pool.swap(left);
    powers->swap(left_powers);
    tables->tree = build_light_tree(bounds);
    index_leaves(scene, tables);
    return total;
}

void list_extended(const std::vector<Light>& lights, EmitterTables* tables) {
    for (int32_t index : tables->always)
        if (lights[index].extended) {
            tables->extended.push_back(index);
            tables->extended_shares.push_back(1.0f);
        }
    for (size_t k = 0; k < tables->pool.size(); ++k) {
        if (tables->pool[k] < 0 || !lights[tables->pool[k]].extended) continue;
        tables->extended.push_back(tables->pool[k]);
        tables->extended_shares.push_back(tables->pool_shares[k]);
    }
}

}  // namespace

EmitterTables build_emitters(const Scene& scene) {
    EmitterTables tables;
    std::vector<double> powers = split_lights(scene.tables.lights, &tables);
    const std::vector<double> weights = gather_triangles(scene, &tables);
    const double triangle_weight = std::accumulate(weights.begin(), weights.end(), 0.0);
    const double tree_power = plant_tree(scene, weights, &powers, &tables);
    const double shared_power = tree_power > 0.0 ? tree_power : 2.0 * kPi * triangle_weight;
    if (shared_power > 0.0) {
        tables.pool.push_back(-1);
        powers.push_back(shared_power);
    }
    if (!powers.empty()) {
        const double total = std::accumulate(powers.begin(), powers.end(), 0.0);
        // A floor keeps every emitter in the draw, however faint beside the others.
        for (double& power : powers) power += 1e-3 * total / static_cast<double>(powers.size());
        tables.pool_limits = cumulate(powers);
        for (double power : powers)
            tables.pool_shares.push_back(static_cast<float>(power / (1.001 * total)));
    }
    if (tree_power > 0.0) {
        tables.tree_share = tables.pool_shares.back();
    } else if (triangle_weight > 0.0) {
        tables.triangle_limits = cumulate(weights);
        tables.triangle_density = static_cast<float>(tables.pool_shares.back() / triangle_weight);
    }
    list_extended(scene.tables.lights, &tables);
    return tables;
}

EmitterView view_emitters(const EmitterTables& t) {
    const auto size = [](const auto& v) { return static_cast<int32_t>(v.size()); };
    return {t.always.data(),
            size(t.always),
            t.pool.data(),
            t.pool_limits.data(),
            t.pool_shares.data(),
            size(t.pool),
            t.extended.data(),
            t.extended_shares.data(),
            size(t.extended),
            t.triangles.data(),
            t.triangle_limits.data(),
            size(t.triangles),
            t.triangle_density,
            {t.tree.empty() ? nullptr : t.tree.data(), t.first_leaf.data(), t.leaves.data(),
             t.tree_share, t.tree_has_extended}};
}

}  // namespace trg
