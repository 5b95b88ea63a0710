#include "scene/classic_table.h"

#include "scene/table_reader.h"

namespace trg {

const std::vector<const char*> kClassicFields = {
    "ambient_r",  "ambient_g",  "ambient_b", "diffuse_r", "diffuse_g",    "diffuse_b", "specular_r",
    "specular_g", "specular_b", "power",     "reflect_r", "reflect_g",    "reflect_b", "refract_r",
    "refract_g",  "refract_b",  "ior",       "decay",     "texture_share"};

namespace {

Vec3 next_positive(TableRow& row, float most) {
    const float r = row.next(0.0f, most), g = row.next(0.0f, most), b = row.next(0.0f, most);
    return {r, g, b};
}

ClassicMaterial read_classic(TableRow row) {
    constexpr float kMost = 1e6f;
    ClassicMaterial m{};
    m.ambient = next_positive(row, kMost);
    m.diffuse = next_positive(row, kMost);
    m.specular = next_positive(row, kMost);
    m.power = row.next(0.0f, kMost);
    m.reflect = next_positive(row, 1.0f);
    m.refract = next_positive(row, 1.0f);
    m.ior = row.next(1e-3f, kMost);
    m.decay = row.next(0.0f, kMost);
    m.texture_share = row.next(0.0f, kMost);
    return m;
}

}  // namespace

void set_classic(ShadingTables& tables, const Table& table, Vec3 ambient) {
    check_columns(table, "classic", kClassicFields);
    if (!is_finite(ambient)) throw TableError("ambient: expected finite numbers");
    std::vector<ClassicMaterial> rows;
    for (int64_t row = 0; row < table.rows; ++row)
        rows.push_back(read_classic({table, "classic", kClassicFields, row}));
    tables.classic.swap(rows);
    tables.ambient = ambient;
    tables.is_classic = true;
}

}  // namespace trg
