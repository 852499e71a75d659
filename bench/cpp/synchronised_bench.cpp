// Broadcasts that all begin in one instant, as those of protocols whose timers nobody spread: none is received, and each
// of them is beside each other one.
//
// Goal: 1,000 nodes that send in one instant take at most twice the time of 1,000 that send within a millisecond.
#include <array>
#include <cstdio>
#include <ctime>

#include <benchmark/benchmark.h>

#include "beacon_network.hpp"

namespace {

using netsim::SimTime;

void in_one_instant(benchmark::State& state) {
    constexpr double most_times = 2;
    const auto cpu_s_of = [](double spread_s) {
        const auto network = make_beacon_network(1'000, 0, -1, spread_s);
        const std::clock_t begin = std::clock();
        network->run_until(SimTime::from_us(2'500'000));
        return static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
    };
    double spread_out_s = 0;
    double at_once_s = 0;
    for (auto _ : state) {
        spread_out_s += cpu_s_of(1e-3);
        at_once_s += cpu_s_of(0);
    }
    const double times = at_once_s / spread_out_s;
    state.counters["times_spread_out"] = times;
    std::array<char, 80> text{};
    std::snprintf(text.data(), text.size(), "times those within 1 ms %.3g (goal: at most %g, %s)", times,
                  most_times, times <= most_times ? "reached" : "missed");
    state.SetLabel(text.data());
}
BENCHMARK(in_one_instant)->Unit(benchmark::kMillisecond);

}  // namespace
