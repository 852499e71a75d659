// The pending events of one simulation, in the order in which they will run.
//
// The order is a contract: by time, then by priority, then by sequence number, which follows the
// order of scheduling. Sequence numbers can be reserved for events that are scheduled later. Small
// keys are in a binary heap, and actions in a separate pool. A popped event leaves a gap at the top
// of the heap, which the next scheduled event fills, since most events schedule a successor. With
// many events, only those due soon are in the heap (overflow_buckets.hpp has the others). Canceling
// an event frees its slot in the pool. Its key, now dead, is dropped when it reaches the top of the
// heap. All dead keys are dropped together once they outnumber the others.
#pragma once

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

#include "netsim/kernel/action.hpp"
#include "netsim/kernel/event_key.hpp"
#include "netsim/kernel/overflow_buckets.hpp"
#include "netsim/kernel/sim_time.hpp"

namespace netsim {

// Among events of one instant, `last` runs after all `normal` ones, whenever they were scheduled.
enum class Priority : std::uint8_t { normal = 0, last = 1 };

// Identifies one scheduled event. Using the handle of an event that has run or was canceled is
// harmless.
struct EventHandle {
    std::uint32_t slot = 0;
    std::uint32_t generation = 0;  // 0: no event
};

// Events of equal time and priority run in the order of their sequence numbers.
using SequenceNumber = std::uint64_t;

class EventQueue {
public:
    // `action`: an Action, or a callable that converts to one.
    template <typename Callable>
    EventHandle push(SimTime time, Priority priority, const Callable& action) {
        return push_reserved(time, priority, next_sequence_number_++, action);
    }
    // Reserves `count` sequence numbers, as if that many events were scheduled now. Returns the
    // first.
    SequenceNumber reserve_sequence_numbers(std::uint64_t count) {
        return std::exchange(next_sequence_number_, next_sequence_number_ + count);
    }
    // Schedules an event with a reserved sequence number. Use each number once.
    template <typename Callable>
    EventHandle push_reserved(SimTime time, Priority priority, SequenceNumber number,
                              const Callable& action) {
        const std::uint32_t slot = take_slot();
        slots_[slot].action = action;
        return insert(time, priority, number, slot);
    }

    // Returns whether the event was pending. Amortized O(1).
    bool cancel(EventHandle handle);
    bool is_pending(EventHandle handle) const;

    // Whether a normal event of that time and number would be the next one. A conservative test:
    // true is certain, false is not.
    bool would_be_next(SimTime time, SequenceNumber number) const {
        const EventKey key{time.ps(), number, 0, 0};
        const std::size_t first =
            gap_at_top_ ? 1 : 0;  // only the top, or the two below it, can come before the key
        const std::size_t end = std::min(2 * first + 1, heap_.size());
        return !overflow_.belongs_here(key.time_ps) &&
               std::none_of(heap_.data() + first, heap_.data() + end,
                            [&key](const EventKey& other) { return other < key; });
    }

    bool empty() const { return live_ == 0; }
    std::size_t size() const { return live_; }

    // Time of the next event. Only when not empty.
    SimTime next_time();
    // When the next event runs, all normal events of its time with lower numbers than this have run.
    // Call it after next_time.
    SequenceNumber next_sequence_number() const {
        const std::uint64_t order = heap_.front().order;
        return order < last_of_instant ? order : next_sequence_number_;
    }
    // Events scheduled or reserved from now on have this number or a higher one.
    SequenceNumber unused_sequence_number() const { return next_sequence_number_; }
    // Takes the next event out of the queue. Only when not empty.
    Action pop();

private:
    static constexpr std::uint64_t last_of_instant = std::uint64_t{1} << 63;  // in EventKey::order
    // One cache line.
    struct alignas(64) Slot {
        Action action;
        std::uint32_t generation = 1;
    };

    bool is_dead(const EventKey& key) const { return slots_[key.slot].generation != key.generation; }
    std::uint32_t take_slot();
    EventHandle insert(SimTime time, Priority priority, SequenceNumber number, std::uint32_t slot);
    void release(std::uint32_t slot);
    void close_gap() {
        if (gap_at_top_) {
            gap_at_top_ = false;
            remove_top();
        }
    }
    // Moves the next event to the top.
    void find_top();
    // Prefetches what the events in the heap, which are due soon, will read (kernel/prefetch.hpp).
    void prefetch_due() const;
    void drop_all_dead();
    void make_heap();
    // Starting at an empty position, find the one for `key`, which is not in the heap.
    void sift_up(std::size_t position, EventKey key);
    void sift_down(std::size_t position, EventKey key);
    void remove_top();

    std::vector<EventKey> heap_;
    OverflowBuckets overflow_;
    std::vector<Slot> slots_;
    std::vector<std::uint32_t> free_slots_;
    SequenceNumber next_sequence_number_ = 0;
    std::size_t live_ = 0;
    bool gap_at_top_ = false;  // heap_[0] belongs to an event that was taken out
};

}  // namespace netsim
