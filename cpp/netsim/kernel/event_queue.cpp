#include "netsim/kernel/event_queue.hpp"

#include <algorithm>

#include "netsim/error.hpp"
#include "netsim/kernel/prefetch.hpp"

namespace netsim {

namespace {

// Number of events at which the overflow buckets come into use.
constexpr std::size_t large_heap = 512;

}  // namespace

// Inlined, so that a new key stays in registers. Reading it back right after it was written in
// parts would stall until all earlier writes are done, some of them cache misses.
[[gnu::always_inline]] inline void EventQueue::sift_up(std::size_t position, EventKey key) {
    while (position > 0) {
        const std::size_t parent = (position - 1) / 2;
        if (!(key < heap_[parent])) {
            break;
        }
        heap_[position] = heap_[parent];
        position = parent;
    }
    heap_[position] = key;
}

[[gnu::always_inline]] inline void EventQueue::sift_down(std::size_t position, EventKey key) {
    const std::size_t size = heap_.size();
    for (;;) {
        std::size_t child = 2 * position + 1;
        if (child >= size) {
            break;
        }
        if (child + 1 < size && heap_[child + 1] < heap_[child]) {
            ++child;
        }
        if (!(heap_[child] < key)) {
            break;
        }
        heap_[position] = heap_[child];
        position = child;
    }
    heap_[position] = key;
}

std::uint32_t EventQueue::take_slot() {
    if (free_slots_.empty()) {
        slots_.emplace_back();
        return static_cast<std::uint32_t>(slots_.size() - 1);
    }
    const std::uint32_t slot = free_slots_.back();
    free_slots_.pop_back();
    return slot;
}

EventHandle EventQueue::insert(SimTime time, Priority priority, SequenceNumber number, std::uint32_t slot) {
    const std::uint32_t generation = slots_[slot].generation;
    const std::uint64_t order = (priority == Priority::last ? last_of_instant : 0) | number;
    const EventKey key{time.ps(), order, slot, generation};
    if (heap_.size() >= large_heap && !overflow_.is_in_use()) {
        close_gap();
        overflow_.take_all(heap_);
    }
    if (overflow_.belongs_here(key.time_ps)) {
        overflow_.add(key);
    } else if (gap_at_top_) {
        gap_at_top_ = false;
        sift_down(0, key);
    } else {
        heap_.emplace_back();
        sift_up(heap_.size() - 1, key);
    }
    ++live_;
    return EventHandle{slot, generation};
}

bool EventQueue::is_pending(EventHandle handle) const {
    return handle.generation != 0 && slots_[handle.slot].generation == handle.generation;
}

bool EventQueue::cancel(EventHandle handle) {
    if (!is_pending(handle)) {
        return false;
    }
    release(handle.slot);
    const std::size_t keys = heap_.size() + overflow_.size();
    if (keys > 64 && keys > 2 * live_) {
        drop_all_dead();
    }
    return true;
}

SimTime EventQueue::next_time() {
    NETSIM_ASSERT(live_ > 0);
    find_top();
    return SimTime::from_ps(heap_.front().time_ps);
}

Action EventQueue::pop() {
    NETSIM_ASSERT(live_ > 0);
    find_top();
    const std::uint32_t slot = heap_.front().slot;
    gap_at_top_ = true;
    Action action = slots_[slot].action;
    release(slot);
    return action;
}

void EventQueue::release(std::uint32_t slot) {
    if (++slots_[slot].generation == 0) {
        slots_[slot].generation = 1;
    }
    free_slots_.push_back(slot);
    --live_;
}

void EventQueue::find_top() {
    close_gap();
    for (;;) {
        if (heap_.empty()) {
            overflow_.open_next(heap_);
            make_heap();
            prefetch_due();
        }
        if (!is_dead(heap_.front())) {
            return;
        }
        remove_top();
    }
}

void EventQueue::prefetch_due() const {
    for (const EventKey& key : heap_) {
        netsim::prefetch(slots_[key.slot]);
    }
    for (int step = 0; step < prefetch_steps; ++step) {
        for (const EventKey& key : heap_) {
            if (!is_dead(key)) {
                slots_[key.slot].action.prefetch(step);
            }
        }
    }
}

void EventQueue::drop_all_dead() {
    close_gap();
    const auto is_dead_key = [this](const EventKey& key) { return is_dead(key); };
    std::erase_if(heap_, is_dead_key);
    make_heap();
    overflow_.erase_if(is_dead_key);
}

void EventQueue::make_heap() {
    for (std::size_t position = heap_.size() / 2; position-- > 0;) {
        sift_down(position, EventKey(heap_[position]));
    }
}

void EventQueue::remove_top() {
    const EventKey last = heap_.back();
    heap_.pop_back();
    if (!heap_.empty()) {
        sift_down(0, last);
    }
}

}  // namespace netsim
