// A node that never moves. A command to move it is an error of its protocol.
#pragma once

#include "netsim/mobility/mobility.hpp"

namespace netsim {

class StationaryMobility final : public Mobility {
public:
    explicit StationaryMobility(Position initial) : Mobility(initial) {}

    bool can_move() const override { return false; }
};

}  // namespace netsim
