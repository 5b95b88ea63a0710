/// Geometry with an index over it: the one interface through which rays meet triangles.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "base/isa.h"
#include "geom/motion.h"
#include "geom/ray.h"
#include "geom/transform.h"

namespace trg {

enum class AccelKind { automatic, bvh, grid, grid2, tree, none };
enum class TriangleTest { watertight, classic };

struct Triangle {
    int32_t vertex[3];
};

/// What a mesh is: its triangles, the unit sphere round the origin, or the infinite plane z = 0.
enum class Shape { triangles, sphere, plane };

struct Mesh {
    Shape shape = Shape::triangles;
    std::vector<Vec3> vertices;
    std::vector<Triangle> triangles;
};

struct Instance {
    int32_t mesh;
    bool identity;
    bool mirrored;
    Transform object_to_world;  // of one that moves: in the middle of the shutter
    Transform world_to_object;
    int32_t key_count = 0;  // of one that moves, its keys in World::motion_keys; else 0
    int64_t first_key = 0;
    uint8_t mask = kEveryRay;  // rays that share no bit with it do not meet it
};

struct BuildStats {
    double seconds = 0;
    int64_t bytes = 0;
    int64_t nodes = 0;
    int64_t triangles = 0;
    int64_t instances = 0;
    int64_t degenerate_triangles = 0;
    int64_t built_trees = 0;  // indices over triangles of meshes that were built
    int64_t kept_trees = 0;   // and that came along from a world before
    AccelKind accel = AccelKind::none;
    std::string reason;
};

/// What `build_world` makes, and the index over one mesh; private to room accel.
struct WorldIndex;
struct Soup;

struct World {
    AccelKind accel = AccelKind::automatic;
    TriangleTest triangle_test = TriangleTest::watertight;
    Isa isa = detect_isa();  // what queries and kernels are compiled for
    std::vector<Mesh> meshes;
    std::vector<Instance> instances;
    std::vector<Transform> motion_keys;  // of all that move, in a row
    bool merge = true;  // one index for all meshes used once that stand where they are
    std::vector<std::shared_ptr<Soup>> kept;  // by mesh: built in a world before; none or null: not
    std::shared_ptr<WorldIndex> index;
};

/// A copy of `mesh` placed by `object_to_world`, whose determinant must not be zero.
Instance make_instance(int mesh, const Transform& object_to_world);

/// Adds a mesh (indices must lie within `vertices`; none are looked at where `shape` is not
/// triangles); it shows only through instances.
int add_mesh(World& world, Mesh mesh);

/// Moves a mesh with its index out of `from`, which then has an empty one there and must be built
/// anew before it can be queried. The next build of `to` keeps the index where it fits.
int take_mesh(World& to, World& from, int mesh);

/// Adds such a copy to the world.
int add_instance(World& world, int mesh, const Transform& object_to_world);

/// Makes instance `number` move through two or more places while the shutter is open
/// (geom/motion.h). Rays meet it where it is at their time, and one by one; streams are off in a
/// world that moves.
void set_motion(World& world, int number, const std::vector<Transform>& keys);

/// Builds the index over everything added so far. Triangles with coordinates that are not finite or
/// exceed 1e18 and triangles of no area are left out and counted as degenerate. About `rays` rays
/// will be traced (0: nobody knows): an index left to choice is chosen for them.
BuildStats build_world(World& world, int threads, double rays = 0);

struct UpdateStats {
    double seconds = 0;
    bool rebuilt = false;  // more than was asked for had to be built anew
    double growth = 1;     // cost of the tree over what it was when it was built
};

/// Gives instances `first` and on the given places and builds the top level anew. Needs a built
/// world. Where one of them had been merged with others into one index, everything is built anew.
/// One that moved while the shutter is open stands still from then on.
UpdateStats move_instances(World& world, int first, const std::vector<Transform>& places,
                           int threads);

/// Gives `mesh` as many vertices as it had and fits its index to them. Needs a built world. The
/// index is built anew when its cost has grown by half, or when it has no tree.
UpdateStats move_vertices(World& world, int mesh, std::vector<Vec3> vertices, int threads);

/// Makes instance `number` invisible to rays whose masks share no bit with `mask`. Packets and
/// streams are off in a world with such an instance.
void set_mask(World& world, int number, uint8_t mask);

/// Fills `hits` with the nearest hit of each ray, ties by (t, instance, triangle). Needs a built
/// world; many threads may call it at once; allocates nothing.
void intersect_closest(const World& world, const Ray* rays, Hit* hits, int count,
                       const RayTags& tags = {});

/// What `ray` meets at `time` after `met`, a hit of its own, in the order of (t, instance,
/// triangle). As thread-safe as above.
Hit intersect_beyond(const World& world, const Ray& ray, RayTag tag, const Hit& met);

/// Sets `hidden[i]` to 1 where ray i meets any triangle, else to 0. As thread-safe as above.
void intersect_any(const World& world, const Ray* rays, uint8_t* hidden, int count,
                   const RayTags& tags = {});

}  // namespace trg
