// Prefetching: loads memory that an event will read soon into the cache. The only place in the
// engine that issues prefetch instructions. It changes the run time and nothing else.
//
// Why. In a large network, the other nodes have evicted the state that an event reads from the cache
// since its last use. A cache miss costs as much as a hundred instructions. Before these measures,
// a delivered frame had nine of them with 10,000 nodes. The measurements are in
// docs/decisions/0037-shortcuts-must-gain.md.
//
// How. Two kinds of events are known well before they run:
//
//   what             known when                          who prefetches what
//   timers           their overflow bucket is opened      EventQueue::prefetch_due calls Action::prefetch(step) of all
//                                                        events of the bucket. A node's timer prefetches the node,
//                                                        protocol, interface and radio, since most timers send.
//   arrivals         their transmission begins           Medium prefetches each receiver's radio, MAC, protocol
//                                                        (Medium::set_prefetch_targets) and outcome count.
//
// Smaller cases: positions of moving nodes (NeighborSearch), a payload that receivers will hash
// (TransmitQueue), the state for a frame that may be lost (Radio), and counts of interferers
// (Interferers).
//
// Steps. The target of a pointer can be prefetched only after the pointer itself has arrived. So
// events of a bucket are prefetched in steps: step 0 for all of them, then step 1 for all, and so
// on. A step may read only memory that an earlier step prefetched. To take part, an object has a
// member `void prefetch(int step) const` (concept Prefetchable).
//
// Rules. Put the members that every frame reads first in their object, in one cache line, and
// prefetch those lines only. A processor drops requests beyond about twenty outstanding ones, so
// prefetch only what will be needed. Measure with `make bench` before and after, and remove a
// prefetch that gains nothing.
#pragma once

#include <cstddef>

namespace netsim {

constexpr std::size_t cache_line_bytes = 64;

// The longest chain of pointers from an event to what it will read (Node::prefetch_for_timer).
constexpr int prefetch_steps = 4;

template <typename Object>
concept Prefetchable = requires(const Object& object, int step) { object.prefetch(step); };

inline void prefetch_bytes(const void* object, std::size_t bytes) {
    // Without this, GCC considers a function that only prefetches free of effects, and removes
    // calls of it.
    asm volatile("");
    const auto* address = static_cast<const char*>(object);
    for (std::size_t offset = 0; offset < bytes; offset += cache_line_bytes) {
        __builtin_prefetch(address + offset);
    }
}

template <typename Object>
void prefetch(const Object& object) {
    prefetch_bytes(static_cast<const void*>(&object), sizeof(Object));
}

// Prefetches the members of `object` before `member`.
template <typename Object, typename Member>
void prefetch_before(const Object& object, const Member& member) {
    const auto* begin = reinterpret_cast<const char*>(&object);
    prefetch_bytes(begin, static_cast<std::size_t>(reinterpret_cast<const char*>(&member) - begin));
}

}  // namespace netsim
