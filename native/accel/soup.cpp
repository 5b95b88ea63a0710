#include "accel/soup.h"

#include <algorithm>
#include <atomic>

#include "accel/soup_source.h"
#include "base/parallel.h"

namespace trg {

namespace {

constexpr int64_t kGrain = 1 << 13;

/// References to the sound triangles, in order.
std::vector<PrimRef> gather_refs(const SoupSource& source, int threads) {
    std::vector<PrimRef> refs(source.count);
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

/// Packs runs of references, run k into block k; `run(k)` gives {pointer to item numbers, count}.
template <class Block, class Put>
void pack_blocks(AlignedVector<Block>& blocks, const Block& empty, int threads, Put put) {
    const auto count = static_cast<int64_t>(blocks.size());
    parallel_for(count, kGrain / kWidth, threads, [&](int64_t begin, int64_t end) {
        for (int64_t k = begin; k < end; ++k) {
            blocks[k] = empty;
            put(blocks[k], k);
        }
    });
}

void pack_soup(Soup& soup, const SoupSource& source, const BlockItems& runs,
               const SoupSettings& settings) {
    const auto put = [&](auto& block, int64_t k) {
        for (int64_t at = runs.begin[k]; at < runs.begin[k + 1]; ++at) {
            const int32_t item = runs.items[at];
            put_triangle(block, static_cast<int>(at - runs.begin[k]), corners_of(source, item),
                         item);
        }
    };
    const size_t count = runs.begin.size() - 1;
    if (settings.triangle_test == TriangleTest::classic) {
        soup.plane_blocks.resize(count);
        pack_blocks(soup.plane_blocks, empty_plane_block(), settings.threads, put);
    } else {
        soup.corner_blocks.resize(count);
        pack_blocks(soup.corner_blocks, empty_corner_block(), settings.threads, put);
    }
}

BlockItems runs_of_leaves(const std::vector<LeafRange>& leaves, const std::vector<PrimRef>& refs) {
    BlockItems runs;
    runs.items.reserve(refs.size());
    runs.begin.assign(1, 0);
    for (const LeafRange& leaf : leaves) {
        for (int32_t k = 0; k < leaf.count; ++k) runs.items.push_back(refs[leaf.begin + k].item);
        // Ascending items make the first of equal hits the one that counts.
        const auto first = runs.items.end() - leaf.count;
        std::sort(first, runs.items.end());
        // Parts of one triangle may have met again.
        runs.items.erase(std::unique(first, runs.items.end()), runs.items.end());
        runs.begin.push_back(static_cast<int64_t>(runs.items.size()));
    }
    return runs;
}

BlockItems runs_of_all(const std::vector<PrimRef>& refs) {
    BlockItems runs;
    for (const PrimRef& ref : refs) runs.items.push_back(ref.item);
    runs.begin.assign(1, 0);
    cut_into_runs(runs, 0, static_cast<int64_t>(refs.size()));
    return runs;
}

BlockItems index_refs(Soup& soup, std::vector<PrimRef>& refs, const SoupSource& source,
                      int threads) {
    BlockItems runs;
    switch (soup.accel) {
        case AccelKind::grid:
        case AccelKind::grid2:
            return build_grid(refs, soup.bounds, soup.accel == AccelKind::grid2, threads,
                              &soup.grid);
        case AccelKind::tree:
            soup.pairs = build_pair_tree(refs);
            runs = runs_of_leaves(soup.pairs.leaves, refs);
            soup.pairs.leaves = {};
            return runs;
        case AccelKind::bvh: {
            const CornersOf corners = [&](int64_t item) { return corners_of(source, item); };
            soup.tree = build_tree(refs, {kWidth, threads, &corners});
            runs = runs_of_leaves(soup.tree.leaves, refs);
            soup.tree.leaves = {};
            return runs;
        }
        default:
            return runs_of_all(refs);
    }
}

void index_soup(Soup& soup, const SoupSource& source, const SoupSettings& settings) {
    std::vector<PrimRef> refs = gather_refs(source, settings.threads);
    soup.triangles = static_cast<int64_t>(refs.size());
    soup.degenerate = source.count - soup.triangles;
    for (const PrimRef& ref : refs) soup.bounds = united(soup.bounds, box_of(ref));
    soup.accel = refs.empty() ? AccelKind::none : settings.accel;
    const BlockItems runs = index_refs(soup, refs, source, settings.threads);
    refs = {};
    pack_soup(soup, source, runs, settings);
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
