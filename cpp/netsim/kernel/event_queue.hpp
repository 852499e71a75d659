// The pending events of one simulation, in the order in which they will run.
//
// The order is a contract: by time, then by priority, then by the order of scheduling. An event that is scheduled late
// can keep a turn in that order that was reserved before. Small keys live in a binary heap, what an event does lives
// in a pool beside it. An event that has been taken out leaves a gap at the top, into which goes what it schedules, as
// most events schedule their successor. Once there are many events, only those due soon are in the heap (far_events.hpp
// has the others). Cancelling marks the pool's slot; the key is dropped when it reaches the top, or all dead keys
// together when they outnumber the living.
#pragma once

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

#include "netsim/kernel/action.hpp"
#include "netsim/kernel/event_key.hpp"
#include "netsim/kernel/far_events.hpp"
#include "netsim/kernel/sim_time.hpp"

namespace netsim {

// Among events of one instant, `last` runs after all `normal` ones, whenever they were scheduled.
enum class Priority : std::uint8_t { normal = 0, last = 1 };

// Names one scheduled event. A handle of an event that has run or was cancelled is harmless.
struct EventHandle {
    std::uint32_t slot = 0;
    std::uint32_t generation = 0;  // 0: no event
};

// Of events of one time and priority, those with the lower turn run first.
using Turn = std::uint64_t;

class EventQueue {
public:
    // What is pushed is an Action, or what becomes one.
    template <typename Callable>
    EventHandle push(SimTime time, Priority priority, const Callable& action) {
        return push_at_turn(time, priority, next_turn_++, action);
    }
    // Keeps `count` turns in the order of equal times, as if so many events were scheduled now; returns the first.
    Turn reserve_turns(std::uint64_t count) { return std::exchange(next_turn_, next_turn_ + count); }
    // For a reserved turn; each serves once.
    template <typename Callable>
    EventHandle push_at_turn(SimTime time, Priority priority, Turn turn, const Callable& action) {
        const std::uint32_t slot = take_slot();
        slots_[slot].action = action;
        return insert(time, priority, turn, slot);
    }

    // True if the event was pending. O(1) amortised.
    bool cancel(EventHandle handle);
    bool is_pending(EventHandle handle) const;

    // Whether a normal event of that time and turn would be the next one; sometimes false though it would.
    bool would_be_next(SimTime time, Turn turn) const {
        const EventKey key{time.ps(), turn, 0, 0};
        const std::size_t first =
            gap_at_top_ ? 1 : 0;  // no other is before the top, or before the two below it
        const std::size_t end = std::min(2 * first + 1, heap_.size());
        return !far_.is_far(key.time_ps) &&
               std::none_of(heap_.data() + first, heap_.data() + end,
                            [&key](const EventKey& other) { return other < key; });
    }

    bool empty() const { return live_ == 0; }
    std::size_t size() const { return live_; }

    // Time of the next event. Only when not empty.
    SimTime next_time();
    // All normal events of its time with lower turns have run when it does. After next_time.
    Turn next_turn() const {
        const std::uint64_t order = heap_.front().order;
        return order < last_of_instant ? order : next_turn_;
    }
    // What is scheduled or reserved from now on has that turn, or a higher one.
    Turn unused_turn() const { return next_turn_; }
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
    EventHandle insert(SimTime time, Priority priority, Turn turn, std::uint32_t slot);
    void release(std::uint32_t slot);
    void close_gap() {
        if (gap_at_top_) {
            gap_at_top_ = false;
            remove_top();
        }
    }
    // Sees to it that the next event is at the top.
    void find_top();
    // The events that are due soon are all in the heap: has what they will touch brought into the cache.
    void fetch_ahead() const;
    void drop_all_dead();
    void make_heap();
    // From a position on that holds nothing, find the one for `key`, which is not in the heap.
    void sift_up(std::size_t position, EventKey key);
    void sift_down(std::size_t position, EventKey key);
    void remove_top();

    std::vector<EventKey> heap_;
    FarEvents far_;
    std::vector<Slot> slots_;
    std::vector<std::uint32_t> free_slots_;
    Turn next_turn_ = 0;
    std::size_t live_ = 0;
    bool gap_at_top_ = false;  // heap_[0] is of an event that was taken out
};

}  // namespace netsim
