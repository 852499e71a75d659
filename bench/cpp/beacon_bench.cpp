// Beacons in networks of constant density: what a delivered frame costs from 100 to 10,000 nodes.
//
// Goals: nanoseconds per delivered frame at 10,000 nodes at most 1.3 times those at 100 nodes; 10,000 nodes faster
// than real time on one core; less than 4 kB of memory per node, which does not grow over simulated time.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <ctime>
#include <malloc.h>
#include <memory>
#include <string>

#include <benchmark/benchmark.h>

#include "beacon_network.hpp"

namespace {

using netsim::SimTime;

std::size_t heap_bytes() {
    const struct mallinfo2 info = mallinfo2();
    return info.uordblks + info.hblkhd;
}

void run_beacons(benchmark::State& state, std::int64_t count, double speed_mps, double bitrate_bps) {
    const std::size_t before = heap_bytes();
    const auto network = make_beacon_network(count, speed_mps, bitrate_bps);
    network->run_until(SimTime::from_us(1'000'000));
    const auto delivered = [&network] {
        constexpr auto fate = static_cast<std::size_t>(netsim::FrameFate::delivered);
        return static_cast<double>(network->frame_fates().counts(netsim::FrameKind::broadcast, false)[fate]);
    };
    const double delivered_before = delivered();
    const double start_s = network->now().seconds();
    const std::clock_t clock_before = std::clock();
    for (auto _ : state) {
        network->run_until(network->now() + SimTime::from_us(1'000'000));
    }
    const double cpu_s = static_cast<double>(std::clock() - clock_before) / CLOCKS_PER_SEC;
    state.counters["ns_per_frame"] = cpu_s / (delivered() - delivered_before) * 1e9;
    state.counters["x_real_time"] = (network->now().seconds() - start_s) / cpu_s;
    state.counters["bytes_per_node"] =
        static_cast<double>(heap_bytes() - before) / static_cast<double>(count);
}

void standing(benchmark::State& state) {
    run_beacons(state, state.range(0), 0, -1);
    state.SetLabel(state.range(0) < 10'000
                       ? ""
                       : "goals: ns_per_frame <= 1.3 of 100 nodes', x_real_time > 1, < 4 kB per node");
}
BENCHMARK(standing)->Arg(100)->Arg(1'000)->Arg(10'000)->Unit(benchmark::kMillisecond);

void flying(benchmark::State& state) {
    run_beacons(state, state.range(0), 20, -1);
}
BENCHMARK(flying)->Arg(100)->Arg(1'000)->Arg(10'000)->Unit(benchmark::kMillisecond);

// Slow frames: of 10,000 nodes, fifteen are on the air at once.
void at_1_mbps(benchmark::State& state) {
    run_beacons(state, state.range(0), 0, 1e6);
}
BENCHMARK(at_1_mbps)->Arg(100)->Arg(1'000)->Arg(10'000)->Unit(benchmark::kMillisecond);

}  // namespace
