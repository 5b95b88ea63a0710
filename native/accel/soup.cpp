#include "accel/soup.h"

#include <algorithm>
#include <atomic>
#include <stdexcept>

#include "accel/soup_source.h"
#include "base/parallel.h"

namespace trg {

namespace {

constexpr int64_t kGrain = 1 << 13;
/// Items of a soup are numbered by 32 bits.
constexpr int64_t kMostMerged = int64_t{1} << 30;

/// References to the sound triangles, in order.
PrimRefs gather_refs(const SoupSource& source, int threads) {
    PrimRefs refs;
    refs.reserve(source.count + source.count / 4);  // so that parts of cut triangles find room
    refs.resize(source.count);
    std::atomic<int64_t> unsound{0};
    parallel_for(source.count, kGrain, threads, [&](int64_t begin, int64_t end) {
        for (int64_t item = begin; item < end; ++item) {
            const TriangleCorners triangle = corners_of(source, item);
            const bool sound = is_sound(triangle);
            refs[item] = make_ref(box_of(triangle), sound ? static_cast<int32_t>(item) : -1);
            if (!sound) ++unsound;
        }
    });
    if (unsound > 0)
        refs.erase(std::remove_if(refs.begin(), refs.end(),
                                  [](const PrimRef& ref) { return ref.item < 0; }),
                   refs.end());
    return refs;
}

/// The items of one block, ascending: the first of equal hits is the one that counts.
struct LeafItems {
    int32_t item[kWidth];
    int count;
};

LeafItems items_of(const PrimRefs& refs, const LeafRange& leaf) {
    LeafItems items;
    for (int32_t k = 0; k < leaf.count; ++k) items.item[k] = refs[leaf.begin + k].item;
    std::sort(items.item, items.item + leaf.count);
    // Parts of one triangle may have met again.
    items.count = static_cast<int>(std::unique(items.item, items.item + leaf.count) - items.item);
    return items;
}

LeafItems items_of(const BlockItems& runs, int64_t block) {
    LeafItems items;
    items.count = static_cast<int>(runs.begin[block + 1] - runs.begin[block]);
    std::copy_n(runs.items.begin() + runs.begin[block], items.count, items.item);
    return items;
}

template <class Block, class ItemsOf>
void pack_blocks(AlignedVector<Block>& blocks, const Block& empty, const SoupSource& source,
                 int threads, ItemsOf items_of_block) {
    const auto count = static_cast<int64_t>(blocks.size());
    parallel_for(count, kGrain / kWidth, threads, [&](int64_t begin, int64_t end) {
        for (int64_t k = begin; k < end; ++k) {
            const LeafItems items = items_of_block(k);
            blocks[k] = empty;
            for (int lane = 0; lane < items.count; ++lane)
                put_triangle(blocks[k], lane, corners_of(source, items.item[lane]),
                             items.item[lane]);
        }
    });
}

/// Packs `count` blocks of triangles, whose items `items_of_block(block)` gives.
template <class ItemsOf>
void pack_soup(Soup& soup, const SoupSource& source, size_t count, const SoupSettings& settings,
               ItemsOf items_of_block) {
    if (settings.triangle_test == TriangleTest::classic) {
        soup.plane_blocks.resize(count);
        pack_blocks(soup.plane_blocks, empty_plane_block(), source, settings.threads,
                    items_of_block);
    } else {
        soup.corner_blocks.resize(count);
        pack_blocks(soup.corner_blocks, empty_corner_block(), source, settings.threads,
                    items_of_block);
    }
}

void pack_leaves(Soup& soup, const SoupSource& source, const PrimRefs& refs,
                 std::vector<LeafRange>& leaves, const SoupSettings& settings) {
    pack_soup(soup, source, leaves.size(), settings,
              [&](int64_t k) { return items_of(refs, leaves[k]); });
    leaves = {};
}

void pack_runs(Soup& soup, const SoupSource& source, const BlockItems& runs,
               const SoupSettings& settings) {
    pack_soup(soup, source, runs.begin.size() - 1, settings,
              [&](int64_t k) { return items_of(runs, k); });
}

BlockItems runs_of_all(const PrimRefs& refs) {
    BlockItems runs;
    for (const PrimRef& ref : refs) runs.items.push_back(ref.item);
    runs.begin.assign(1, 0);
    cut_into_runs(runs, 0, static_cast<int64_t>(refs.size()));
    return runs;
}

/// Lays the index over the references, and packs their triangles in its order.
void index_refs(Soup& soup, PrimRefs& refs, const SoupSource& source,
                const SoupSettings& settings) {
    const int threads = settings.threads;
    switch (soup.accel) {
        case AccelKind::grid:
        case AccelKind::grid2: {
            const bool divide = soup.accel == AccelKind::grid2;
            const BlockItems runs = build_grid(refs, soup.bounds, divide, threads, &soup.grid);
            refs = {};
            return pack_runs(soup, source, runs, settings);
        }
        case AccelKind::tree:
            soup.pairs = build_pair_tree(refs);
            return pack_leaves(soup, source, refs, soup.pairs.leaves, settings);
        case AccelKind::bvh: {
            const CornersOf corners = [&](int64_t item) { return corners_of(source, item); };
            soup.tree = build_tree(refs, {kWidth, threads, &corners});
            soup.bounds = soup.tree.bounds;
            return pack_leaves(soup, source, refs, soup.tree.leaves, settings);
        }
        default:
            return pack_runs(soup, source, runs_of_all(refs), settings);
    }
}

void index_soup(Soup& soup, const SoupSource& source, const SoupSettings& settings) {
    PrimRefs refs = gather_refs(source, settings.threads);
    soup.triangles = static_cast<int64_t>(refs.size());
    soup.degenerate = source.count - soup.triangles;
    soup.accel = refs.empty() ? AccelKind::none : settings.accel;
    if (soup.accel != AccelKind::bvh)
        soup.bounds = measure_range(refs.data(), 0, soup.triangles, settings.threads).box;
    index_refs(soup, refs, source, settings);
    soup.built_cost = tree_cost(soup.tree);
}

}  // namespace

Soup build_mesh_soup(const Mesh& mesh, const SoupSettings& settings) {
    Soup soup;
    soup.shape = mesh.shape;
    if (mesh.shape != Shape::triangles) {
        if (mesh.shape == Shape::sphere) soup.bounds = {{-1, -1, -1}, {1, 1, 1}};
        return soup;
    }
    const auto count = static_cast<int64_t>(mesh.triangles.size());
    index_soup(soup, {nullptr, nullptr, &mesh, count}, settings);
    return soup;
}

Soup build_merged_soup(const World& world, const std::vector<int32_t>& instances,
                       const SoupSettings& settings) {
    Soup soup;
    int64_t triangles = 0;
    for (int32_t instance : instances)
        triangles +=
            static_cast<int64_t>(world.meshes[world.instances[instance].mesh].triangles.size());
    if (triangles > kMostMerged) throw std::length_error("more than 2^30 triangles at one place");
    soup.origins.reserve(triangles);
    for (int32_t instance : instances) {
        const Mesh& mesh = world.meshes[world.instances[instance].mesh];
        for (size_t k = 0; k < mesh.triangles.size(); ++k)
            soup.origins.push_back({instance, static_cast<int32_t>(k)});
    }
    const auto count = static_cast<int64_t>(soup.origins.size());
    index_soup(soup, {&world, &soup.origins, nullptr, count}, settings);
    return soup;
}

int64_t soup_nodes(const Soup& soup) {
    return static_cast<int64_t>(soup.tree.nodes.size() + soup.pairs.nodes.size()) +
           static_cast<int64_t>(soup.grid.cells.size());
}

int64_t soup_bytes(const Soup& soup) {
    const GridIndex& grid = soup.grid;
    return static_cast<int64_t>(
        soup.tree.nodes.size() * sizeof(WideNode) + soup.pairs.nodes.size() * sizeof(PairNode) +
        soup.corner_blocks.size() * sizeof(CornerBlock) +
        soup.plane_blocks.size() * sizeof(PlaneBlock) + soup.origins.size() * sizeof(PrimOrigin) +
        grid.cells.size() * sizeof(BlockRange) + grid.grids.size() * sizeof(Grid));
}

}  // namespace trg
