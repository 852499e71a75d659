#include "protocols/reversing_mission.hpp"

#include <algorithm>
#include <utility>

#include "netsim/error.hpp"

namespace netsim {

void ReversingMission::start(std::vector<Position> mission) {
    NETSIM_ASSERT(!mission.empty());
    mission_ = std::move(mission);
    reversed_ = false;
    go_to(0);
    node_.set_speed(speed_mps_);
}

void ReversingMission::set_reversed(bool reversed) {
    NETSIM_ASSERT(!is_idle());
    if (reversed == reversed_) {
        return;
    }
    reversed_ = reversed;
    if (reversed_) {
        go_to(waypoint_ == 0 ? 0 : waypoint_ - 1);
    } else {
        go_to(std::min(waypoint_ + 1, mission_.size() - 1));
    }
}

void ReversingMission::handle_telemetry(const Position& position) {
    if (is_idle()) {
        return;
    }
    const Position& target = mission_[waypoint_];
    const double dx = position.x - target.x;
    const double dy = position.y - target.y;
    const double dz = position.z - target.z;
    if (!(dx * dx + dy * dy + dz * dz <= tolerance_m_ * tolerance_m_)) {
        return;
    }
    const std::size_t last = mission_.size() - 1;
    if (waypoint_ == (reversed_ ? 0 : last)) {
        reversed_ = !reversed_;
        if (last > 0) {  // a single waypoint would get a command for each telemetry
            go_to(reversed_ ? last - 1 : 1);
        }
        return;
    }
    go_to(reversed_ ? waypoint_ - 1 : waypoint_ + 1);
}

void ReversingMission::go_to(std::size_t waypoint) {
    waypoint_ = waypoint;
    node_.go_to(mission_[waypoint]);
}

}  // namespace netsim
