// The clock and the event loop under all layers.
//
// Knows nothing of networks: it runs actions in the order of EventQueue and tells the time. An exception thrown by
// an action leaves `run_until`; the simulator stays usable (the failed event is gone, the clock stands at its time).
#pragma once

#include <cstdint>

#include "netsim/error.hpp"
#include "netsim/kernel/event_queue.hpp"
#include "netsim/kernel/sim_time.hpp"

namespace netsim {

class Simulator {
public:
    SimTime now() const { return now_; }
    // Events that have run so far.
    std::uint64_t event_count() const { return event_count_; }
    std::size_t pending_count() const { return queue_.size(); }

    // The caller sees to it that `time` is not in the past.
    template <typename Callable>
    EventHandle schedule_at(SimTime time, const Callable& action, Priority priority = Priority::normal) {
        NETSIM_ASSERT(time >= now_);
        return queue_.push(time, priority, action);
    }
    template <typename Callable>
    EventHandle schedule_after(SimTime delay, const Callable& action, Priority priority = Priority::normal) {
        return schedule_at(now_ + delay, action, priority);
    }
    // For events that are scheduled late, or perhaps not at all, but keep the turn in the order of equal times that
    // they would have had if they had been scheduled when it was reserved.
    Turn reserve_turns(std::uint64_t count) { return queue_.reserve_turns(count); }
    template <typename Callable>
    EventHandle schedule_at_turn(SimTime time, Turn turn, const Callable& action) {
        NETSIM_ASSERT(time >= now_);
        return queue_.push_at_turn(time, Priority::normal, turn, action);
    }
    // For an event with a successor, whose turn is reserved. True if that is what runs next: then it is its time, and the
    // caller does what it has to do. Otherwise it has to be scheduled. So most of them need not pass through the queue.
    bool goes_on_at(SimTime time, Turn turn) {
        if (time > limit_ || budget_ == 0 || !queue_.would_be_next(time, turn)) {
            return false;
        }
        --budget_;
        ++event_count_;
        now_ = time;
        turn_ = turn;
        return true;
    }
    // Whether an event of that time and turn, if there had been one, would have run by now: before the one that runs.
    bool has_passed(SimTime time, Turn turn) const { return time < now_ || (time == now_ && turn < turn_); }
    bool cancel(EventHandle handle) { return queue_.cancel(handle); }
    bool is_pending(EventHandle handle) const { return queue_.is_pending(handle); }

    // Runs the events up to and including `limit`, then sets the clock to it. Returns false, with the clock at the
    // last event, when `max_events` have run before that.
    bool run_until(SimTime limit, std::uint64_t max_events = ~std::uint64_t{0});
    // Runs one event, if there is one up to and including `limit`; otherwise returns false, and the clock stays.
    bool step(SimTime limit);

private:
    void run_next(SimTime time);

    EventQueue queue_;
    SimTime now_;
    Turn turn_ = 0;  // events of this instant with lower ones have run
    std::uint64_t event_count_ = 0;
    SimTime limit_;             // of the run
    std::uint64_t budget_ = 0;  // so many more events in it
};

}  // namespace netsim
