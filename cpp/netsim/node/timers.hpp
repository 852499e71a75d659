// The pending timers of one node. Several timers with the same name may be pending.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "netsim/kernel/event_queue.hpp"
#include "netsim/kernel/prefetch.hpp"

namespace netsim {

class Timers {
public:
    // Adds a timer and returns its number. The caller schedules the event and passes its handle to
    // set_event.
    std::size_t add(std::string name) {
        std::size_t number = timers_.size();
        if (first_free_ == none) {
            timers_.emplace_back();
        } else {
            number = first_free_;
            first_free_ = timers_[number].next_free;
        }
        timers_[number].name = std::move(name);
        timers_[number].pending = true;
        return number;
    }
    void set_event(std::size_t number, EventHandle event) { timers_[number].event = event; }

    // Removes a timer that is due, and returns its name.
    std::string take(std::size_t number) {
        release(number);
        return std::move(timers_[number].name);
    }

    void prefetch() const { prefetch_bytes(timers_.data(), sizeof(Timer)); }

    // Removes all timers of that name and calls cancel_event(EventHandle) for each.
    template <typename CancelEvent>
    void cancel(const std::string& name, CancelEvent cancel_event) {
        for (std::size_t number = 0; number < timers_.size(); ++number) {
            Timer& timer = timers_[number];
            if (timer.pending && timer.name == name) {
                cancel_event(timer.event);
                release(number);
            }
        }
    }

private:
    using Place = std::uint32_t;  // index of a timer; 32 bits suffice for any memory
    static constexpr Place none = ~Place{0};

    struct alignas(64) Timer {
        std::string name;
        EventHandle event;
        bool pending = false;
        Place next_free = none;  // next in the free list
    };

    void release(std::size_t number) {
        timers_[number].pending = false;
        timers_[number].next_free = std::exchange(first_free_, static_cast<Place>(number));
    }

    std::vector<Timer> timers_;
    Place first_free_ = none;  // head of the free list: released last
};

}  // namespace netsim
