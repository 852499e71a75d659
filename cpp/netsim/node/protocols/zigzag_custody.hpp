// Who holds which data, when messages can be lost: examples/zigzag/custody.py, natively.
//
// A message says how much its sender has handed to the receiver so far, in all. The receiver takes what is new to it,
// so a message that comes twice adds nothing, and a lost one is made good by the next that gets through.
#pragma once

#include <algorithm>
#include <cstdint>
#include <map>
#include <utility>

#include "netsim/mac/frame.hpp"

namespace netsim::zigzag {

class Custody {
public:
    std::int64_t held() const { return held_; }
    // One more reading.
    void add_reading() { ++held_; }
    // Readings handed to `peer` so far, in all: what a message to it says.
    std::int64_t given_to(NodeId peer) const {
        const auto found = given_.find(peer);
        return found == given_.end() ? 0 : found->second;
    }
    // Hands everything to `peer`: the next message to it will say so.
    void give_all(NodeId peer) { given_[peer] += std::exchange(held_, 0); }
    // Takes what is new in a message of `peer` that has `given` so many in all; returns how many.
    std::int64_t take(NodeId peer, std::int64_t given) {
        std::int64_t& taken = taken_[peer];
        const std::int64_t added = std::max<std::int64_t>(0, given - taken);
        taken += added;
        held_ += added;
        return added;
    }

private:
    std::int64_t held_ = 0;
    std::map<NodeId, std::int64_t> given_;
    std::map<NodeId, std::int64_t> taken_;
};

}  // namespace netsim::zigzag
