// The kind and the destination of a frame, for the ledger. Part of its transmission.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "netsim/node_id.hpp"

namespace netsim {

enum class FrameKind : std::uint8_t { broadcast, unicast, ack, rts, cts };
constexpr std::size_t frame_kind_count = 5;
constexpr std::array<const char*, frame_kind_count> frame_kind_names{"broadcast", "unicast", "ack", "rts",
                                                                     "cts"};

struct FrameLabel {
    FrameKind kind = FrameKind::broadcast;
    NodeId destination = broadcast_id;

    bool is_for(NodeId node) const { return destination == node || destination == broadcast_id; }
};

}  // namespace netsim
