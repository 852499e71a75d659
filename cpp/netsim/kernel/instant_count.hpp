// Notices somebody who goes on and on within one instant, so that simulated time stands still.
//
// Timers that are set for now again and again, or messages without delay that answer each other, never end: the run
// would hang without a word. Who schedules for now on a protocol's behalf counts, and refuses what is too much.
#pragma once

#include <cstdint>

#include "netsim/kernel/sim_time.hpp"

namespace netsim {

// Actions of one kind that one node may take within one instant; more cannot be meant. Prototype mode has the same bound.
inline constexpr std::int32_t most_at_one_instant = 1'000'000;

class InstantCount {
public:
    // Counts one more; whether they are too many.
    bool exceeds(SimTime now) {
        if (now != instant_) {
            instant_ = now;
            count_ = 0;
        }
        return ++count_ > most_at_one_instant;
    }

private:
    SimTime instant_ = SimTime::long_ago();
    std::int32_t count_ = 0;
};

}  // namespace netsim
