#include "netsim/mobility/trajectory.hpp"

#include <algorithm>
#include <cstddef>

namespace netsim {

const Trajectory::Leg& Trajectory::past_leg_at(SimTime time) const {
    if (past_.empty()) {
        return current_;
    }
    auto leg = past_.rbegin();
    while (time < leg->start && leg + 1 != past_.rend()) {
        ++leg;
    }
    return *leg;
}

const Trajectory::Leg& Trajectory::leg_begun_before(SimTime time) const {
    if (past_.empty()) {
        return current_;
    }
    auto leg = past_.rbegin();
    while (time <= leg->start && leg + 1 != past_.rend()) {
        ++leg;
    }
    return *leg;
}

void Trajectory::go_to(SimTime now, Position target, double speed_mps) {
    const Position origin = position_at(now);
    const double length_m = distance(origin, target);
    if (length_m == 0) {
        add(Leg{.start = now, .arrival = now, .target = target, .origin = target, .course = {}});
        return;
    }
    const double travel_s = length_m / speed_mps;  // infinite at speed 0
    const SimTime end_of_time = SimTime::from_seconds(SimTime::longest_run_s);
    const double rest_s = (end_of_time - now).seconds();
    if (!(travel_s < rest_s)) {
        // Too slow to arrive before the end of the run: keep the direction, shorten the leg.
        add(Leg{.start = now,
                .arrival = end_of_time,
                .target = origin + (target - origin) * (rest_s / travel_s),
                .origin = origin,
                .course = {}});
        return;
    }
    add(Leg{.start = now,
            .arrival = now + std::max(SimTime::from_seconds(travel_s), SimTime::from_ps(1)),
            .target = target,
            .origin = origin,
            .course = {}});
}

void Trajectory::move(SimTime now, Position target, SimTime arrival) {
    add(Leg{.start = now, .arrival = arrival, .target = target, .origin = position_at(now), .course = {}});
}

void Trajectory::stop(SimTime now) {
    const Position here = position_at(now);
    add(Leg{.start = now, .arrival = now, .target = here, .origin = here, .course = {}});
}

void Trajectory::add(Leg leg) {
    if (current_.start != leg.start) {  // otherwise the last command of the instant counts
        past_.push_back(current_);
    }
    leg.course = leg.target - leg.origin;
    if (leg.course == Position{}) {
        leg.course = past_.back().course;
    }
    current_ = leg;
    // A past leg ends where the next one starts.
    auto needed = past_.begin();
    while (past_.end() - needed > 1 && (needed + 1)->start < current_.start - memory) {
        ++needed;
    }
    // In groups, for nodes with a hundred legs a second.
    constexpr std::ptrdiff_t most_unneeded = 50;
    if (needed - past_.begin() > most_unneeded) {
        past_.erase(past_.begin(), needed);
    }
    if (listener_ != nullptr) {
        listener_->course_changed(leg.start, speed_on(leg));
    }
}

}  // namespace netsim
