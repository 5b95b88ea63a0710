/// Images, textures and programs of a scene as kernels see them, and the point they are asked at.
#pragma once

#include "accel/world.h"
#include "shade/texture.h"

namespace trg {

/// What an instruction of a program does, in the order of kTextureOps.
enum class TextureOp : int32_t {
    attribute,
    generated,
    object,
    position,
    normal,
    info,
    copy,
    image,
    box,
    project,
    affine,
    mapping,
    checker,
    noise,
    brick,
    gradient,
    wave,
    ramp,
    curves,
    blend,
    math,
    vector_math,
    map_range,
    adjust_hsv,
    contrast,
    invert,
    gamma,
    separate,
    combine,
    clamp,
    grey,
    fresnel,
    layer_weight,
    shift,
    bump,
    normal_map
};
constexpr int32_t kTextureOpCount = 36;

/// One instruction. Operands are registers, or below 0 constants: -1 is number 0. A vector takes
/// three in a row.
struct ProgramOp {
    TextureOp op;
    int32_t mode;
    int32_t out;
    int32_t in[13];
};
constexpr int32_t kProgramRegisters = 256;
/// What an instruction may write from its `out` on.
constexpr int32_t kLargestResult = 4;

/// Instructions [first, first + count); the value is the vector in register `result`.
struct Program {
    int32_t first, count, result;
};

struct TextureSet {
    const ImageView* images;
    const Texture* textures;
    const Program* programs;
    const ProgramOp* ops;
    const float* constants;
};

/// Values at the corners of a mesh's triangles; null where it has none.
struct CornerView {
    const float* values;  // 3 x width a triangle
    int32_t width;
};

/// What programs may ask of a mesh.
struct TextureMesh {
    const CornerView* attributes;  // by the scene's number of the attribute
    int32_t attribute_count;
    Shape shape;
    Vec3 space_scale, space_offset;  // generated = local * scale + offset
};

/// A place on a surface, seen from somewhere. Directions are unit and in the world.
struct TexturePoint {
    Vec3 position, local;
    Vec3 edge1, edge2;      // of the triangle, in the world; null on a shape
    Vec3 normal, flat, wo;  // shading and geometric normal on the viewer's side; to the viewer
    bool outside;           // whether the viewer is
    float u, v;
    const TextureMesh* mesh;
    const Instance* instance;
    int32_t triangle;
    float b1, b2;
    float random;  // of the object, 0 to 1
    float step;    // how far away bumps look for their slope
};

}  // namespace trg
