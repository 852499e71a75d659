// Broadcasts that start at the same instant, as with protocols without jitter, or almost at the
// same instant, as with clocks synchronized by GPS. Almost none is received, and all of them are
// concurrent.
//
// Goals: 1,000 nodes that send at one instant or within 100 ns take at most twice as long as 1,000
// that send within a millisecond. Within a microsecond they take at most three times as long.
#include <array>
#include <cstdio>
#include <ctime>

#include <benchmark/benchmark.h>

#include "beacon_network.hpp"

namespace {

using netsim::SimTime;

double cpu_s_of(double spread_s) {
    const auto network = make_beacon_network(1'000, 0, -1, spread_s);
    const std::clock_t begin = std::clock();
    network->run_until(SimTime::from_us(2'500'000));
    return static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
}

void compare_with_spread_out(benchmark::State& state, double spread_s, double max_times) {
    double spread_out_s = 0;
    double together_s = 0;
    for (auto _ : state) {
        spread_out_s += cpu_s_of(1e-3);
        together_s += cpu_s_of(spread_s);
    }
    const double times = together_s / spread_out_s;
    state.counters["times_spread_out"] = times;
    std::array<char, 80> text{};
    std::snprintf(text.data(), text.size(), "times those within 1 ms %.3g (goal: at most %g, %s)", times,
                  max_times, times <= max_times ? "reached" : "missed");
    state.SetLabel(text.data());
}

void in_one_instant(benchmark::State& state) {
    compare_with_spread_out(state, 0, 2);
}
void within_100_ns(benchmark::State& state) {
    compare_with_spread_out(state, 1e-7, 2);
}
void within_1_us(benchmark::State& state) {
    compare_with_spread_out(state, 1e-6, 3);
}
BENCHMARK(in_one_instant)->Unit(benchmark::kMillisecond);
BENCHMARK(within_100_ns)->Unit(benchmark::kMillisecond);
BENCHMARK(within_1_us)->Unit(benchmark::kMillisecond);

}  // namespace
