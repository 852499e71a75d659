// What an event does when its time has come: a callable without arguments, stored in place.
//
// Events are made and dropped by the million, so an Action never allocates: it takes trivially copyable callables of
// at most 32 bytes (a lambda that captures a few pointers and numbers), which is checked when it is compiled.
//
// One that is due again and again in a large network may have a `fetch(int step) const` beside its call operator: it is
// called shortly before the event is due for step 0, 1, … of `fetch_steps`, and again perhaps, or not at all (kernel/fetch.hpp).
#pragma once

#include <cstddef>
#include <new>
#include <type_traits>

namespace netsim {

class Action {
public:
    Action() = default;

    template <typename Callable>
        requires(!std::is_same_v<std::decay_t<Callable>, Action>)
    // NOLINTNEXTLINE(google-explicit-constructor): a lambda is meant to become an Action silently
    Action(const Callable& callable) {
        *this = callable;
    }
    // Stores what the callable captured and nothing else: an Action that is made first and copied then has its unused
    // bytes copied, too, and those of a fresh one are still on their way to memory, for which the copy would wait.
    template <typename Callable>
        requires(!std::is_same_v<std::decay_t<Callable>, Action>)
    Action& operator=(const Callable& callable) {
        static_assert(sizeof(Callable) <= capacity_bytes, "an event's lambda captures at most 32 bytes");
        static_assert(std::is_trivially_copyable_v<Callable>,
                      "an event's lambda captures only pointers and numbers");
        invoke_ = [](void* storage) { (*static_cast<Callable*>(storage))(); };
        if constexpr (requires { callable.fetch(0); }) {
            fetch_ = [](const void* storage, int step) {
                static_cast<const Callable*>(storage)->fetch(step);
            };
        } else {
            fetch_ = nullptr;
        }
        ::new (static_cast<void*>(storage_)) Callable(callable);
        return *this;
    }

    void operator()() { invoke_(storage_); }
    void fetch(int step) const {
        if (fetch_ != nullptr) {
            fetch_(storage_, step);
        }
    }

private:
    static constexpr std::size_t capacity_bytes = 32;

    void (*invoke_)(void*) = nullptr;
    void (*fetch_)(const void*, int) = nullptr;
    alignas(std::max_align_t) std::byte storage_[capacity_bytes];
};

}  // namespace netsim
