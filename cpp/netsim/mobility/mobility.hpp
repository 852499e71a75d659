// How a node obeys mobility commands. Plans, such as random waypoints, are no models: protocols make them.
//
// A model turns commands into legs of a Trajectory. Models are chosen by name in make_mobility;
// docs/guides/extending.md says what adding one takes.
#pragma once

#include <memory>

#include "netsim/config/mobility_config.hpp"
#include "netsim/mobility/trajectory.hpp"

namespace netsim {

class Mobility {
public:
    virtual ~Mobility() = default;

    // Fly to `target` (metres). Throws SimulationError if the model cannot, or for numbers that are not
    // finite.
    virtual void go_to(SimTime now, Position target) = 0;
    // From now on, also on the present leg, fly at `speed_mps` ≥ 0.
    virtual void set_speed(SimTime now, double speed_mps) = 0;

    // Whether it ever obeys.
    virtual bool can_move() const { return true; }

    const Trajectory& trajectory() const { return trajectory_; }

protected:
    explicit Mobility(Position initial) : trajectory_(initial) {}

    Trajectory trajectory_;
};

// config.type_name must be in the table: see MobilityConfig::validate.
std::unique_ptr<Mobility> make_mobility(const MobilityConfig& config, Position initial);

}  // namespace netsim
