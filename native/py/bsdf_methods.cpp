#include "py/bsdf_methods.h"

#include "py/buffer.h"
#include "scene/shading_tables.h"
#include "shade/bsdf.h"

namespace trg::py {

namespace {

constexpr uint32_t kAllLobes = kGlassLobe | kLayerLobes;

ShadingTables take_material(PyObject* object) {
    const Buffer row =
        Buffer::of<float>(object, "material", {static_cast<int64_t>(kMaterialFields.size())});
    ShadingTables tables;
    set_materials(tables, {row.data<float>(), 1, row.count()});
    return tables;
}

Vec3 vector_at(const Buffer& buffer, int64_t row) {
    const float* v = buffer.data<float>() + 3 * row;
    return {v[0], v[1], v[2]};
}

void put_vector(Buffer& buffer, int64_t row, Vec3 value) {
    float* v = buffer.mutable_data<float>() + 3 * row;
    v[0] = value.x;
    v[1] = value.y;
    v[2] = value.z;
}

/// The lobes of the one material seen from `wo`; false when it scatters nothing there.
bool make_lobes(const ShadingTables& tables, Vec3 wo, bool outside, Bsdf* bsdf) {
    if (!(wo.z > 0.0f)) return false;
    const View view{wo, {0.0f, 0.0f, 1.0f}, outside, tables.energy.values.data()};
    return make_bsdf<kAllLobes>(tables.materials[0], view, bsdf);
}

}  // namespace

PyObject* bsdf_eval(PyObject*, PyObject* args, PyObject* kwargs) {
    return guarded_object([&] {
        const char* const names[] = {"material", "wo", "wi", "outside", "value", "pdf", nullptr};
        PyObject* objects[5];
        int outside;
        parse_arguments(args, kwargs, "OOOpOO", names, &objects[0], &objects[1], &objects[2],
                        &outside, &objects[3], &objects[4]);
        const ShadingTables tables = take_material(objects[0]);
        const Buffer wo = Buffer::of<float>(objects[1], "wo", {kAnyExtent, 3});
        const int64_t count = wo.extent(0);
        const Buffer wi = Buffer::of<float>(objects[2], "wi", {count, 3});
        Buffer value = Buffer::of<float>(objects[3], "value", {count, 3}, Access::write);
        Buffer pdf = Buffer::of<float>(objects[4], "pdf", {count}, Access::write);
        for (int64_t row = 0; row < count; ++row) {
            Bsdf bsdf;
            BsdfValue found{{0.0f, 0.0f, 0.0f}, 0.0f};
            if (make_lobes(tables, vector_at(wo, row), outside, &bsdf))
                found = eval_bsdf<kAllLobes>(bsdf, vector_at(wi, row));
            put_vector(value, row, found.f_cos);
            pdf.mutable_data<float>()[row] = found.pdf;
        }
        return none();
    });
}

PyObject* bsdf_sample(PyObject*, PyObject* args, PyObject* kwargs) {
    return guarded_object([&] {
        const char* const names[] = {"material", "wo",     "uniforms", "outside",
                                     "wi",       "weight", "pdf",      nullptr};
        PyObject* objects[6];
        int outside;
        parse_arguments(args, kwargs, "OOOpOOO", names, &objects[0], &objects[1], &objects[2],
                        &outside, &objects[3], &objects[4], &objects[5]);
        const ShadingTables tables = take_material(objects[0]);
        const Buffer wo = Buffer::of<float>(objects[1], "wo", {kAnyExtent, 3});
        const int64_t count = wo.extent(0);
        const Buffer uniforms = Buffer::of<float>(objects[2], "uniforms", {count, 3});
        Buffer wi = Buffer::of<float>(objects[3], "wi", {count, 3}, Access::write);
        Buffer weight = Buffer::of<float>(objects[4], "weight", {count, 3}, Access::write);
        Buffer pdf = Buffer::of<float>(objects[5], "pdf", {count}, Access::write);
        for (int64_t row = 0; row < count; ++row) {
            Bsdf bsdf;
            const Vec3 zero{0.0f, 0.0f, 0.0f}, u = vector_at(uniforms, row);
            BsdfSample sample{zero, zero, -1.0f};
            const bool drawn = make_lobes(tables, vector_at(wo, row), outside, &bsdf) &&
                               sample_bsdf<kAllLobes>(bsdf, u.x, {u.y, u.z}, &sample);
            put_vector(wi, row, drawn ? sample.wi : zero);
            put_vector(weight, row, drawn ? sample.weight : zero);
            pdf.mutable_data<float>()[row] = drawn ? sample.pdf : -1.0f;
        }
        return none();
    });
}

}  // namespace trg::py
