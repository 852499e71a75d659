// Identifies a node. Nodes are numbered from 0, in the order in which they were added to their
// network.
#pragma once

#include <cstdint>

namespace netsim {

using NodeId = std::int32_t;
constexpr NodeId broadcast_id = -1;

}  // namespace netsim
