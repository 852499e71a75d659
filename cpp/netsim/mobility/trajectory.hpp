// Where a node is, as a formula of time: a sequence of straight legs at constant speed.
//
// No event moves a node; whoever needs a position asks for it. The legs of the last second are kept, because
// the medium works out powers of frames that started a moment ago.
#pragma once

#include <deque>

#include "netsim/geometry/position.hpp"
#include "netsim/kernel/sim_time.hpp"

namespace netsim {

class Trajectory {
public:
    // How far before the newest leg position_at may ask. Longer than any frame with its propagation.
    static constexpr SimTime memory = SimTime::from_us(1'000'000);

    explicit Trajectory(Position initial)
        : current_{SimTime::long_ago(), SimTime::long_ago(), initial, initial} {}

    Position position_at(SimTime time) const {
        return position_on(time >= current_.start ? current_ : past_leg_at(time), time);
    }

    // From `now` on straight to `target` at `speed_mps`, there to stand. Speed 0: stand where it is.
    void go_to(SimTime now, Position target, double speed_mps);
    // From `now` on stand still.
    void stop(SimTime now);

private:
    struct Leg {
        SimTime start;
        SimTime arrival;
        Position origin;
        Position target;
    };

    static Position position_on(const Leg& leg, SimTime time) {
        if (time >= leg.arrival) {
            return leg.target;
        }
        const double fraction = static_cast<double>((time - leg.start).ps()) /
                                static_cast<double>((leg.arrival - leg.start).ps());
        return leg.origin + (leg.target - leg.origin) * fraction;
    }
    const Leg& past_leg_at(SimTime time) const;
    void add(const Leg& leg);

    Leg current_;           // from its start on
    std::deque<Leg> past_;  // those before, by start
};

}  // namespace netsim
