// Mobility models: how a node follows mobility commands, or the path of its configuration. Plans, such
// as random waypoints, are made by protocols.
//
// A model makes the legs of a Trajectory. make_mobility chooses models by name. To add
// one, see docs/contributing/change-the-simulator.md.
#pragma once

#include <memory>

#include "netsim/config/mobility_config.hpp"
#include "netsim/mobility/trajectory.hpp"

namespace netsim {

class Mobility {
public:
    virtual ~Mobility() = default;

    // Fly to `target` (meters). Throws SimulationError if the model cannot, or if a number is not
    // finite.
    virtual void go_to(SimTime now, Position target) = 0;
    // Fly at `speed_mps` ≥ 0 from now on, also on the current leg.
    virtual void set_speed(SimTime now, double speed_mps) = 0;

    // Whether the model accepts commands.
    virtual bool can_move() const { return true; }

    // Begins the next leg of a given path and returns when it ends; never() if there is none. Called
    // at the start of the run and at each end.
    virtual SimTime begin_leg(SimTime) { return SimTime::never(); }

    const Trajectory& trajectory() const { return trajectory_; }

protected:
    explicit Mobility(Position initial) : trajectory_(initial) {}

    // For models that accept no commands.
    [[noreturn]] static void refuse();

    Trajectory trajectory_;
};

// config.type_name must be valid: see MobilityConfig::validate. `initial`: as for make_path.
std::unique_ptr<Mobility> make_mobility(const MobilityConfig& config, Position initial);

}  // namespace netsim
