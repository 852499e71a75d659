#include "netsim/geometry/orientation.hpp"

#include <cmath>

namespace netsim {

// H. Goldstein, "Classical Mechanics", 1980, appendix B (xyz convention, Tait-Bryan angles); an
// elevation is the negative of the angle about y.
Orientation::Orientation(const EulerAngles& angles) {
    const double heading_cos = std::cos(angles.heading_rad);
    const double heading_sin = std::sin(angles.heading_rad);
    const double elevation_cos = std::cos(angles.elevation_rad);
    const double elevation_sin = std::sin(angles.elevation_rad);
    const double bank_cos = std::cos(angles.bank_rad);
    const double bank_sin = std::sin(angles.bank_rad);
    // Without bank.
    const Position side{-heading_sin, heading_cos, 0};
    const Position up{-heading_cos * elevation_sin, -heading_sin * elevation_sin, elevation_cos};
    x_ = {heading_cos * elevation_cos, heading_sin * elevation_cos, elevation_sin};
    y_ = side * bank_cos + up * bank_sin;
    z_ = up * bank_cos - side * bank_sin;
}

Orientation Orientation::facing(const Position& direction) {
    const double length = std::hypot(direction.x, direction.y, direction.z);
    const Position x{direction.x / length, direction.y / length, direction.z / length};
    const double level = std::hypot(x.x, x.y);
    const double heading_cos = level > 0 ? x.x / level : 1;
    const double heading_sin = level > 0 ? x.y / level : 0;
    return {x, {-heading_sin, heading_cos, 0}, {-heading_cos * x.z, -heading_sin * x.z, level}};
}

}  // namespace netsim
