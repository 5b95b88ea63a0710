#include "scene/texture_tables.h"

#include "scene/table_reader.h"

namespace trg {

const std::vector<const char*> kTextureFields = {
    "image",  "scale_u", "scale_v", "offset_u", "offset_v",    "wrap",   "skew_u",
    "skew_v", "filter",  "channel", "uv_map",   "unassociate", "program"};

const std::vector<const char*> kTextureOps = {
    "attribute", "generated", "object",       "position",    "normal",    "info",
    "copy",      "image",     "box",          "project",     "affine",    "mapping",
    "checker",   "noise",     "brick",        "gradient",    "wave",      "ramp",
    "curves",    "blend",     "math",         "vector_math", "map_range", "adjust_hsv",
    "contrast",  "invert",    "gamma",        "separate",    "combine",   "clamp",
    "grey",      "fresnel",   "layer_weight", "shift",       "bump",      "normal_map"};

namespace {

Texture read_texture(TableRow row, int64_t image_count) {
    Texture texture{};
    const int32_t image = row.next_index(-1, image_count);
    texture.image = image;
    texture.scale_u = row.next();
    texture.scale_v = row.next();
    texture.offset_u = row.next();
    texture.offset_v = row.next();
    texture.wrap = static_cast<Wrap>(row.next_index(0, 4));
    texture.skew_u = row.next();
    texture.skew_v = row.next();
    texture.filter = static_cast<Filter>(row.next_index(0, 3));
    texture.channel = static_cast<Channel>(row.next_index(0, 3));
    texture.uv_map = row.next_index(0, 1 << 16);
    texture.unassociate = row.next_index(0, 2) == 1;
    texture.program = row.next_index(-1, 1 << 24);
    if (image < 0 && texture.program < 0) row.fail("has neither an image nor a program");
    return texture;
}

/// How many numbers in a row operand `k` of `op` may take.
int64_t operand_width(const ProgramOp& op, int k) {
    if (op.op == TextureOp::affine && k == 1) return 12;
    const bool table =
        (op.op == TextureOp::ramp && k == 1) || (op.op == TextureOp::curves && k == 2);
    return table ? static_cast<int64_t>(op.mode & 0xffff) * 4 : kLargestResult;
}

[[noreturn]] void fail_op(int64_t number, const std::string& what) {
    throw TableError("programs: instruction " + std::to_string(number) + " " + what);
}

void check_op(const ProgramOp& op, int64_t number, int64_t constant_count) {
    const int32_t kind = static_cast<int32_t>(op.op);
    if (kind < 0 || kind >= kTextureOpCount) fail_op(number, "is of no kind");
    if (op.mode < 0) fail_op(number, "has a mode below 0");
    const bool table = op.op == TextureOp::ramp || op.op == TextureOp::curves;
    if (table && (op.mode & 0xffff) < 2) fail_op(number, "has a table of less than 2 rows");
    if (op.out < 0 || op.out + kLargestResult > kProgramRegisters)
        fail_op(number, "writes a register that is not there");
    for (int k = 0; k < 13; ++k) {
        const int64_t in = op.in[k], width = operand_width(op, k);
        if (in >= 0 && in + width > kProgramRegisters)
            fail_op(number, "reads a register that is not there");
        if (in < 0 && -1 - in + width > constant_count)
            fail_op(number, "reads a constant that is not there");
    }
}

void check_program(const Program& p, int64_t number, int64_t op_count) {
    const bool inside = p.first >= 0 && p.count >= 0 && p.first <= op_count - p.count;
    if (!inside || p.result < 0 || p.result + kLargestResult > kProgramRegisters)
        throw TableError("programs: row " + std::to_string(number) +
                         " names instructions or a register that are not there");
}

bool is_finite_half(uint16_t half) {
    return (half & 0x7c00u) != 0x7c00u;
}

[[noreturn]] void fail_pixel(const Image& image, size_t number) {
    throw TableError("pixels: row " +
                     std::to_string(number / (static_cast<size_t>(image.width) * image.channels)) +
                     " has a number that is not finite");
}

}  // namespace

float srgb_to_linear(float encoded) {
    return encoded <= 0.04045f ? encoded / 12.92f : std::pow((encoded + 0.055f) / 1.055f, 2.4f);
}

int add_image(TextureTables& tables, Image image) {
    for (size_t k = 0; k < image.halves.size(); ++k)
        if (!is_finite_half(image.halves[k])) fail_pixel(image, k);
    for (size_t k = 0; k < image.floats.size(); ++k) {
        if (!std::isfinite(image.floats[k])) fail_pixel(image, k);
        const bool alpha = image.channels == 4 && k % 4 == 3;
        if (image.srgb && !alpha) image.floats[k] = srgb_to_linear(image.floats[k]);
    }
    tables.images.push_back(std::move(image));
    return static_cast<int>(tables.images.size()) - 1;
}

void set_textures(TextureTables& tables, const Table& table) {
    check_columns(table, "textures", kTextureFields);
    std::vector<Texture> textures;
    for (int64_t row = 0; row < table.rows; ++row)
        textures.push_back(read_texture({table, "textures", kTextureFields, row},
                                        static_cast<int64_t>(tables.images.size())));
    tables.textures.swap(textures);
}

void set_programs(TextureTables& tables, const ProgramTables& from) {
    std::vector<ProgramOp> ops(static_cast<size_t>(from.op_count));
    for (int64_t k = 0; k < from.op_count; ++k) {
        const int32_t* row = from.ops + 16 * k;
        ops[k] = {static_cast<TextureOp>(row[0]), row[1], row[2], {}};
        std::copy(row + 3, row + 16, ops[k].in);
        check_op(ops[k], k, from.constant_count);
    }
    std::vector<Program> programs;
    for (int64_t k = 0; k < from.program_count; ++k) {
        const int32_t* row = from.programs + 3 * k;
        programs.push_back({row[0], row[1], row[2]});
        check_program(programs.back(), k, from.op_count);
    }
    tables.ops.swap(ops);
    tables.programs.swap(programs);
    tables.constants.assign(from.constants, from.constants + from.constant_count);
}

void check_textures(const TextureTables& tables) {
    const auto program_count = static_cast<int64_t>(tables.programs.size());
    const auto texture_count = static_cast<int64_t>(tables.textures.size());
    for (const Texture& texture : tables.textures)
        if (texture.program >= program_count)
            throw TableError("textures: program " + std::to_string(texture.program) + " of " +
                             std::to_string(program_count) + " programs");
    for (const ProgramOp& op : tables.ops) {
        if (op.op != TextureOp::image && op.op != TextureOp::box) continue;
        if (op.mode >= texture_count || tables.textures[op.mode].image < 0)
            throw TableError("programs: an instruction names texture " + std::to_string(op.mode) +
                             ", which is no image");
    }
}

}  // namespace trg
