// Receptions lost to interference, by receiver and interfering node.
//
// In a large network, the counter of a pair is not in a cache, and waiting for it would take longer
// than all other work for a loss. So losses are first stored in a list, and then counted several
// hundred at a time with prefetched counters (kernel/prefetch.hpp).
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <vector>

#include "netsim/node_id.hpp"

namespace netsim {

class Interferers {
public:
    void add_node() { counts_.emplace_back(); }
    std::size_t node_count() const { return counts_.size(); }

    // A reception was lost at `receiver` because of each of `nodes`.
    void note(NodeId receiver, std::span<const NodeId> nodes);
    // {interfering node: receptions lost at `receiver` because of it}
    std::map<NodeId, std::uint64_t> at(NodeId receiver) const;

private:
    struct Pair {
        NodeId receiver = 0;
        NodeId node = 0;
    };
    struct Count {
        NodeId node = 0;
        // 32 bits, since there are many pairs. Overflow would take years of simulated time.
        std::uint32_t copies = 0;
    };

    void count_noted();

    // [receiver], sorted by node. Maps would need four times the memory.
    std::vector<std::vector<Count>> counts_;
    std::vector<Pair> noted_;  // not counted yet
};

}  // namespace netsim
