// Has memory brought into the cache that will be used soon, while there is other work to do.
//
// In a large network what one event touches is in no cache by the time it runs: the others have pushed it out since the
// last time. Whoever knows a while before what it will be says so with this. It changes nothing but the time that a run takes.
//
// What a pointer leads to can be asked for only when the pointer is there. So what many events will touch is asked for in
// steps, each for all of them: a step reads no more than what those before it asked for.
#pragma once

#include <cstddef>

namespace netsim {

constexpr std::size_t cache_line_bytes = 64;

// So many pointers, one behind the other, lead at most from an event to what it will touch (Node::fetch_for_timer).
constexpr int fetch_steps = 4;

inline void fetch_bytes(const void* object, std::size_t bytes) {
    // GCC takes a function that does nothing else for one without any effect, and leaves out calls of it.
    asm volatile("");
    const auto* address = static_cast<const char*>(object);
    for (std::size_t offset = 0; offset < bytes; offset += cache_line_bytes) {
        __builtin_prefetch(address + offset);
    }
}

template <typename Object>
void fetch(const Object& object) {
    fetch_bytes(static_cast<const void*>(&object), sizeof(Object));
}

// Its members before `member`: the first ones, if it keeps those that are used most in front.
template <typename Object, typename Member>
void fetch_before(const Object& object, const Member& member) {
    const auto* begin = reinterpret_cast<const char*>(&object);
    fetch_bytes(begin, static_cast<std::size_t>(reinterpret_cast<const char*>(&member) - begin));
}

}  // namespace netsim
