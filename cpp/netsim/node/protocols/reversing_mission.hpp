// Flies a node along a list of waypoints, to and fro: the mission of gradysim.protocol.plugin.mission_mobility that
// loops with REVERSE, natively. Driven by the telemetry of the node.
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

    // Whether the waypoints are being flown from the last to the first.
    bool is_reversed() const { return reversed_; }
    bool is_idle() const { return mission_.empty(); }

    // Flies to the first of the waypoints (not none) and on from there.
    void start(std::vector<Position> mission);
    // Turns round: flies to the next waypoint of the new direction, if it is new. Only when not idle.
    void set_reversed(bool reversed);
    // The node's telemetry.
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
