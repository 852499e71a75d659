// A node that never moves. A command to move it is an error of its protocol.
#pragma once

#include "netsim/error.hpp"
#include "netsim/mobility/mobility.hpp"

namespace netsim {

class StationaryMobility final : public Mobility {
public:
    explicit StationaryMobility(Position initial) : Mobility(initial) {}

    void go_to(SimTime, Position) override { refuse(); }
    void set_speed(SimTime, double) override { refuse(); }
    bool can_move() const override { return false; }

private:
    [[noreturn]] static void refuse() {
        throw SimulationError(
            "a node with StationaryMobility cannot be moved: give it a mobility.typename that can move");
    }
};

}  // namespace netsim
