// The antennas of all nodes: what both ends of a link add to it, or take from it. Used by the medium.
#pragma once

#include <vector>

#include "netsim/medium/antenna_pattern.hpp"
#include "netsim/medium/transmission.hpp"

namespace netsim {

class Antennas {
public:
    // Those of nodes 0, 1, … The trajectory is the node's.
    void add(const MountedAntenna& antenna, const Trajectory& trajectory) {
        all_isotropic_ = all_isotropic_ && antenna.pattern == nullptr;
        mounted_.push_back({antenna, &trajectory});
    }

    // Then every gain is 1.
    bool all_isotropic() const { return all_isotropic_; }
    double max_gain(NodeId node) const { return mounted_[node].antenna.max_gain(); }

    // Of the sender towards the receiver, and of the receiver, at `place` when the transmission starts, towards the
    // sender. Both are turned as they are at that time.
    double gain(const Transmission& sent, NodeId receiver, const Position& place) const {
        const Mounted& there = mounted_[receiver];
        const Mounted& here = mounted_[sent.sender];
        const Position way = place - sent.origin;
        return here.antenna.gain_towards(way, *here.trajectory, sent.start) *
               there.antenna.gain_towards(way * -1, *there.trajectory, sent.start);
    }

private:
    struct Mounted {
        MountedAntenna antenna;
        const Trajectory* trajectory;
    };

    std::vector<Mounted> mounted_;
    bool all_isotropic_ = true;
};

}  // namespace netsim
