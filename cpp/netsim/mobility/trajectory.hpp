// The position of a node as a function of time: a sequence of straight legs at constant speed.
//
// Positions are computed on demand, without events. The legs of the last second are kept, because the medium computes powers of frames that started a moment ago.
#pragma once

#include <vector>

#include "netsim/geometry/position.hpp"
#include "netsim/kernel/sim_time.hpp"

namespace netsim {

// Notified of every new leg of the trajectories that it watches, before any position on it is used.
class CourseListener {
public:
    // The node moves at `speed_mps` from `now` on.
    virtual void course_changed(SimTime now, double speed_mps) = 0;

protected:
    ~CourseListener() = default;
};

class alignas(64) Trajectory {
public:
    // How far before the newest leg `time` of position_at may be. Longer than any frame with its
    // propagation.
    static constexpr SimTime memory = SimTime::from_us(1'000'000);

    explicit Trajectory(Position initial)
        : current_{SimTime::long_ago(), SimTime::long_ago(), initial, initial, {}} {}

    Position position_at(SimTime time) const {
        return position_on(time >= current_.start ? current_ : past_leg_at(time), time);
    }

    // The direction of the motion just before that time, of any length. For a stationary node: the
    // direction of its last motion; 0 if it never moved. "Just before", so that a command at the same
    // instant does not change earlier results.
    Position course_at(SimTime time) const {
        return (time > current_.start ? current_ : leg_begun_before(time)).course;
    }

    // Moves straight to `target` at `speed_mps` from `now` on, and stops there. Speed 0: stands
    // still. Takes at least one picosecond: no node is at two places at one instant.
    void go_to(SimTime now, Position target, double speed_mps);
    // Moves straight to `target` from `now` on, and is there at `arrival`, which is later.
    void move(SimTime now, Position target, SimTime arrival);
    // Stands still from `now` on.
    void stop(SimTime now);

    // The highest speed from `now` on, without further commands.
    double speed_mps(SimTime now) const { return now < current_.arrival ? speed_on(current_) : 0; }

    // A constant trajectory can be watched, too, since its course does not change. One listener at
    // a time.
    void set_listener(CourseListener& listener) const { listener_ = &listener; }

    // The members that position_on reads come first: one cache line.
    struct Leg {
        SimTime start;
        SimTime arrival;
        Position target;
        Position origin;
        Position course;  // from the origin to the target; the previous course if they are equal
    };
    const Leg& newest_leg() const { return current_; }

private:
    static Position position_on(const Leg& leg, SimTime time) {
        if (time >= leg.arrival) {
            return leg.target;
        }
        const double fraction = static_cast<double>((time - leg.start).ps()) /
                                static_cast<double>((leg.arrival - leg.start).ps());
        return leg.origin + (leg.target - leg.origin) * fraction;
    }
    static double speed_on(const Leg& leg) {
        return leg.arrival == leg.start
                   ? 0
                   : distance(leg.origin, leg.target) / (leg.arrival - leg.start).seconds();
    }
    const Leg& past_leg_at(SimTime time) const;
    const Leg& leg_begun_before(SimTime time) const;
    void add(Leg leg);

    Leg current_;            // valid from its start on
    std::vector<Leg> past_;  // earlier legs, by start
    mutable CourseListener* listener_ = nullptr;
};

}  // namespace netsim
