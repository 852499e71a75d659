// Detects endless loops within one instant, in which simulated time stands still.
//
// Timers that are set for the current time again and again, or endless replies without delay, would
// hang the run silently. So code that schedules for the current time on behalf of a protocol counts,
// and throws an error above the limit.
#pragma once

#include <cstdint>

#include "netsim/kernel/sim_time.hpp"

namespace netsim {

// Actions of one kind that one node may take within one instant. Prototype mode has the same limit.
inline constexpr std::int32_t max_per_instant = 1'000'000;

class InstantCount {
public:
    // Counts one action. Returns whether the limit is exceeded.
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
