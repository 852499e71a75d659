// How a body is turned: a rotation from its own frame to that of the scene. A value; used for nodes and antennas.
//
// The angles are INET's heading, elevation and bank (OMNeT++'s INET framework, MobilityBase): a body that is not
// turned looks along x with z up; it is turned about z by the heading (x towards y), then about its own y axis by the
// elevation (the nose up), then about its own x axis by the bank (y towards z).
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
    // Not turned.
    constexpr Orientation() = default;
    explicit Orientation(const EulerAngles& angles);

    // Looks along `direction`, which is of any length but 0, with no bank. Straight up and down, the heading is 0.
    static Orientation facing(const Position& direction);

    Position to_scene(const Position& own) const { return own.x * x_ + own.y * y_ + own.z * z_; }
    Position to_own(const Position& scene) const {
        return {dot_product(x_, scene), dot_product(y_, scene), dot_product(z_, scene)};
    }

    // Of a part that is mounted on this body; `offset` is seen from the body.
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
