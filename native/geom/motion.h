/// Places that change while a shutter is open: keys at even steps from time 0 to 1, straight lines
/// between them.
#pragma once

#include <cmath>

#include "geom/transform.h"

namespace trg {

/// Time of what asks for none: the middle of the shutter.
constexpr float kMiddleTime = 0.5f;

/// The key before a time and how far it is to the next.
struct MotionStep {
    int32_t key;
    float part;
};

/// `time` from 0 to 1 among two or more keys.
TRG_FN MotionStep motion_step(int32_t keys, float time) {
    const float place = time * static_cast<float>(keys - 1);
    int32_t key = static_cast<int32_t>(place);
    if (key > keys - 2) key = keys - 2;
    return {key, place - static_cast<float>(key)};
}

/// Entry by entry, so that every point goes straight from key to key.
TRG_FN Transform transform_at(const Transform* keys, int32_t count, float time) {
    const MotionStep at = motion_step(count, time);
    const Transform &a = keys[at.key], &b = keys[at.key + 1];
    Transform result;
    for (int row = 0; row < 3; ++row)
        for (int column = 0; column < 4; ++column)
            result.m[row][column] =
                a.m[row][column] * (1.0f - at.part) + b.m[row][column] * at.part;
    return result;
}

TRG_FN Vec3 point_at(Vec3 a, Vec3 b, float part) {
    return a * (1.0f - part) + b * part;
}

}  // namespace trg
