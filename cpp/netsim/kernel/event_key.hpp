// The key that the event queue sorts: the time of an event, its order among events of that time, and
// the slot of its action.
#pragma once

#include <cstdint>

namespace netsim {

struct EventKey {
    std::int64_t time_ps = 0;
    std::uint64_t order = 0;  // priority in the top bit, sequence number below
    std::uint32_t slot = 0;   // of its action, in the pool
    std::uint32_t generation = 0;

    bool operator<(const EventKey& other) const {
        return time_ps != other.time_ps ? time_ps < other.time_ps : order < other.order;
    }
};

}  // namespace netsim
