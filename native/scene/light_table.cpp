#include "scene/shading_tables.h"
#include "scene/table_reader.h"

namespace trg {

const std::vector<const char*> kLightFields = {"kind",
                                               "color_r",
                                               "color_g",
                                               "color_b",
                                               "position_x",
                                               "position_y",
                                               "position_z",
                                               "direction_x",
                                               "direction_y",
                                               "direction_z",
                                               "axis_u_x",
                                               "axis_u_y",
                                               "axis_u_z",
                                               "axis_v_x",
                                               "axis_v_y",
                                               "axis_v_z",
                                               "radius",
                                               "angle",
                                               "cos_outer",
                                               "cos_inner",
                                               "falloff_constant",
                                               "falloff_linear",
                                               "falloff_quadratic",
                                               "spread",
                                               "soft",
                                               "seen"};

namespace {

/// A sun's disc below this angular radius is a point.
constexpr float kPointSun = 1e-4f;

/// What of a row serves to make the light ready, and is not kept.
struct LightRow {
    Light light;
    float angle, spread;
};

LightRow read_light(TableRow& row) {
    LightRow read{};
    Light& light = read.light;
    light.kind = static_cast<LightKind>(row.next_index(0, 5));
    light.color = row.next_vector();
    light.position = row.next_vector();
    light.direction = row.next_vector();
    light.axis_u = row.next_vector();
    light.axis_v = row.next_vector();
    light.radius = row.next(0.0f, 3.0e38f);
    read.angle = row.next(0.0f, 1.571f);
    light.cos_outer = row.next();
    light.cos_inner = row.next();
    for (float& coefficient : light.falloff) coefficient = row.next();
    read.spread = row.next(0.0f, 3.1416f);
    light.soft = row.next_share() > 0.5f;
    light.seen = row.next_share() > 0.5f && light.kind == LightKind::sun;
    light.direction = normalize_safe(light.direction);
    if (is_black(light.direction) && light.kind != LightKind::point) row.fail("has no direction");
    return read;
}

void prepare_sun(Light& light, float angle) {
    light.extended = angle >= kPointSun;
    if (!light.extended) return;
    const float half = std::sin(0.5f * angle), sine = std::sin(angle);
    light.chord2 = 4.0f * half * half;
    light.solid_angle = kPi * light.chord2;
    light.color = light.color / (kPi * sine * sine);
}

void prepare_point(Light& light) {
    const float* f = light.falloff;
    light.inverse_square = f[0] == 0.0f && f[1] == 0.0f && f[2] == 1.0f;
    light.extended = light.inverse_square && light.radius > 0.0f;
    if (light.extended) light.color = light.color / (kPi * light.radius * light.radius);
}

/// As Blender: the tangent of the angle off the axis takes light away, all of it at half the
/// spread, and the power stays the same.
void prepare_spread(Light& light, float spread) {
    constexpr double kSmallestHalf = 1e-3;
    light.spread = spread < kPi - 1e-4f;
    if (!light.spread) return;
    const double half = std::fmax(0.5 * spread, kSmallestHalf);
    light.spread_tangent = static_cast<float>(std::tan(half));
    light.spread_scale = static_cast<float>(1.0 / (std::tan(half) - half));
}

void prepare_area(Light& light) {
    const float shape = light.kind == LightKind::ellipse ? kPi : 4.0f;
    light.area = shape * length(cross(light.axis_u, light.axis_v));
    light.extended = light.area > 0.0f;
    // Solid angles are known of right angles only; by them rectangles are drawn within some sizes
    // of their own, ellipses within fewer.
    constexpr float kSquare = 1e-4f, kNearRectangle2 = 64.0f, kNearEllipse2 = 9.0f;
    light.half_u = length(light.axis_u);
    light.half_v = length(light.axis_v);
    const float product = light.half_u * light.half_v;
    const bool square = std::fabs(dot(light.axis_u, light.axis_v)) <= kSquare * product &&
                        std::fabs(dot(light.axis_u, light.direction)) <= kSquare * light.half_u &&
                        std::fabs(dot(light.axis_v, light.direction)) <= kSquare * light.half_v;
    light.near2 = 0.0f;
    if (!light.extended || !square) return;
    light.near2 =
        light.kind == LightKind::ellipse
            ? kNearEllipse2 * product
            : kNearRectangle2 * std::fmax(light.half_u * light.half_u, light.half_v * light.half_v);
}

}  // namespace

void set_lights(ShadingTables& tables, const Table& table) {
    check_columns(table, "lights", kLightFields);
    std::vector<Light> lights;
    for (int64_t at = 0; at < table.rows; ++at) {
        TableRow row(table, "lights", kLightFields, at);
        LightRow read = read_light(row);
        switch (read.light.kind) {
            case LightKind::sun:
                prepare_sun(read.light, read.angle);
                break;
            case LightKind::point:
            case LightKind::spot:
                prepare_point(read.light);
                break;
            default:
                prepare_area(read.light);
                prepare_spread(read.light, read.spread);
        }
        if (!is_finite(read.light.color)) row.fail("has a colour too large for its extent");
        lights.push_back(read.light);
    }
    tables.lights.swap(lights);
}

}  // namespace trg
