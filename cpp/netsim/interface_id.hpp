// Identifies a network interface: wlan[index] of a node.
#pragma once

#include <compare>
#include <cstdint>

#include "netsim/node_id.hpp"

namespace netsim {

struct InterfaceId {
    NodeId node = 0;
    std::int32_t index = 0;

    auto operator<=>(const InterfaceId&) const = default;

    // Its number in random streams. For wlan[0] it is the node's own, so adding wlan[1] leaves the
    // draws of wlan[0] and of all other nodes unchanged.
    std::uint32_t stream() const {
        return static_cast<std::uint32_t>(node) | static_cast<std::uint32_t>(index) << node_bits;
    }

    // The interface with that stream number.
    static InterfaceId of_stream(std::uint32_t stream) {
        return {static_cast<NodeId>(stream & (max_nodes - 1)),
                static_cast<std::int32_t>(stream >> node_bits)};
    }

    static constexpr int node_bits = 24;
    static constexpr std::int32_t max_nodes = std::int32_t{1} << node_bits;
};

// Radios are numbered 0, 1, … in the order in which they are attached to a medium. If every node
// has one radio, its id is the node's id.
using RadioId = std::int32_t;

}  // namespace netsim
