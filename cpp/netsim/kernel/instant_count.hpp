// Detects endless loops within one instant, in which simulated time stands still.
//
// Timers set for now again and again, or messages without delay that answer each other, would hang
// the run without a message. Code that schedules for now on behalf of a protocol counts, and
// rejects too many.
#pragma once

#include <cstdint>

#include "netsim/kernel/sim_time.hpp"

namespace netsim {

// Actions of one kind that one node may take within one instant. Prototype mode has the same limit.
inline constexpr std::int32_t max_per_instant = 1'000'000;

class InstantCount {
public:
    // Counts one more. True if they are too many.
    bool exceeds(SimTime now) {
        if (now != instant_) {
            instant_ = now;
            count_ = 0;
        }
        return ++count_ > max_per_instant;
    }

private:
    SimTime instant_ = SimTime::long_ago();
    std::int32_t count_ = 0;
};

}  // namespace netsim
