// What an event does when it is due: a callable without arguments, stored in place.
//
// Millions of events are created and dropped, so an Action never allocates memory. It takes
// trivially copyable callables of at most 32 bytes, such as a lambda that captures a few pointers
// and numbers. The compiler checks that.
//
// A callable may also have a member `prefetch(int step) const` (kernel/prefetch.hpp). It is called
// shortly before the event is due, for the steps 0 to prefetch_steps - 1; sometimes twice,
// sometimes never.
#pragma once

#include <cstddef>
#include <new>
#include <type_traits>

#include "netsim/kernel/prefetch.hpp"

namespace netsim {

class Action {
public:
    Action() = default;

    template <typename Callable>
        requires(!std::is_same_v<std::decay_t<Callable>, Action>)
    // NOLINTNEXTLINE(google-explicit-constructor): lambdas convert to an Action implicitly
    Action(const Callable& callable) {
        *this = callable;
    }
    // Stores only the captures. Copying a new Action would also copy its unused bytes, and stall
    // until its recent writes have reached memory.
    template <typename Callable>
        requires(!std::is_same_v<std::decay_t<Callable>, Action>)
    Action& operator=(const Callable& callable) {
        static_assert(sizeof(Callable) <= capacity_bytes, "an event's lambda captures at most 32 bytes");
        static_assert(std::is_trivially_copyable_v<Callable>,
                      "an event's lambda captures only pointers and numbers");
        invoke_ = [](void* storage) { (*static_cast<Callable*>(storage))(); };
        if constexpr (Prefetchable<Callable>) {
            prefetch_ = [](const void* storage, int step) {
                static_cast<const Callable*>(storage)->prefetch(step);
            };
        } else {
            prefetch_ = nullptr;
        }
        ::new (static_cast<void*>(storage_)) Callable(callable);
        return *this;
    }

    void operator()() { invoke_(storage_); }
    void prefetch(int step) const {
        if (prefetch_ != nullptr) {
            prefetch_(storage_, step);
        }
    }

private:
    static constexpr std::size_t capacity_bytes = 32;

    void (*invoke_)(void*) = nullptr;
    void (*prefetch_)(const void*, int) = nullptr;
    alignas(std::max_align_t) std::byte storage_[capacity_bytes];
};

}  // namespace netsim
