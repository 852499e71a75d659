#include "netsim/mobility/path.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

namespace netsim {
namespace {

constexpr double never_s = std::numeric_limits<double>::infinity();

// Motion along one axis between two walls.
class Bounce {
public:
    Bounce(double start_m, double speed_mps, double least_m, double most_m)
        : least_m_(least_m),
          room_m_(most_m - least_m),
          start_m_(start_m - least_m),
          speed_mps_(room_m_ > 0 ? speed_mps : 0) {}

    double at(double time_s) const {
        if (speed_mps_ == 0) {
            return least_m_ + start_m_;
        }
        const double unfolded_m = std::abs(std::remainder(start_m_ + speed_mps_ * time_s, 2 * room_m_));
        return least_m_ + std::min(unfolded_m, room_m_);
    }
    double next_turn_s(double time_s) const {
        if (speed_mps_ == 0) {
            return never_s;
        }
        const double walls = (start_m_ + speed_mps_ * time_s) / room_m_;
        const double next_wall = speed_mps_ > 0 ? std::floor(walls) + 1 : std::ceil(walls) - 1;
        return (next_wall * room_m_ - start_m_) / speed_mps_;
    }

private:
    double least_m_;
    double room_m_;
    double start_m_;  // above the least
    double speed_mps_;
};

class Linear final : public Path {
public:
    Linear(const MobilityConfig& config, Position initial)
        : axes_{axis(initial.x, config.area_min.x, config.area_max.x, config.speed_mps,
                     std::cos(config.movement_elevation_rad) * std::cos(config.movement_heading_rad)),
                axis(initial.y, config.area_min.y, config.area_max.y, config.speed_mps,
                     std::cos(config.movement_elevation_rad) * std::sin(config.movement_heading_rad)),
                axis(initial.z, config.area_min.z, config.area_max.z, config.speed_mps,
                     std::sin(config.movement_elevation_rad))} {}

    Position at(double time_s) const override {
        return {axes_[0].at(time_s), axes_[1].at(time_s), axes_[2].at(time_s)};
    }
    double next_turn_s(double time_s) const override {
        return std::min(
            {axes_[0].next_turn_s(time_s), axes_[1].next_turn_s(time_s), axes_[2].next_turn_s(time_s)});
    }

private:
    static Bounce axis(double start_m, double least_m, double most_m, double speed_mps, double share) {
        return {start_m, speed_mps * share, least_m, most_m};
    }

    std::array<Bounce, 3> axes_;
};

class Circle final : public Path {
public:
    explicit Circle(const MobilityConfig& config)
        : center_(config.center), radius_m_(config.radius_m), start_rad_(config.start_angle_rad) {
        constexpr double largest_gap_m = 0.01;
        constexpr double least_sides = 8;
        const double sides = radius_m_ > 10 * largest_gap_m
                                 ? std::max(least_sides, std::ceil(std::numbers::pi /
                                                                   std::acos(1 - largest_gap_m / radius_m_)))
                                 : least_sides;
        turn_rad_ = 2 * std::numbers::pi / sides;
        const bool moves = config.speed_mps > 0 && radius_m_ > 0;
        side_s_ = moves ? turn_rad_ * radius_m_ / config.speed_mps : never_s;
    }

    Position at(double time_s) const override {
        const double angle_rad = start_rad_ + time_s / side_s_ * turn_rad_;
        return center_ + Position{radius_m_ * std::cos(angle_rad), radius_m_ * std::sin(angle_rad), 0};
    }
    double next_turn_s(double time_s) const override { return (std::floor(time_s / side_s_) + 1) * side_s_; }

private:
    Position center_;
    double radius_m_;
    double start_rad_;
    double turn_rad_;  // at each corner
    double side_s_;
};

class Rectangle final : public Path {
public:
    Rectangle(const MobilityConfig& config, Position initial)
        : corner_{config.area_min.x, config.area_min.y, initial.z},
          width_m_(std::max(config.area_max.x - config.area_min.x, 0.0)),
          height_m_(std::max(config.area_max.y - config.area_min.y, 0.0)),
          speed_mps_(config.speed_mps) {
        const double start = std::fmod(config.start_pos, 4);
        const auto side = static_cast<std::size_t>(start);
        start_m_ =
            corners_m()[side] + (start - static_cast<double>(side)) * (side % 2 == 0 ? width_m_ : height_m_);
    }

    Position at(double time_s) const override {
        const std::array<double, 5> corners = corners_m();
        const double along_m = corners[4] > 0 ? std::fmod(start_m_ + speed_mps_ * time_s, corners[4]) : 0;
        if (along_m < corners[1]) {
            return corner_ + Position{along_m, 0, 0};
        }
        if (along_m < corners[2]) {
            return corner_ + Position{width_m_, along_m - corners[1], 0};
        }
        if (along_m < corners[3]) {
            return corner_ + Position{corners[3] - along_m, height_m_, 0};
        }
        return corner_ + Position{0, corners[4] - along_m, 0};
    }
    double next_turn_s(double time_s) const override {
        const std::array<double, 5> corners = corners_m();
        if (speed_mps_ == 0 || corners[4] == 0) {
            return never_s;
        }
        const double total_m = start_m_ + speed_mps_ * time_s;
        const double lap_m = std::floor(total_m / corners[4]) * corners[4];
        const auto* const corner = std::ranges::upper_bound(corners, total_m - lap_m);
        const double next_m = corner == corners.end() ? corners[4] + corners[1] : *corner;
        return (lap_m + next_m - start_m_) / speed_mps_;
    }

private:
    // The way from the first corner to each, and around.
    std::array<double, 5> corners_m() const {
        return {0, width_m_, width_m_ + height_m_, 2 * width_m_ + height_m_, 2 * (width_m_ + height_m_)};
    }

    Position corner_;
    double width_m_;
    double height_m_;
    double speed_mps_;
    double start_m_ = 0;
};

using Made = std::unique_ptr<Path>;

constexpr Factory<Made (*)(const MobilityConfig&, Position initial)> factories[] = {
    {"LinearMobility",
     [](const MobilityConfig& config, Position initial) -> Made {
         return std::make_unique<Linear>(config, initial);
     }},
    {"CircleMobility",
     [](const MobilityConfig& config, Position) -> Made { return std::make_unique<Circle>(config); }},
    {"RectangleMobility",
     [](const MobilityConfig& config, Position initial) -> Made {
         return std::make_unique<Rectangle>(config, initial);
     }},
};

}  // namespace

std::unique_ptr<Path> make_path(const MobilityConfig& config, Position initial) {
    return factory_of(config.type_name, factories)(config, initial);
}

}  // namespace netsim
