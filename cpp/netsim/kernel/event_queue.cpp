#include "netsim/kernel/event_queue.hpp"

#include <algorithm>

#include "netsim/error.hpp"

namespace netsim {

EventHandle EventQueue::push_at_place(SimTime time, Priority priority, Place place, Action action) {
    std::uint32_t slot;
    if (free_slots_.empty()) {
        slot = static_cast<std::uint32_t>(slots_.size());
        slots_.emplace_back();
    } else {
        slot = free_slots_.back();
        free_slots_.pop_back();
    }
    slots_[slot].action = action;
    const std::uint32_t generation = slots_[slot].generation;
    const std::uint64_t order = (static_cast<std::uint64_t>(priority) << 63) | place;
    const Key key{time.ps(), order, slot, generation};
    if (gap_at_top_) {
        gap_at_top_ = false;
        heap_.front() = key;
        sift_down(0);
    } else {
        heap_.push_back(key);
        sift_up(heap_.size() - 1);
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
    if (heap_.size() > 64 && heap_.size() > 2 * live_) {
        drop_all_dead();
    }
    return true;
}

SimTime EventQueue::next_time() {
    NETSIM_ASSERT(live_ > 0);
    drop_dead_top();
    return SimTime::from_ps(heap_.front().time_ps);
}

Action EventQueue::pop() {
    NETSIM_ASSERT(live_ > 0);
    drop_dead_top();
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

void EventQueue::drop_dead_top() {
    close_gap();
    while (is_dead(heap_.front())) {
        remove_top();
    }
}

void EventQueue::drop_all_dead() {
    close_gap();
    std::erase_if(heap_, [this](const Key& key) { return is_dead(key); });
    for (std::size_t position = heap_.size() / 2; position-- > 0;) {
        sift_down(position);
    }
}

void EventQueue::remove_top() {
    heap_.front() = heap_.back();
    heap_.pop_back();
    if (!heap_.empty()) {
        sift_down(0);
    }
}

void EventQueue::sift_up(std::size_t position) {
    const Key key = heap_[position];
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

void EventQueue::sift_down(std::size_t position) {
    const Key key = heap_[position];
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

}  // namespace netsim
