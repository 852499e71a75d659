#include "netsim/kernel/simulator.hpp"

#include <algorithm>

namespace netsim {

inline void Simulator::run_next(SimTime time) {
    now_ = time;
    sequence_number_ = queue_.next_sequence_number();
    ++event_count_;
    Action action = queue_.pop();
    action();
}

bool Simulator::run_until(SimTime limit, std::uint64_t max_events) {
    limit_ = limit;
    budget_ = max_events;
    while (!queue_.empty()) {
        const SimTime time = queue_.next_time();
        if (time > limit) {
            break;
        }
        if (budget_ == 0) {
            return false;
        }
        --budget_;
        run_next(time);
    }
    now_ = std::max(now_, limit);
    sequence_number_ = queue_.unused_sequence_number();
    return true;
}

bool Simulator::step(SimTime limit) {
    if (queue_.empty() || queue_.next_time() > limit) {
        return false;
    }
    budget_ = 0;
    run_next(queue_.next_time());
    return true;
}

}  // namespace netsim
