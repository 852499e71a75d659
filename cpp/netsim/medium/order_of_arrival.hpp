// Puts the arrivals of one transmission in the order of their events: by start, then by radio.
//
// A few, as mostly, go straight to their places: that of each is the number of those that come before it, which is counted
// without a branch. A processor cannot guess how comparisons of distances end, and a wrong guess takes as long as many of
// them: with std::sort, a run with 1,000 nodes takes a twentieth longer.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "netsim/kernel/sim_time.hpp"

namespace netsim {

// `Heard` has a `start`, not before `sent`, and a `radio`, which no two have in common.
template <typename Heard>
void put_in_order(std::vector<Heard>& heard, SimTime sent) {
    constexpr std::size_t few = 32;
    constexpr unsigned radio_bits = 31;
    std::array<std::uint64_t, few> keys;
    std::uint64_t latest_ps = 0;
    const std::size_t count = std::min(heard.size(), few);
    for (std::size_t i = 0; i < count; ++i) {
        const auto delay_ps = static_cast<std::uint64_t>((heard[i].start - sent).ps());
        latest_ps = std::max(latest_ps, delay_ps);
        keys[i] = delay_ps << radio_bits | static_cast<std::uint64_t>(heard[i].radio);
    }
    const bool fits = latest_ps >> (64 - radio_bits) == 0;  // as within 2,500 km
    if (heard.size() > few || !fits) {
        std::sort(heard.begin(), heard.end(), [](const Heard& a, const Heard& b) {
            return a.start != b.start ? a.start < b.start : a.radio < b.radio;
        });
        return;
    }
    std::array<Heard, few> unsorted;
    std::copy(heard.begin(), heard.end(), unsorted.begin());
    for (std::size_t i = 0; i < count; ++i) {
        std::size_t before = 0;
        for (std::size_t j = 0; j < count; ++j) {
            before += keys[j] < keys[i] ? 1U : 0U;
        }
        heard[before] = unsorted[i];
    }
}

}  // namespace netsim
