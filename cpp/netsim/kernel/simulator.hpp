// The clock and the event loop below all layers.
//
// It runs actions in the order of the EventQueue and knows nothing about networks. An exception
// thrown by an action propagates out of `run_until`. The simulator stays usable: the failed event is
// gone, and the clock is at its time.
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

    // `time` must not be in the past.
    template <typename Callable>
    EventHandle schedule_at(SimTime time, const Callable& action, Priority priority = Priority::normal) {
        NETSIM_ASSERT(time >= now_);
        return queue_.push(time, priority, action);
    }
    template <typename Callable>
    EventHandle schedule_after(SimTime delay, const Callable& action, Priority priority = Priority::normal) {
        return schedule_at(now_ + delay, action, priority);
    }
    // Sequence numbers for events that are scheduled later, or never. At equal times, such an event
    // runs in the order in which its number was reserved.
    SequenceNumber reserve_sequence_numbers(std::uint64_t count) {
        return queue_.reserve_sequence_numbers(count);
    }
    template <typename Callable>
    EventHandle schedule_reserved(SimTime time, SequenceNumber number, const Callable& action) {
        NETSIM_ASSERT(time >= now_);
        return queue_.push_reserved(time, Priority::normal, number, action);
    }
    // Advances to the successor of the current event without the queue, if it would be the next
    // event anyway. If true, the clock is at its time, and the caller runs it. If false, the caller
    // schedules it. `number`: its reserved sequence number.
    bool try_run_inline(SimTime time, SequenceNumber number) {
        if (time > limit_ || budget_ == 0 || !queue_.would_be_next(time, number)) {
            return false;
        }
        --budget_;
        ++event_count_;
        now_ = time;
        sequence_number_ = number;
        return true;
    }
    // Whether an event of that time and number would have run before the current one.
    bool has_passed(SimTime time, SequenceNumber number) const {
        return time < now_ || (time == now_ && number < sequence_number_);
    }
    bool cancel(EventHandle handle) { return queue_.cancel(handle); }
    bool is_pending(EventHandle handle) const { return queue_.is_pending(handle); }

    // Runs the events up to and including `limit`, then sets the clock to `limit`. Returns false,
    // with the clock at the last event, if `max_events` events ran before that.
    bool run_until(SimTime limit, std::uint64_t max_events = ~std::uint64_t{0});
    // Runs one event, if there is one up to and including `limit`. Otherwise returns false and leaves
    // the clock unchanged.
    bool step(SimTime limit);

private:
    void run_next(SimTime time);

    EventQueue queue_;
    SimTime now_;
    SequenceNumber sequence_number_ = 0;  // events of this instant with lower numbers have run
    std::uint64_t event_count_ = 0;
    SimTime limit_;             // of run_until
    std::uint64_t budget_ = 0;  // events that run_until may still run
};

}  // namespace netsim
