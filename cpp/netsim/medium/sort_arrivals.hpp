// Sorts the arrivals of one transmission by start, then by radio: the order of their events.
//
// Up to 64 arrivals, the usual case, are sorted by rank: the index of each is the number of arrivals
// before it. Ranks are counted without branches, four at a time, since one branch misprediction costs
// as much as many comparisons.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "netsim/kernel/sim_time.hpp"

namespace netsim {

// Sorts the arrivals of a transmission that started at `sent`. An `Arrival` has a `start`, not before
// `sent`, and a `radio`, different for each. `spare` is working memory.
template <typename Arrival>
void sort_arrivals(std::vector<Arrival>& arrivals, SimTime sent, std::vector<Arrival>& spare) {
    constexpr std::size_t few = 64;
    constexpr std::size_t lanes = 4;
    using Vector = std::int32_t __attribute__((vector_size(lanes * sizeof(std::int32_t))));
    constexpr std::int32_t never = std::numeric_limits<std::int32_t>::max();
    std::array<Vector, few / lanes> delays_ps;
    std::array<Vector, few / lanes> radios;
    std::int64_t latest_ps = 0;
    const std::size_t count = std::min(arrivals.size(), few);
    for (std::size_t i = 0; i < count; ++i) {
        const std::int64_t delay_ps = (arrivals[i].start - sent).ps();
        latest_ps = std::max(latest_ps, delay_ps);
        delays_ps[i / lanes][i % lanes] = static_cast<std::int32_t>(delay_ps);
        radios[i / lanes][i % lanes] = arrivals[i].radio;
    }
    const bool fits = latest_ps < never;  // up to 643 km
    if (arrivals.size() > few || !fits) {
        std::sort(arrivals.begin(), arrivals.end(), [](const Arrival& a, const Arrival& b) {
            return a.start != b.start ? a.start < b.start : a.radio < b.radio;
        });
        return;
    }
    std::size_t filled = count;
    for (; filled % lanes != 0; ++filled) {
        delays_ps[filled / lanes][filled % lanes] = never;  // sorts last
        radios[filled / lanes][filled % lanes] = 0;
    }
    spare.resize(count);
    for (std::size_t i = 0; i < count; ++i) {
        const std::int32_t delay_ps = delays_ps[i / lanes][i % lanes];
        const std::int32_t radio = radios[i / lanes][i % lanes];
        Vector before{};
        for (std::size_t group = 0; group < filled / lanes; ++group) {
            before -=
                (delays_ps[group] < delay_ps) | ((delays_ps[group] == delay_ps) & (radios[group] < radio));
        }
        const std::int32_t place = before[0] + before[1] + before[2] + before[3];
        spare[static_cast<std::size_t>(place)] = arrivals[i];
    }
    arrivals.swap(spare);
}

}  // namespace netsim
