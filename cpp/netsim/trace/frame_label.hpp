// Kind, destination and number of a frame, for the counts of outcomes. Part of its transmission.
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

// Transmitted frames are numbered 0, 1, 2, … in the order of their starts.
using FrameNumber = std::uint64_t;

struct FrameLabel {
    FrameKind kind = FrameKind::broadcast;
    NodeId destination = broadcast_id;
    FrameNumber number = 0;  // set when the transmission starts

    bool is_for(NodeId node) const { return destination == node || destination == broadcast_id; }
};

}  // namespace netsim
