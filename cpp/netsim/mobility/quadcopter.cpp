#include "netsim/mobility/quadcopter.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace netsim {

namespace {

constexpr double gravity_mps2 = 9.80665;

// The vehicle: see gradysim.motion.quadcopter.
constexpr double mass_kg = 2.0;
constexpr Position inertia_kgm2{0.03, 0.03, 0.05};
constexpr double arm_m = 0.25;
constexpr double hover_thrust = 0.35;
constexpr double torque_m = 0.02;
constexpr double rotation_drag_nms = 0.05;
constexpr double friction = 0.5;
constexpr double max_thrust_n = mass_kg * gravity_mps2 / (4 * hover_thrust);
const double lever_m = arm_m * std::sqrt(0.5);

// The controller: see gradysim.motion.flight_controller.
constexpr double braking_share = 0.8;
constexpr double climb_mps = 2.5;
constexpr double descent_mps = 1.5;
constexpr double least_height_m = 0.5;
constexpr double above_target_m = 1.0;
constexpr double position_gain = 0.9;
constexpr double velocity_gain = 3.0;
constexpr double attitude_gain = 8.0;
constexpr double rate_gain = 25.0;
constexpr double max_rate_radps = 3.0;
constexpr double drag_time_s = 0.5;
const double tan_tilt = std::tan(30 * (std::numbers::pi / 180));
constexpr double least_lift_mps2 = 0.3 * gravity_mps2;
constexpr double filter = Quadcopter::step_s / drag_time_s;
const double roll_n = inertia_kgm2.x * rate_gain / (4 * lever_m);
const double pitch_n = inertia_kgm2.y * rate_gain / (4 * lever_m);
constexpr double yaw_n = inertia_kgm2.z * rate_gain / (4 * torque_m);
constexpr double max_yaw_n = 1.0;

double limited(double value, double limit) {
    return std::clamp(value, -limit, limit);
}

}  // namespace

Quadcopter::Quadcopter(Position start, double speed_mps, const Airframe& airframe, const Wind& wind)
    : position_{start.x, start.y, 0.0 - start.z},
      target_(position_),
      speed_mps_(speed_mps),
      acceleration_mps2_(airframe.acceleration_mps2),
      braking_mps2_(braking_share * airframe.acceleration_mps2),
      linear_m_(braking_mps2_ / (position_gain * position_gain)),
      drag_per_s_(airframe.drag_kgps / mass_kg),
      wind_(wind) {}

double Quadcopter::tilt_rad() const {
    const auto [w, x, y, z] = attitude_;
    return std::acos(std::clamp(1 - 2 * (x * x + y * y), -1.0, 1.0));
}

void Quadcopter::step(GaussMarkov* position_error) {
    const std::array<double, 4> thrusts = motors(thrust(position_error));
    turn(thrusts);
    move(thrusts[0] + thrusts[1] + thrusts[2] + thrusts[3]);
}

double Quadcopter::approach_mps(double distance_m, double limit_mps) const {
    const double speed = distance_m > linear_m_ ? std::sqrt(2 * braking_mps2_ * (distance_m - linear_m_ / 2))
                                                : position_gain * distance_m;
    return std::min(speed, limit_mps);
}

Quadcopter::Thrust Quadcopter::thrust(GaussMarkov* position_error) {
    const double time_s = static_cast<double>(steps_) / 100;
    ++steps_;
    Position here = position_;
    if (position_error != nullptr) {
        const Position error = position_error->at(time_s);
        here = {here.x + error.x, here.y + error.y, here.z - error.z};
    }

    // Velocity that the position asks for.
    const double delta_north = target_.x - here.x;
    const double delta_east = target_.y - here.y;
    const double distance = std::sqrt(delta_north * delta_north + delta_east * delta_east);
    const bool stays_up = distance > above_target_m && target_.z > -least_height_m;
    const double delta_down = (stays_up ? -least_height_m : target_.z) - here.z;
    const double pace = distance > 0 ? approach_mps(distance, speed_mps_) / distance : 0.0;
    const double sink = delta_down < 0 ? -approach_mps(-delta_down, std::min(climb_mps, speed_mps_))
                                       : approach_mps(delta_down, std::min(descent_mps, speed_mps_));

    // Acceleration that the velocity asks for.
    double north = velocity_gain * (pace * delta_north - velocity_.x);
    double east = velocity_gain * (pace * delta_east - velocity_.y);
    double down = velocity_gain * (sink - velocity_.z);
    double size = std::sqrt(north * north + east * east);
    if (size > acceleration_mps2_) {
        north *= acceleration_mps2_ / size;
        east *= acceleration_mps2_ / size;
    }
    down = limited(down, acceleration_mps2_);

    // Thrust against gravity, and against wind and drag.
    air_mps_ = wind_.velocity_mps(time_s);
    drag_mps2_.x += filter * (drag_per_s_ * (air_mps_.x - velocity_.x) - drag_mps2_.x);
    drag_mps2_.y += filter * (drag_per_s_ * (air_mps_.y - velocity_.y) - drag_mps2_.y);
    drag_mps2_.z += filter * (drag_per_s_ * (air_mps_.z - velocity_.z) - drag_mps2_.z);
    north -= drag_mps2_.x;
    east -= drag_mps2_.y;
    const double lift = std::max(gravity_mps2 + drag_mps2_.z - down, least_lift_mps2);
    size = std::sqrt(north * north + east * east);
    if (size > tan_tilt * lift) {
        north *= tan_tilt * lift / size;
        east *= tan_tilt * lift / size;
    }
    return {north, east, lift};
}

