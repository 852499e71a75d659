// The orientation of a body: a rotation from its own coordinate frame to the scene's. Used for nodes
// and antennas.
//
// The angles are INET's heading, elevation and bank (OMNeT++'s INET framework, MobilityBase).
// Without rotation, a body faces along x with z up. It is rotated about z by the heading (x toward
// y), then about its own y axis by the elevation (nose up), then about its own x axis by the bank
// (y toward z).
#pragma once

#include "netsim/geometry/position.hpp"

namespace netsim {

struct EulerAngles {
    double heading_rad = 0;
    double elevation_rad = 0;
    double bank_rad = 0;

    constexpr bool operator==(const EulerAngles&) const = default;
};

class Orientation {
public:
    // Without rotation.
    constexpr Orientation() = default;
    explicit Orientation(const EulerAngles& angles);

    // Faces along `direction`, of any length > 0, without bank. For straight up and down, the
    // heading is 0.
    static Orientation facing(const Position& direction);

    Position to_scene(const Position& own) const { return own.x * x_ + own.y * y_ + own.z * z_; }
    Position to_own(const Position& scene) const {
        return {dot_product(x_, scene), dot_product(y_, scene), dot_product(z_, scene)};
    }

    // The orientation of a part mounted on this body. `offset`: relative to the body.
    Orientation mounted(const Orientation& offset) const {
        return {to_scene(offset.x_), to_scene(offset.y_), to_scene(offset.z_)};
    }

private:
    constexpr Orientation(const Position& x, const Position& y, const Position& z) : x_(x), y_(y), z_(z) {}

    // The axes of the body, in the scene.
    Position x_{1, 0, 0};
    Position y_{0, 1, 0};
    Position z_{0, 0, 1};
};

}  // namespace netsim
