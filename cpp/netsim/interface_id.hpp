// A network interface of a node by its name: wlan[index] of that node.
#pragma once

#include <compare>
#include <cstdint>

#include "netsim/node_id.hpp"

namespace netsim {

struct InterfaceId {
    NodeId node = 0;
    std::int32_t index = 0;

    auto operator<=>(const InterfaceId&) const = default;

    // Its name in random streams. That of a node's first interface is the node's own, whatever other interfaces there
    // are: those of wlan[1] leave the draws of wlan[0], and of all other nodes, unchanged.
    std::uint32_t stream() const {
        return static_cast<std::uint32_t>(node) | static_cast<std::uint32_t>(index) << node_bits;
    }

    // The one whose name that is.
    static InterfaceId of_stream(std::uint32_t stream) {
        return {static_cast<NodeId>(stream & (most_nodes - 1)),
                static_cast<std::int32_t>(stream >> node_bits)};
    }

    static constexpr int node_bits = 24;
    static constexpr std::int32_t most_nodes = std::int32_t{1} << node_bits;
};

// Radios are numbered 0, 1, … in the order in which they are attached to a medium. Who has one radio at each node may
// take it for the node's id.
using RadioId = std::int32_t;

}  // namespace netsim
