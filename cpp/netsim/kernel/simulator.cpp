#include "netsim/kernel/simulator.hpp"

#include "netsim/error.hpp"

namespace netsim {

EventHandle Simulator::schedule_at(SimTime time, Action action, Priority priority) {
    NETSIM_ASSERT(time >= now_);
    return queue_.push(time, priority, action);
}

EventHandle Simulator::schedule_at_place(SimTime time, Place place, Action action) {
    NETSIM_ASSERT(time >= now_);
    return queue_.push_at_place(time, Priority::normal, place, action);
}

inline void Simulator::run_next(SimTime time) {
    now_ = time;
    ++event_count_;
    Action action = queue_.pop();
    action();
}

bool Simulator::run_until(SimTime limit, std::uint64_t max_events) {
    std::uint64_t budget = max_events;
    while (!queue_.empty()) {
        const SimTime time = queue_.next_time();
        if (time > limit) {
            break;
        }
        if (budget-- == 0) {
            return false;
        }
        run_next(time);
    }
    if (limit > now_) {
        now_ = limit;
    }
    return true;
}

bool Simulator::step(SimTime limit) {
    if (queue_.empty() || queue_.next_time() > limit) {
        return false;
    }
    run_next(queue_.next_time());
    return true;
}

}  // namespace netsim