std::array<double, 4> Quadcopter::motors(const Thrust& wanted) const {
    const auto [north, east, lift] = wanted;
    const auto [w, x, y, z] = attitude_;
    const double length = std::sqrt(north * north + east * east + lift * lift);
    const double forward_east = 2 * (x * y + w * z);
    const double forward =
        (1 - 2 * (y * y + z * z)) * north + forward_east * east - 2 * (x * z - w * y) * lift;
    const double right =
        2 * (x * y - w * z) * north + (1 - 2 * (x * x + z * z)) * east - 2 * (y * z + w * x) * lift;
    const double along =
        (1 - 2 * (x * x + y * y)) * lift - 2 * (x * z + w * y) * north - 2 * (y * z - w * x) * east;
    const double roll = roll_n * (limited(attitude_gain * right / length, max_rate_radps) - rates_.x);
    const double pitch = pitch_n * (limited(-attitude_gain * forward / length, max_rate_radps) - rates_.y);
    const double yaw = limited(yaw_n * (-attitude_gain * forward_east - rates_.z), max_yaw_n);
    const double each = along * mass_kg / 4;
    return {std::clamp(each - roll + pitch + yaw, 0.0, max_thrust_n),
            std::clamp(each + roll - pitch + yaw, 0.0, max_thrust_n),
            std::clamp(each + roll + pitch - yaw, 0.0, max_thrust_n),
            std::clamp(each - roll - pitch - yaw, 0.0, max_thrust_n)};
}

void Quadcopter::turn(const std::array<double, 4>& motors_n) {
    const auto [front_right, rear_left, front_left, rear_right] = motors_n;
    const double roll = lever_m * (rear_left + front_left - front_right - rear_right);
    const double pitch = lever_m * (front_right + front_left - rear_left - rear_right);
    const double yaw = torque_m * (front_right + rear_left - front_left - rear_right);
    const auto [ix, iy, iz] = inertia_kgm2;
    const auto [p, q, r] = rates_;
    rates_ = {p + step_s * (roll - rotation_drag_nms * p - (iz - iy) * q * r) / ix,
              q + step_s * (pitch - rotation_drag_nms * q - (ix - iz) * r * p) / iy,
              r + step_s * (yaw - rotation_drag_nms * r - (iy - ix) * p * q) / iz};
    const auto [roll_rate, pitch_rate, yaw_rate] = rates_;
    const auto [w, x, y, z] = attitude_;
    const double half = step_s / 2;
    const std::array<double, 4> turned{w - half * (x * roll_rate + y * pitch_rate + z * yaw_rate),
                                       x + half * (w * roll_rate + y * yaw_rate - z * pitch_rate),
                                       y + half * (w * pitch_rate - x * yaw_rate + z * roll_rate),
                                       z + half * (w * yaw_rate + x * pitch_rate - y * roll_rate)};
    const double length = std::sqrt(turned[0] * turned[0] + turned[1] * turned[1] + turned[2] * turned[2] +
                                    turned[3] * turned[3]);
    attitude_ = {turned[0] / length, turned[1] / length, turned[2] / length, turned[3] / length};
}

void Quadcopter::move(double thrust_n) {
    const auto [w, x, y, z] = attitude_;
    const double lift = -thrust_n / mass_kg;
    const double a_north = 2 * (x * z + w * y) * lift - drag_per_s_ * (velocity_.x - air_mps_.x);
    const double a_east = 2 * (y * z - w * x) * lift - drag_per_s_ * (velocity_.y - air_mps_.y);
    const double a_down = (1 - 2 * (x * x + y * y)) * lift - drag_per_s_ * (velocity_.z - air_mps_.z);
    const double north = velocity_.x + a_north * step_s;
    const double east = velocity_.y + a_east * step_s;
    const double sink = velocity_.z + (a_down + gravity_mps2) * step_s;
    if (position_.z + sink * step_s >= 0 && sink >= 0) {
        slide(north, east);
        return;
    }
    velocity_ = {north, east, sink};
    position_ = {position_.x + north * step_s, position_.y + east * step_s, position_.z + sink * step_s};
}

// Is on the ground, level, with the heading that it had; loses speed by friction, or stands.
void Quadcopter::slide(double north, double east) {
    const auto [w, x, y, z] = attitude_;
    const double heading = std::atan2(2 * (x * y + w * z), 1 - 2 * (y * y + z * z));
    attitude_ = {std::cos(heading / 2), 0, 0, std::sin(heading / 2)};
    rates_ = {};
    const double speed = std::hypot(north, east);
    const double lost = friction * gravity_mps2 * step_s;
    const double kept = speed > lost ? 1 - lost / speed : 0.0;
    velocity_ = {kept * north, kept * east, 0};
    position_ = {position_.x + kept * north * step_s, position_.y + kept * east * step_s, 0};
}

}  // namespace netsim
