#include "netsim/geometry/prism.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace netsim {

namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

double distance_m(double x, double y, const Corner& from, const Corner& to) {
    const double along_x = to[0] - from[0];
    const double along_y = to[1] - from[1];
    const double squared = along_x * along_x + along_y * along_y;
    const double projected = (x - from[0]) * along_x + (y - from[1]) * along_y;
    const double share = squared > 0 ? std::clamp(projected / squared, 0.0, 1.0) : 0;
    return std::hypot(x - from[0] - share * along_x, y - from[1] - share * along_y);
}

}  // namespace

Prism::Prism(std::vector<Ring> rings, double base_m, double top_m)
    : rings_(std::move(rings)), lowest_{infinite, infinite, base_m}, highest_{-infinite, -infinite, top_m} {
    for (const Ring& ring : rings_) {
        for (const Corner& corner : ring) {
            lowest_.x = std::min(lowest_.x, corner[0]);
            lowest_.y = std::min(lowest_.y, corner[1]);
            highest_.x = std::max(highest_.x, corner[0]);
            highest_.y = std::max(highest_.y, corner[1]);
        }
    }
}

void Prism::cross(const Position& a, const Position& b, Crossing& crossing) const {
    crossing.stretches_.clear();
    const double length_m = distance(a, b);
    if (length_m <= touch_m) {
        return;
    }
    const double rise_m = b.z - a.z;
    Clip level{-infinite, infinite, Stretch::no_face};
    if (std::abs(rise_m) <= touch_m) {
        const double height_m = (a.z + b.z) / 2;
        if (height_m <= lowest_.z + touch_m || height_m >= highest_.z - touch_m) {
            return;
        }
    } else {
        level.begin = (lowest_.z - a.z) / rise_m;
        level.end = (highest_.z - a.z) / rise_m;
        if (level.begin > level.end) {
            std::swap(level.begin, level.end);
        }
        level.cosine = std::abs(rise_m) / length_m;
    }
    const double touch = touch_m / length_m;
    const auto add = [&](Crossing::Wall entry, Crossing::Wall exit) {
        if (level.begin > entry.along) {
            entry = {level.begin, level.cosine};
        }
        if (level.end < exit.along) {
            exit = {level.end, level.cosine};
        }
        if (entry.along < touch) {
            entry = {0, Stretch::no_face};
        }
        if (exit.along > 1 - touch) {
            exit = {1, Stretch::no_face};
        }
        if (exit.along - entry.along > touch) {
            crossing.stretches_.push_back(
                Stretch{(exit.along - entry.along) * length_m, entry.cosine, exit.cosine});
        }
    };
    if (std::hypot(b.x - a.x, b.y - a.y) <= touch_m) {
        if (is_over_footprint(a.x, a.y)) {
            add({-infinite, Stretch::no_face}, {infinite, Stretch::no_face});
        }
        return;
    }
    cross_walls(a, b, crossing);
    // A part is inside if it is inside on both shifted lines. A part that is inside on only one of
    // them runs along a wall. On each line, walls come in pairs.
    const auto& left = crossing.left_;
    const auto& right = crossing.right_;
    for (std::size_t l = 0, r = 0; l + 1 < left.size() && r + 1 < right.size();) {
        const Crossing::Wall& entry = left[l].along >= right[r].along ? left[l] : right[r];
        const bool left_ends = left[l + 1].along <= right[r + 1].along;
        add(entry, left_ends ? left[l + 1] : right[r + 1]);
        (left_ends ? l : r) += 2;
    }
}

void Prism::cross_walls(const Position& a, const Position& b, Crossing& crossing) const {
    crossing.left_.clear();
    crossing.right_.clear();
    const double run_x = b.x - a.x;
    const double run_y = b.y - a.y;
    const double run_m = std::hypot(run_x, run_y);
    const double length_m = distance(a, b);
    for (const Ring& ring : rings_) {
        auto& vertices = crossing.vertices_;
        vertices.clear();
        for (const Corner& corner : ring) {
            const double x = corner[0] - a.x;
            const double y = corner[1] - a.y;
            const double side_m = (run_x * y - run_y * x) / run_m;
            vertices.push_back(
                {(run_x * x + run_y * y) / (run_m * run_m), std::abs(side_m) <= touch_m ? 0 : side_m});
        }
        for (std::size_t i = 0; i < ring.size(); ++i) {
            const std::size_t j = i + 1 < ring.size() ? i + 1 : 0;
            const Crossing::Vertex& from = vertices[i];
            const Crossing::Vertex& to = vertices[j];
            const bool left = (from.side_m >= 0) != (to.side_m >= 0);
            const bool right = (from.side_m > 0) != (to.side_m > 0);
            if (!left && !right) {
                continue;
            }
            const double share = from.side_m / (from.side_m - to.side_m);
            const double wall_x = ring[j][0] - ring[i][0];
            const double wall_y = ring[j][1] - ring[i][1];
            const Crossing::Wall wall{
                from.along + share * (to.along - from.along),
                std::abs(run_x * wall_y - run_y * wall_x) / (std::hypot(wall_x, wall_y) * length_m)};
            if (left) {
                crossing.left_.push_back(wall);
            }
            if (right) {
                crossing.right_.push_back(wall);
            }
        }
    }
    const auto by_place = [](const Crossing::Wall& one, const Crossing::Wall& other) {
        return one.along != other.along ? one.along < other.along : one.cosine < other.cosine;
    };
    std::sort(crossing.left_.begin(), crossing.left_.end(), by_place);
    std::sort(crossing.right_.begin(), crossing.right_.end(), by_place);
}

bool Prism::is_over_footprint(double x, double y) const {
    bool inside = false;
    for (const Ring& ring : rings_) {
        for (std::size_t i = 0; i < ring.size(); ++i) {
            const Corner& from = ring[i];
            const Corner& to = ring[i + 1 < ring.size() ? i + 1 : 0];
            if (distance_m(x, y, from, to) <= touch_m) {
                return false;
            }
            if ((from[1] > y) != (to[1] > y) &&
                x < from[0] + (y - from[1]) / (to[1] - from[1]) * (to[0] - from[0])) {
                inside = !inside;
            }
        }
    }
    return inside;
}

}  // namespace netsim
