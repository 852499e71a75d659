// Puts the arrivals of one transmission in the order of their events: by start, then by radio.
//
// A few, as mostly, go straight to their places: that of each is the number of those that come before it, which is counted
// without a branch, and for several at once. A processor cannot guess how comparisons of distances end, and a wrong guess takes
// as long as many of them.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "netsim/kernel/sim_time.hpp"

namespace netsim {

// `Heard` has a `start`, not before `sent`, and a `radio`, which no two have in common. `spare` may hold anything,
// then and after.
template <typename Heard>
void put_in_order(std::vector<Heard>& heard, SimTime sent, std::vector<Heard>& spare) {
    constexpr std::size_t few = 64;
    constexpr std::size_t at_once = 4;
    using Several = std::int32_t __attribute__((vector_size(at_once * sizeof(std::int32_t))));
    constexpr std::int32_t never = std::numeric_limits<std::int32_t>::max();
    std::array<Several, few / at_once> delays_ps;
    std::array<Several, few / at_once> radios;
    std::int64_t latest_ps = 0;
    const std::size_t count = std::min(heard.size(), few);
    for (std::size_t i = 0; i < count; ++i) {
        const std::int64_t delay_ps = (heard[i].start - sent).ps();
        latest_ps = std::max(latest_ps, delay_ps);
        delays_ps[i / at_once][i % at_once] = static_cast<std::int32_t>(delay_ps);
        radios[i / at_once][i % at_once] = heard[i].radio;
    }
    const bool fits = latest_ps < never;  // as within 600 km
    if (heard.size() > few || !fits) {
        std::sort(heard.begin(), heard.end(), [](const Heard& a, const Heard& b) {
            return a.start != b.start ? a.start < b.start : a.radio < b.radio;
        });
        return;
    }
    std::size_t filled = count;
    for (; filled % at_once != 0; ++filled) {
        delays_ps[filled / at_once][filled % at_once] = never;  // before nobody
        radios[filled / at_once][filled % at_once] = 0;
    }
    spare.resize(count);
    for (std::size_t i = 0; i < count; ++i) {
        const std::int32_t delay_ps = delays_ps[i / at_once][i % at_once];
        const std::int32_t radio = radios[i / at_once][i % at_once];
        Several before{};
        for (std::size_t group = 0; group < filled / at_once; ++group) {
            before -=
                (delays_ps[group] < delay_ps) | ((delays_ps[group] == delay_ps) & (radios[group] < radio));
        }
        const std::int32_t place = before[0] + before[1] + before[2] + before[3];
        spare[static_cast<std::size_t>(place)] = heard[i];
    }
    heard.swap(spare);
}

}  // namespace netsim
