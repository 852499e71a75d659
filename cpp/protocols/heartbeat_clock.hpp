// The times of heartbeats: heartbeat k is at k · interval + a random delay of up to `jitter`.
//
// All nodes count from time 0, so without jitter they all send at exactly the same instants.
#pragma once

#include <cmath>

#include "netsim/kernel/random.hpp"
#include "netsim/kernel/sim_time.hpp"

namespace netsim {

class HeartbeatClock {
public:
    // interval_s > 0; 0 ≤ jitter_s ≤ interval_s. The first heartbeat is the first multiple of the
    // interval after `start_s`, plus its delay.
    HeartbeatClock(double interval_s, double jitter_s, double start_s, RandomStream& random)
        : interval_s_(interval_s),
          jitter_s_(jitter_s),
          number_(std::floor(start_s / interval_s)),
          random_(random) {}

    SimTime next() {
        number_ += 1;
        return SimTime::of_event(number_ * interval_s_ + random_.uniform(0, jitter_s_));
    }

private:
    double interval_s_;
    double jitter_s_;
    double number_;  // an integer
    RandomStream& random_;
};

}  // namespace netsim
