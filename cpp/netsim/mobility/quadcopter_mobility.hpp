// A quadcopter that flies to the targets of its protocol: it has to speed up, to tilt and to brake.
// One leg of its trajectory is one update; see Network's FlightClock.
#pragma once

#include "netsim/mobility/mobility.hpp"
#include "netsim/mobility/quadcopter.hpp"

namespace netsim {

class QuadcopterMobility final : public Mobility {
public:
    QuadcopterMobility(Position initial, double speed_mps, const Airframe& airframe, const Wind& wind)
        : Mobility(initial), vehicle_(initial, speed_mps, airframe, wind) {}

    bool flies() const override { return true; }
    void fly(SimTime now, SimTime until) override;

private:
    void turn_to(SimTime, Position target) override { vehicle_.go_to(target); }
    void change_speed(SimTime, double speed_mps) override { vehicle_.set_speed(speed_mps); }

    Quadcopter vehicle_;
};

}  // namespace netsim
