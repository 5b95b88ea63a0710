/// Images, textures and texture programs of a scene, taken from packed tables and checked.
#pragma once

#include <cstdint>
#include <vector>

#include "shade/texture_set.h"

namespace trg {

/// Columns of a row of textures, in order (trg_blender/engine/scene_arrays.py has the same).
extern const std::vector<const char*> kTextureFields;
/// Names of TextureOp, in order (trg_blender/engine/texture_ops.py has the same).
extern const std::vector<const char*> kTextureOps;

/// A table of float32 rows as it came from Python.
struct Table {
    const float* data;
    int64_t rows, columns;
};

/// Stored pixels; one of the three is filled.
struct Image {
    std::vector<uint8_t> bytes;
    std::vector<uint16_t> halves;  // IEEE 754
    std::vector<float> floats;
    bool srgb;
    int32_t width, height, channels;
};

/// Programs as they came from Python: rows of 16 and of 3 numbers.
struct ProgramTables {
    const int32_t* ops;
    int64_t op_count;
    const float* constants;
    int64_t constant_count;
    const int32_t* programs;
    int64_t program_count;
};

struct TextureTables {
    std::vector<Image> images;
    std::vector<Texture> textures;
    std::vector<ProgramOp> ops;
    std::vector<float> constants;
    std::vector<Program> programs;
};

/// Float pixels marked sRGB are made linear once; returns the image's index. Throws TableError for
/// numbers that are not finite.
int add_image(TextureTables& tables, Image image);

/// Replace their tables. Throw TableError where an index, a register or a constant is not there.
void set_textures(TextureTables& tables, const Table& table);
void set_programs(TextureTables& tables, const ProgramTables& from);

/// Throws TableError when textures name programs, or programs textures, that are not there.
void check_textures(const TextureTables& tables);

/// Value of an sRGB-encoded number in linear light (IEC 61966-2-1).
float srgb_to_linear(float encoded);

}  // namespace trg
