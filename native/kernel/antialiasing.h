/// Where in its pixel a sample lies: the paper's methods beside even random points.
#pragma once

#include "kernel/scene_view.h"
#include "shade/sampler.h"

namespace trg {

/// A permutation of 0 .. count - 1 chosen by `seed`: bijections of the next power of two, walked on
/// until they land inside.
TRG_FN uint32_t permute_index(uint32_t index, uint32_t count, uint32_t seed) {
    if (count < 2) return 0;
    uint32_t mask = count - 1, bits = 1;
    while (mask >> bits) ++bits;
    mask = bits >= 32 ? ~0u : (1u << bits) - 1u;
    do {
        for (uint32_t round = 0; round < 3; ++round) {
            const uint32_t h = hash_bits(seed + round * 0x9e3779b9u);
            index = (index ^ h) & mask;
            index ^= index >> ((bits + 1) / 2);
            index = (index * (hash_bits(h) | 1u)) & mask;
        }
    } while (index >= count);
    return index;
}

/// The middle of cell number `cell` of a grid of `side` by `side`.
TRG_FN Sample2 cell_centre(uint32_t cell, uint32_t side) {
    const float step = 1.0f / static_cast<float>(side);
    return {(static_cast<float>(cell % side) + 0.5f) * step,
            (static_cast<float>(cell / side) + 0.5f) * step};
}

/// Cells of one colour of a chessboard; the colour alternates from frame to frame.
TRG_FN Sample2 alternating_place(const AntialiasingView& aa, uint32_t index) {
    const uint32_t side = aa.side + (aa.side & 1u), half = side / 2;
    const uint32_t row = index / half % side;
    const uint32_t column = 2 * (index % half) + ((row + aa.frame) & 1u);
    return cell_centre(row * side + column, side);
}

/// Place in the unit square of the pixel of sample number `sample`, whose key is `key`; `even` are
/// two numbers spread evenly over the samples of its replicate.
TRG_FN Sample2 place_in_pixel(const AntialiasingView& aa, SampleKey key, uint32_t sample,
                              Sample2 even) {
    const uint32_t cells = aa.side * aa.side, own = sample / kReplicates;
    // Without other randomness all samples share one pattern; else each replicate has the whole.
    const uint32_t index = aa.one_pattern ? sample : own;
    switch (aa.kind) {
        case Antialiasing::none:
            return {0.5f, 0.5f};
        case Antialiasing::supersampling:
            return cell_centre(
                aa.one_pattern ? index % cells : permute_index(index % cells, cells, key.stream),
                aa.side);
        case Antialiasing::jittering: {
            const uint32_t seed = hash_bits(key.stream + own / cells * 0x85ebca6bu);
            const Sample2 corner = cell_centre(permute_index(own % cells, cells, seed), aa.side);
            const float step = 1.0f / static_cast<float>(aa.side);
            return {corner.u + (even.u - 0.5f) * step, corner.v + (even.v - 0.5f) * step};
        }
        case Antialiasing::mfaa:
            return alternating_place(aa, index);
        default:
            return even;
    }
}

}  // namespace trg
