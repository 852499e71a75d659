// Whose frames spoiled others, by receiver: for each pair of a receiver and an interfering node, how many copies.
//
// In a large network the numbers of a pair are in no cache when they are needed, and to wait for them takes longer than
// the loss of a copy did otherwise. So losses are noted one after the other, and counted several hundred at a time: what that
// touches is asked for in one go (kernel/fetch.hpp).
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

    // A copy was lost at `receiver` with the help of each of `nodes`.
    void note(NodeId receiver, std::span<const NodeId> nodes);
    // {interfering node: copies lost at `receiver` with its help}
    std::map<NodeId, std::uint64_t> at(NodeId receiver) const;

private:
    struct Pair {
        NodeId receiver = 0;
        NodeId node = 0;
    };
    struct Count {
        NodeId node = 0;
        // In 32 bits, as there are many pairs of nodes: so many copies of one take years of frames.
        std::uint32_t copies = 0;
    };

    void count_noted();

    // [receiver], by node: maps would take four times as much.
    std::vector<std::vector<Count>> counts_;
    std::vector<Pair> noted_;  // and not counted yet
};

}  // namespace netsim
