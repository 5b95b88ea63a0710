/// Packets of rays through one soup of triangles.
#pragma once

#include "accel/test_packet.h"

namespace trg::TRG_ISA {

constexpr uint32_t kWholePacket = (1u << kPacketRays) - 1;

/// Whether packets can walk the soup: a tree over corners.
TRG_FN bool takes_packets(const Soup& soup) {
    return soup.accel == AccelKind::bvh && !soup.corner_blocks.empty();
}

/// The largest extent of the soup: what origins that lie close are small against.
TRG_FN float reach_of(const Bounds& box) {
    const Vec3 size = box.hi - box.lo;
    return std::fmax(size.x, std::fmax(size.y, size.z));
}

/// Leaves that a packet may visit before its rays are told to go alone.
constexpr int kMostLeaves = 24;

template <bool kOneOrigin>
TRG_FN bool search_soup(const Soup& soup, const RayPacket& packet, PacketSearch& search) {
    const CornerBlock* blocks = soup.corner_blocks.data();
    int visits = 0;
    const auto visit = [&](uint32_t k) {
        test_closest<kOneOrigin>(blocks[k], packet, search);
        return ++visits > kMostLeaves;
    };
    return !walk_nodes<true, QuickBoxTest>(soup.tree, packet.bounds, &search.limit, visit);
}

/// Finds the best hits; false when the rays part too much: then what was found is not the end of
/// it.
TRG_FN bool search_soup(const Soup& soup, const RayPacket& packet, PacketSearch& search) {
    return packet.spread == 0 ? search_soup<true>(soup, packet, search)
                              : search_soup<false>(soup, packet, search);
}

template <bool kOneOrigin>
TRG_FN bool hide_soup(const Soup& soup, const RayPacket& packet, float limit, uint32_t* hidden) {
    const CornerBlock* blocks = soup.corner_blocks.data();
    int visits = 0;
    const auto visit = [&](uint32_t k) {
        test_any<kOneOrigin>(blocks[k], packet, hidden);
        return *hidden == kWholePacket || ++visits > kMostLeaves;
    };
    return !walk_nodes<false, QuickBoxTest>(soup.tree, packet.bounds, &limit, visit) ||
           *hidden == kWholePacket;
}

/// Sets the bits of `hidden` whose rays meet the soup; false when not all of them were found.
TRG_FN bool hide_soup(const Soup& soup, const RayPacket& packet, uint32_t* hidden) {
    float limit = 0;
    for (const float t : packet.t_max) limit = std::fmax(limit, t * kFarFactor);
    return packet.spread == 0 ? hide_soup<true>(soup, packet, limit, hidden)
                              : hide_soup<false>(soup, packet, limit, hidden);
}

}  // namespace trg::TRG_ISA
