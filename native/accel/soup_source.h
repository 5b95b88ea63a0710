/// The triangles of a soup by item number, whether they come from one mesh or from many.
#pragma once

#include "accel/soup.h"

namespace trg {

struct SoupSource {
    const World* world;  // of a merged soup
    const std::vector<PrimOrigin>* origins;
    const Mesh* mesh;  // of one mesh
    int64_t count;
};

TRG_FN TriangleCorners corners_of(const Mesh& mesh, int64_t triangle) {
    const Triangle& t = mesh.triangles[triangle];
    return {{mesh.vertices[t.vertex[0]], mesh.vertices[t.vertex[1]], mesh.vertices[t.vertex[2]]}};
}

TRG_FN TriangleCorners corners_of(const SoupSource& source, int64_t item) {
    if (source.mesh) return corners_of(*source.mesh, item);
    const PrimOrigin& origin = (*source.origins)[item];
    const Instance& instance = source.world->instances[origin.instance];
    return corners_of(source.world->meshes[instance.mesh], origin.triangle);
}

TRG_FN Bounds box_of(const TriangleCorners& triangle) {
    Bounds box = empty_bounds();
    for (const Vec3& p : triangle.p) box = united(box, p);
    return box;
}

}  // namespace trg
