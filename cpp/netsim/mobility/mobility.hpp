// Mobility models: how a node follows mobility commands, or the path of its configuration. Plans, such
// as random waypoints, are made by protocols.
//
// A model makes the legs of a Trajectory. make_mobility chooses models by name. To add
// one, see docs/contributing/change-the-simulator.md.
#pragma once

#include <cstdint>
#include <memory>
#include <utility>

#include "netsim/config/mobility_config.hpp"
#include "netsim/config/wind_config.hpp"
#include "netsim/mobility/gauss_markov.hpp"
#include "netsim/mobility/trajectory.hpp"

namespace netsim {

class Mobility {
public:
    virtual ~Mobility() = default;

    // Fly to `target` (meters). Throws SimulationError as check_target does.
    void go_to(SimTime now, Position target) {
        check_target(target);
        turn_to(now, target);
    }
    // Fly at `speed_mps` ≥ 0 from now on, also on the current leg. Throws SimulationError as check_speed does.
    void set_speed(SimTime now, double speed_mps) {
        check_speed(speed_mps);
        change_speed(now, speed_mps);
    }
    // Throw SimulationError for a command that the model cannot carry out, or with a number that is not
    // finite or out of range.
    void check_target(Position target) const;
    void check_speed(double speed_mps) const;

    // Whether the model accepts commands.
    virtual bool can_move() const { return true; }

    // Begins the next leg of a given path and returns when it ends; never() if there is none. Called
    // at the start of the run and at each end.
    virtual SimTime begin_leg(SimTime) { return SimTime::never(); }

    // Whether its motion is computed step by step, by fly().
    virtual bool flies() const { return false; }
    // Flies from `now` to the next update, `until`.
    virtual void fly(SimTime, SimTime) {}

    const Trajectory& trajectory() const { return trajectory_; }
    void set_position_error(std::unique_ptr<GaussMarkov> error) { position_error_ = std::move(error); }
    // The position that telemetry reports. `now` does not decrease from call to call.
    Position reported_position(SimTime now) {
        const Position here = trajectory_.position_at(now);
        return position_error_ ? here + position_error_->at(now.seconds()) : here;
    }

protected:
    explicit Mobility(Position initial) : trajectory_(initial) {}

    // Commands, checked. Only for models that accept them.
    virtual void turn_to(SimTime, Position) {}
    virtual void change_speed(SimTime, double) {}
    // Null if there is none.
    GaussMarkov* position_error() { return position_error_.get(); }

    Trajectory trajectory_;

private:
    void check_accepts_commands() const;

    std::unique_ptr<GaussMarkov> position_error_;
};

// config.type_name must be valid: see MobilityConfig::validate. `initial`: as for make_path. `seed` and
// `node` name the random streams.
std::unique_ptr<Mobility> make_mobility(const MobilityConfig& config, Position initial,
                                        const WindConfig& wind = {}, std::uint64_t seed = 0,
                                        std::uint32_t node = 0);

}  // namespace netsim
