// Flies a node along a list of waypoints, back and forth: gradysim.protocol.plugin.mission_mobility
// with loop mode REVERSE, in C++. Driven by the telemetry of the node.
#pragma once

#include <cstddef>
#include <vector>

#include "netsim/node/node.hpp"

namespace netsim {

class ReversingMission {
public:
    // A waypoint counts as reached at `tolerance_m` or less.
    ReversingMission(Node& node, double speed_mps, double tolerance_m = 0.5)
        : node_(node), speed_mps_(speed_mps), tolerance_m_(tolerance_m) {}

    // Whether the node flies from the last waypoint to the first.
    bool is_reversed() const { return reversed_; }
    bool is_idle() const { return mission_.empty(); }

    // Starts at the first waypoint. `mission` must not be empty.
    void start(std::vector<Position> mission);
    // Sets the direction. If that changes it, flies to the next waypoint in the new direction. Only
    // when not idle.
    void set_reversed(bool reversed);
    // Call it with the node's telemetry.
    void handle_telemetry(const Position& position);

private:
    void go_to(std::size_t waypoint);

    Node& node_;
    double speed_mps_;
    double tolerance_m_;
    std::vector<Position> mission_;
    std::size_t waypoint_ = 0;
    bool reversed_ = false;
};

}  // namespace netsim
