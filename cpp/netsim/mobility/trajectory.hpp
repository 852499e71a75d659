// Where a node is, as a formula of time: a sequence of straight legs at constant speed.
//
// No event moves a node; whoever needs a position asks for it. The legs of the last second are kept, because
// the medium works out powers of frames that started a moment ago.
#pragma once

#include <vector>

#include "netsim/geometry/position.hpp"
#include "netsim/kernel/sim_time.hpp"

namespace netsim {

// Learns of every new leg of the trajectories that it watches, before anybody asks for a position on it.
class CourseListener {
public:
    // From `now` on at `speed_mps`.
    virtual void course_changed(SimTime now, double speed_mps) = 0;

protected:
    ~CourseListener() = default;
};

class alignas(64) Trajectory {
public:
    // How far before the newest leg position_at may ask. Longer than any frame with its propagation.
    static constexpr SimTime memory = SimTime::from_us(1'000'000);

    explicit Trajectory(Position initial)
        : current_{SimTime::long_ago(), SimTime::long_ago(), initial, initial, {}} {}

    Position position_at(SimTime time) const {
        return position_on(time >= current_.start ? current_ : past_leg_at(time), time);
    }

    // The direction of the motion just before that time, of any length; of the latest one before, while it stands; 0, as
    // long as it has not moved. Just before: so that commands of that very instant do not change what was said already.
    Position course_at(SimTime time) const {
        return (time > current_.start ? current_ : leg_begun_before(time)).course;
    }

    // From `now` on straight to `target` at `speed_mps`, there to stand. Speed 0: stand where it is. However short the
    // way and high the speed, it takes the shortest time that there is: nobody is at two places in one instant.
    void go_to(SimTime now, Position target, double speed_mps);
    // From `now` on stand still.
    void stop(SimTime now);

    // The highest speed from `now` on, as things stand.
    double speed_mps(SimTime now) const { return now < current_.arrival ? speed_on(current_) : 0; }

    // Watching changes nothing of the course, so a constant trajectory can be watched too; by one at a time.
    void set_listener(CourseListener& listener) const { listener_ = &listener; }

private:
    // What a position takes comes first: one cache line.
    struct Leg {
        SimTime start;
        SimTime arrival;
        Position target;
        Position origin;
        Position course;  // from the origin to the target, or that of the leg before, if they are the same
    };

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

    Leg current_;            // from its start on
    std::vector<Leg> past_;  // those before, by start; takes no memory as long as there are none
    mutable CourseListener* listener_ = nullptr;
};

}  // namespace netsim
