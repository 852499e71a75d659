// A point, or the difference of two points, in the scene's Cartesian frame: meters, z up.
#pragma once

#include <cmath>

namespace netsim {

// The largest absolute coordinate. Beyond it, the propagation delay could exceed Trajectory::memory.
inline constexpr double largest_coordinate_m = 1e7;

struct Position {
    double x = 0;
    double y = 0;
    double z = 0;

    constexpr bool operator==(const Position&) const = default;
};

constexpr Position operator+(const Position& a, const Position& b) {
    return {a.x + b.x, a.y + b.y, a.z + b.z};
}
constexpr Position operator-(const Position& a, const Position& b) {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
}
constexpr Position operator*(const Position& a, double factor) {
    return {a.x * factor, a.y * factor, a.z * factor};
}
constexpr Position operator*(double factor, const Position& a) {
    return a * factor;
}

constexpr double dot_product(const Position& a, const Position& b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

// In m². Cheaper than distance, and sufficient for comparisons and for path loss.
constexpr double squared_distance(const Position& a, const Position& b) {
    const Position d = a - b;
    return d.x * d.x + d.y * d.y + d.z * d.z;
}

// Whether all coordinates are finite and within the scene.
inline bool is_in_scene(const Position& p) {
    const auto is_inside = [](double coordinate) { return std::abs(coordinate) <= largest_coordinate_m; };
    return is_inside(p.x) && is_inside(p.y) && is_inside(p.z);
}

inline double distance(const Position& a, const Position& b) {
    return std::sqrt(squared_distance(a, b));
}

}  // namespace netsim
