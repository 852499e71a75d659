// A body with vertical walls, a level floor and a level roof: the model of a building.
//
// Its footprint consists of closed rings, in either direction. A ring within another is a courtyard
// (even-odd rule). Used by the obstacles to find the parts of a segment that are inside.
//
// The body is open: what touches a wall, the roof or the floor, or runs along it, is not inside.
// "Touching" is within `touch_m`, a few times the rounding of the scene's largest coordinates, so
// that a segment along a wall at any angle touches it. Sides are computed per corner, so that a
// segment through a corner enters and leaves consistently.
#pragma once

#include <array>
#include <limits>
#include <vector>

#include "netsim/geometry/position.hpp"

namespace netsim {

using Corner = std::array<double, 2>;  // x, y in m
using Ring = std::vector<Corner>;      // at least 3 corners; the last is joined to the first

// One stretch of a segment inside a body, from its entry to its exit.
struct Stretch {
    static constexpr double no_face = -1;

    double length_m = 0;
    // Cosine of the angle between the segment and the normal of the face that it passes. no_face
    // where the segment itself begins or ends.
    double entry_cosine = no_face;
    double exit_cosine = no_face;
};

// The result of Prism::cross, with its working memory, which is reused.
class Crossing {
public:
    const std::vector<Stretch>& stretches() const { return stretches_; }

private:
    friend class Prism;

    struct Vertex {
        double along;   // as a fraction of the segment
        double side_m;  // signed distance from its line in the plane
    };
    struct Wall {
        double along;
        double cosine;
    };

    std::vector<Vertex> vertices_;
    // Where the line passes walls if it is shifted infinitesimally to the left, or to the right.
    std::vector<Wall> left_;
    std::vector<Wall> right_;
    std::vector<Stretch> stretches_;
};

class Prism {
public:
    static constexpr double touch_m = 1e-8;

    // Rings of at least 3 corners; base_m < top_m.
    Prism(std::vector<Ring> rings, double base_m, double top_m);

    // Finds the stretches of the segment from `a` to `b` that are inside, by distance from `a`.
    void cross(const Position& a, const Position& b, Crossing& crossing) const;

    // Corners of its bounding box.
    Position lowest() const { return lowest_; }
    Position highest() const { return highest_; }

private:
    struct Clip {
        double begin;
        double end;
        double cosine;  // of the floor and the roof
    };

    void cross_walls(const Position& a, const Position& b, Crossing& crossing) const;
    bool is_over_footprint(double x, double y) const;

    std::vector<Ring> rings_;
    Position lowest_;
    Position highest_;
};

}  // namespace netsim
