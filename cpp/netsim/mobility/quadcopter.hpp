// A quadcopter as a rigid body, and its controller, which flies it to targets. The arithmetic is that
// of gradysim.motion.quadcopter and flight_controller, in the same order: both modes fly the same
// path. Sources and reasons are there.
#pragma once

#include <array>
#include <cstdint>

#include "netsim/geometry/position.hpp"
#include "netsim/mobility/gauss_markov.hpp"
#include "netsim/mobility/wind.hpp"

namespace netsim {

// Limit on its acceleration in m/s², and the force of the air in N per m/s of airspeed.
struct Airframe {
    double acceleration_mps2;
    double drag_kgps;
};

class Quadcopter {
public:
    static constexpr double step_s = 0.01;

    // It hovers at `start` until it gets a target.
    Quadcopter(Position start, double speed_mps, const Airframe& airframe, const Wind& wind);

    // From the next step on.
    void go_to(Position target) { target_ = {target.x, target.y, 0.0 - target.z}; }
    void set_speed(double speed_mps) { speed_mps_ = speed_mps; }
    // Flies for step_s. The controller knows the position with this error, if there is one.
    void step(GaussMarkov* position_error);

    Position position() const { return {position_.x, position_.y, 0.0 - position_.z}; }
    // Between its downward axis and the vertical.
    double tilt_rad() const;

private:
    // Acceleration North and East that the thrust has to give, and the lift, as an acceleration.
    struct Thrust {
        double north;
        double east;
        double lift;
    };
    Thrust thrust(GaussMarkov* position_error);
    // The speed at a distance from the target with which it stops there, within a limit.
    double approach_mps(double distance_m, double limit_mps) const;
    // Thrusts of the motors: front right, rear left, front left, rear right; N.
    std::array<double, 4> motors(const Thrust& wanted) const;
    void turn(const std::array<double, 4>& motors_n);
    void move(double thrust_n);
    void slide(double north, double east);

    // North, East and down, as all vectors here; m and m/s.
    Position position_;
    Position velocity_{};
    std::array<double, 4> attitude_{1, 0, 0, 0};  // quaternion from the vehicle's frame to that of the world
    Position rates_{};                            // roll, pitch, yaw; rad/s

    Position target_;
    double speed_mps_;
    double acceleration_mps2_;
    double braking_mps2_;
    double linear_m_;  // distance to the target within which the speed is proportional to it
    double drag_per_s_;
    Wind wind_;
    Position air_mps_{};    // its velocity in this step
    Position drag_mps2_{};  // estimate
    std::int64_t steps_ = 0;
};

}  // namespace netsim
