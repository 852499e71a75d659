// A vehicle without inertia: it moves straight to the target at the set speed, and stops there at
// once.
#pragma once

#include <optional>

#include "netsim/mobility/mobility.hpp"

namespace netsim {

class MasslessMobility final : public Mobility {
public:
    MasslessMobility(Position initial, double speed_mps) : Mobility(initial), speed_mps_(speed_mps) {}

private:
    void turn_to(SimTime now, Position target) override;
    void change_speed(SimTime now, double speed_mps) override;

    double speed_mps_;
    std::optional<Position> target_;
};

}  // namespace netsim
