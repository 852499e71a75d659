// Calls that the user of a network schedules as events.
//
// The kernel's actions hold only pointers and numbers. Callables that own something (a Python
// object) are kept here until they run or are dropped.
#pragma once

#include <cstddef>
#include <functional>
#include <utility>
#include <vector>

#include "netsim/kernel/simulator.hpp"

namespace netsim {

class ScheduledCalls {
public:
    explicit ScheduledCalls(Simulator& simulator) : simulator_(simulator) {}
    ScheduledCalls(const ScheduledCalls&) = delete;
    ScheduledCalls& operator=(const ScheduledCalls&) = delete;

    // `time` must not be in the past. Exceptions of `call` propagate out of Simulator::run_until.
    void add(SimTime time, std::function<void()> call) {
        std::size_t number = calls_.size();
        if (free_.empty()) {
            calls_.emplace_back();
        } else {
            number = free_.back();
            free_.pop_back();
        }
        calls_[number].function = std::move(call);
        calls_[number].event = simulator_.schedule_at(time, [this, number] { run(number); });
    }

    // Cancels and destroys the pending calls. Their destructors may schedule new ones.
    void drop() {
        const std::vector<Call> dropped = std::exchange(calls_, {});
        free_.clear();
        for (const Call& call : dropped) {
            simulator_.cancel(call.event);  // harmless for those that ran
        }
    }

private:
    struct Call {
        std::function<void()> function;
        EventHandle event;
    };

    void run(std::size_t number) {
        const std::function<void()> function = std::exchange(calls_[number].function, nullptr);
        free_.push_back(number);
        function();
    }

    Simulator& simulator_;
    std::vector<Call> calls_;
    std::vector<std::size_t> free_;
};

}  // namespace netsim
