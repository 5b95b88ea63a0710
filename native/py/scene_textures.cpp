#include "py/scene_textures.h"

#include <cstring>

#include "py/buffer.h"
#include "py/scene_object.h"

namespace trg::py {

namespace {

constexpr long kMostAttributes = 1 << 16;

PyObject* add_image_method(PyObject* self, PyObject* args, PyObject* kwargs) {
    return guarded_object([&] {
        PyObject* pixels;
        int srgb = 1;
        const char* const names[] = {"pixels", "srgb", nullptr};
        parse_arguments(args, kwargs, "O|p", names, &pixels, &srgb);
        Image image{};
        image.srgb = srgb != 0;
        if (has_item_type(pixels, 'u', 1))
            copy_pixels(pixels, &image, &image.bytes);
        else if (has_item_type(pixels, 'u', 2))
            copy_pixels(pixels, &image, &image.halves);
        else
            copy_pixels(pixels, &image, &image.floats);
        TextureTables& textures = scene_to_change(self).tables.textures;
        return checked(PyLong_FromLong(add_image(textures, std::move(image))));
    });
}

PyObject* set_textures_method(PyObject* self, PyObject* table) {
    return guarded_object([&] {
        const Buffer rows = Buffer::of<float>(table, "table", {kAnyExtent, kAnyExtent});
        set_textures(scene_to_change(self).tables.textures,
                     {rows.data<float>(), rows.extent(0), rows.extent(1)});
        return none();
    });
}

PyObject* set_programs_method(PyObject* self, PyObject* args, PyObject* kwargs) {
    return guarded_object([&] {
        PyObject *ops, *constants, *programs;
        const char* const names[] = {"ops", "constants", "programs", nullptr};
        parse_arguments(args, kwargs, "OOO", names, &ops, &constants, &programs);
        const Buffer o = Buffer::of<int32_t>(ops, "ops", {kAnyExtent, 16});
        const Buffer c = Buffer::of<float>(constants, "constants", {kAnyExtent});
        const Buffer p = Buffer::of<int32_t>(programs, "programs", {kAnyExtent, 3});
        set_programs(scene_to_change(self).tables.textures,
                     {o.data<int32_t>(), o.extent(0), c.data<float>(), c.extent(0),
                      p.data<int32_t>(), p.extent(0)});
        return none();
    });
}

MeshAttributes& mesh_to_change(Scene& scene, long mesh) {
    if (mesh < 0 || mesh >= static_cast<long>(scene.attributes.size()))
        throw ArgumentError("mesh: index " + std::to_string(mesh) + " of " +
                            std::to_string(scene.attributes.size()) + " meshes");
    return scene.attributes[mesh];
}

PyObject* set_attribute_method(PyObject* self, PyObject* args, PyObject* kwargs) {
    return guarded_object([&] {
        long mesh, number;
        PyObject* values;
        const char* const names[] = {"mesh", "number", "values", nullptr};
        parse_arguments(args, kwargs, "llO", names, &mesh, &number, &values);
        const Buffer rows = Buffer::of<float>(values, "values", {kAnyExtent, 3, kAnyExtent});
        Scene& scene = scene_to_change(self);
        MeshAttributes& attributes = mesh_to_change(scene, mesh);
        const auto count = static_cast<int64_t>(scene.world.meshes[mesh].triangles.size());
        rows.expect_rows("values", count);
        if (number < 1 || number >= kMostAttributes)
            throw ArgumentError("number: expected 1 to " + std::to_string(kMostAttributes - 1));
        if (rows.extent(2) < 1 || rows.extent(2) > 4)
            throw ArgumentError("values: expected 1 to 4 numbers a corner");
        if (attributes.corners.size() <= static_cast<size_t>(number))
            attributes.corners.resize(number + 1);
        attributes.corners[number].width = static_cast<int32_t>(rows.extent(2));
        attributes.corners[number].values.assign(rows.data<float>(),
                                                 rows.data<float>() + rows.count());
        return none();
    });
}

PyObject* set_texture_space_method(PyObject* self, PyObject* args, PyObject* kwargs) {
    return guarded_object([&] {
        long mesh;
        Vec3 scale, offset;
        const char* const names[] = {"mesh", "scale", "offset", nullptr};
        parse_arguments(args, kwargs, "l(fff)(fff)", names, &mesh, &scale.x, &scale.y, &scale.z,
                        &offset.x, &offset.y, &offset.z);
        MeshAttributes& attributes = mesh_to_change(scene_to_change(self), mesh);
        if (!is_finite(scale) || !is_finite(offset))
            throw ArgumentError("scale, offset: expected finite numbers");
        attributes.space_scale = scale;
        attributes.space_offset = offset;
        return none();
    });
}

PyObject* set_randoms_method(PyObject* self, PyObject* values) {
    return guarded_object([&] {
        const Buffer rows = Buffer::of<float>(values, "values", {kAnyExtent});
        Scene& scene = scene_to_change(self);
        rows.expect_rows("values", static_cast<int64_t>(scene.world.instances.size()));
        scene.randoms.assign(rows.data<float>(), rows.data<float>() + rows.count());
        return none();
    });
}

}  // namespace

PyMethodDef kSceneTextureMethods[] = {
    {"add_image", as_method(add_image_method), METH_VARARGS | METH_KEYWORDS,
     "add_image(pixels, srgb=True) -> image index\n\n"
     "pixels: uint8, uint16 (the bits of halves) or float32 (h, w, 1 | 3 | 4), row 0 at the "
     "bottom."},
    {"set_textures", set_textures_method, METH_O,
     "set_textures(table): float32 (n, len(TEXTURE_FIELDS)); images must be there"},
    {"set_programs", as_method(set_programs_method), METH_VARARGS | METH_KEYWORDS,
     "set_programs(ops, constants, programs): int32 (n, 16), float32 (m,), int32 (p, 3)"},
    {"set_attribute", as_method(set_attribute_method), METH_VARARGS | METH_KEYWORDS,
     "set_attribute(mesh, number, values): float32 (triangles, 3, 1 to 4) at the corners"},
    {"set_texture_space", as_method(set_texture_space_method), METH_VARARGS | METH_KEYWORDS,
     "set_texture_space(mesh, scale, offset): generated coordinates are place * scale + offset"},
    {"set_randoms", set_randoms_method, METH_O,
     "set_randoms(values): float32 (instances,), what Object Info calls Random"},
    {nullptr, nullptr, 0, nullptr}};

}  // namespace trg::py
