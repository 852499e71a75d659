// Given paths, which follow from the configuration alone: positions in closed form, and the times of
// the turns. Between two turns a path is straight.
//
//   LinearMobility: straight on, reflected at the borders of the area.
//   CircleMobility: a regular polygon in the circle, whose sides are at most 1 cm inside of it.
//   RectangleMobility: along the border of the area in x and y, from the smallest x to the largest.
//
// Names and directions are INET's. python/gradysim/scenario/build/paths.py has the same paths for
// prototype mode.
#pragma once

#include <memory>

#include "netsim/config/mobility_config.hpp"
#include "netsim/geometry/position.hpp"

namespace netsim {

class Path {
public:
    virtual ~Path() = default;

    // The position at a turn, or anywhere on a straight part, in m.
    virtual Position at(double time_s) const = 0;
    // The first turn after that time; infinity if there is none.
    virtual double next_turn_s(double time_s) const = 0;
};

// The path of a type that has one, or null. `initial` counts as far as the type does not set it.
std::unique_ptr<Path> make_path(const MobilityConfig& config, Position initial);

}  // namespace netsim
