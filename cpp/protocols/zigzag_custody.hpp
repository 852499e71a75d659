// Custody of data over a lossy channel: examples/zigzag/custody.py in C++.
//
// A message contains the total number of readings that its sender has handed to the receiver so far.
// The receiver adds the difference to the last total. So a duplicate adds nothing, and the next
// message makes up for a lost one.
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
    void add_reading() { ++held_; }
    // The total number of readings handed to `peer` so far, for messages to it.
    std::int64_t given_to(NodeId peer) const {
        const auto found = given_.find(peer);
        return found == given_.end() ? 0 : found->second;
    }
    // Hands all readings to `peer`, as of the next message to it.
    void give_all(NodeId peer) { given_[peer] += std::exchange(held_, 0); }
    // Takes the new readings of a message from `peer` with the total `given`. Returns their number.
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
