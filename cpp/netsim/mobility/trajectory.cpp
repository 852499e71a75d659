#include "netsim/mobility/trajectory.hpp"

namespace netsim {

Position Trajectory::position_at(SimTime time) const {
    auto leg = legs_.rbegin();
    while (time < leg->start && leg + 1 != legs_.rend()) {
        ++leg;
    }
    return position_on(*leg, time);
}

Position Trajectory::position_on(const Leg& leg, SimTime time) {
    if (time >= leg.arrival) {
        return leg.target;
    }
    const double fraction =
        static_cast<double>((time - leg.start).ps()) / static_cast<double>((leg.arrival - leg.start).ps());
    return leg.origin + (leg.target - leg.origin) * fraction;
}

void Trajectory::go_to(SimTime now, Position target, double speed_mps) {
    const Position origin = position_at(now);
    const double length_m = distance(origin, target);
    if (length_m == 0) {
        add(Leg{now, now, target, target});
        return;
    }
    const double travel_s = length_m / speed_mps;                         // infinite at speed 0
    constexpr SimTime end_of_time = SimTime::from_us(9'200'000'000'000);  // no run is longer
    const double rest_s = (end_of_time - now).seconds();
    if (!(travel_s < rest_s)) {
        // So slow that the run ends before the arrival: keep the direction, shorten the leg.
        add(Leg{now, end_of_time, origin, origin + (target - origin) * (rest_s / travel_s)});
        return;
    }
    add(Leg{now, now + SimTime::from_seconds(travel_s), origin, target});
}

void Trajectory::stop(SimTime now) {
    const Position here = position_at(now);
    add(Leg{now, now, here, here});
}

void Trajectory::add(const Leg& leg) {
    if (legs_.back().start == leg.start) {
        legs_.back() = leg;  // commands of one instant: the last one counts
    } else {
        legs_.push_back(leg);
    }
    while (legs_.size() > 1 && legs_[1].start < leg.start - memory) {
        legs_.pop_front();
    }
}

}  // namespace netsim
