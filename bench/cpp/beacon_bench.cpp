// Beacons in networks of constant density: cost of a delivered frame with 100 to 10,000 nodes.
//
// Goals: the time per delivered frame at 10,000 nodes is at most 1.3 times the time at 100 nodes.
// 10,000 nodes run faster than real time on one core. A node has less than 4 kB of memory, which
// does not grow over simulated time. The lines of 10,000 nodes end with the distances to the goals.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <ctime>
#include <malloc.h>
#include <memory>
#include <string>
#include <vector>

#include <benchmark/benchmark.h>

#include "beacon_network.hpp"

namespace {

using netsim::SimTime;

std::size_t heap_bytes() {
    const struct mallinfo2 info = mallinfo2();
    return info.uordblks + info.hblkhd;
}

// "name figure (goal: at most 1.3, missed by a factor of 2)".
std::string judged(const std::string& name, double figure, const char* relation, double goal,
                   double too_much) {
    std::array<char, 160> text{};
    if (too_much > 1) {
        std::snprintf(text.data(), text.size(), "%s %.4g (goal: %s %g, missed by a factor of %.3g)",
                      name.c_str(), figure, relation, goal, too_much);
    } else {
        std::snprintf(text.data(), text.size(), "%s %.4g (goal: %s %g, reached)", name.c_str(), figure,
                      relation, goal);
    }
    return text.data();
}

// For one kind of network. Flatness is omitted if the network of 100 nodes did not run.
std::string distances_to_goals(double ns_of_100_nodes, double ns_per_frame, double x_real_time,
                               double bytes_per_node) {
    constexpr double max_times = 1.3;
    constexpr double max_bytes = 4096;
    const double times = ns_per_frame / ns_of_100_nodes;
    return (ns_of_100_nodes > 0
                ? judged("times 100 nodes'", times, "at most", max_times, times / max_times) + "; "
                : "") +
           judged("x_real_time", x_real_time, "more than", 1, 1 / x_real_time) + "; " +
           judged("bytes per node", bytes_per_node, "less than", max_bytes, bytes_per_node / max_bytes);
}

// Networks of one size, each with its own places and phases. A single small network is not
// representative: its phases never change, and with 100 nodes it is chance whether any two frames
// overlap.
class BeaconNetworks {
public:
    BeaconNetworks(std::int64_t nodes, double speed_mps, double bitrate_bps)
        : BeaconNetworks(std::max<std::int64_t>(1, 2'000 / nodes), nodes, speed_mps, bitrate_bps, 20) {}
    // `count` networks, each of which runs for `seconds_in_turn` in turn.
    BeaconNetworks(std::int64_t count, std::int64_t nodes, double speed_mps, double bitrate_bps,
                   std::size_t seconds_in_turn)
        : seconds_in_turn_(seconds_in_turn) {
        for (std::int64_t i = 0; i < count; ++i) {
            networks_.push_back(
                make_beacon_network(nodes, speed_mps, bitrate_bps, 1, static_cast<std::uint64_t>(i + 1)));
            networks_.back()->run_until(one_second);
        }
    }

    // Each runs long enough to make the cache contents of the one before irrelevant; then the next
    // one runs.
    void run_a_second() {
        netsim::Network& network = *networks_[(seconds_++ / seconds_in_turn_) % networks_.size()];
        network.run_until(network.now() + one_second);
    }
    std::size_t size() const { return networks_.size(); }
    double seconds() const { return static_cast<double>(seconds_); }
    double delivered() const {
        constexpr auto outcome = static_cast<std::size_t>(netsim::FrameOutcome::delivered);
        std::uint64_t sum = 0;
        for (const auto& network : networks_) {
            sum += network->frame_outcomes().counts(netsim::FrameKind::broadcast, false)[outcome];
        }
        return static_cast<double>(sum);
    }

private:
    static constexpr SimTime one_second = SimTime::from_us(1'000'000);

    std::size_t seconds_in_turn_;
    std::vector<std::unique_ptr<netsim::Network>> networks_;
    std::size_t seconds_ = 0;
};

// Return the CPU time.
double run_seconds(benchmark::State& state, BeaconNetworks& networks) {
    const double delivered_before = networks.delivered();
    const std::clock_t clock_before = std::clock();
    for (auto _ : state) {
        networks.run_a_second();
    }
    const double cpu_s = static_cast<double>(std::clock() - clock_before) / CLOCKS_PER_SEC;
    state.counters["ns_per_frame"] = cpu_s / (networks.delivered() - delivered_before) * 1e9;
    return cpu_s;
}

// For each size, the results of the last run.
struct Found {
    double ns_of_100_nodes = 0;
    double ns_of_10_000_nodes = 0;
};

void run_beacons(benchmark::State& state, double speed_mps, double bitrate_bps, Found& found) {
    const std::int64_t count = state.range(0);
    const std::size_t before = heap_bytes();
    BeaconNetworks networks(count, speed_mps, bitrate_bps);
    const double cpu_s = run_seconds(state, networks);
    const double ns_per_frame = state.counters["ns_per_frame"];
    const double x_real_time = networks.seconds() / cpu_s;
    const double bytes_per_node = static_cast<double>(heap_bytes() - before) / static_cast<double>(count) /
                                  static_cast<double>(networks.size());
    state.counters["x_real_time"] = x_real_time;
    state.counters["bytes_per_node"] = bytes_per_node;
    if (count == 100) {
        found.ns_of_100_nodes = ns_per_frame;
    }
    if (count == 10'000) {
        found.ns_of_10_000_nodes = ns_per_frame;
        state.SetLabel(distances_to_goals(found.ns_of_100_nodes, ns_per_frame, x_real_time, bytes_per_node));
    }
}

Found of_standing;

void standing(benchmark::State& state) {
    run_beacons(state, 0, -1, of_standing);
}
BENCHMARK(standing)->Arg(100)->Arg(1'000)->Arg(10'000)->Unit(benchmark::kMillisecond);

// As many nodes as in the largest network, in separate small networks. A frame that costs more
// here than in one small network does so because the total memory exceeds the caches, not because
// many nodes share a channel.
void standing_in_100_networks(benchmark::State& state) {
    constexpr std::int64_t count = 100;
    BeaconNetworks networks(count, state.range(0), 0, -1, 1);
    run_seconds(state, networks);
    if (of_standing.ns_of_10_000_nodes > 0) {
        std::array<char, 160> text{};
        std::snprintf(text.data(), text.size(),
                      "one network of all these nodes: %.4g times as much (no goal)",
                      of_standing.ns_of_10_000_nodes / state.counters["ns_per_frame"]);
        state.SetLabel(text.data());
    }
}
BENCHMARK(standing_in_100_networks)->Arg(100)->Unit(benchmark::kMillisecond)->MinTime(2);

void flying(benchmark::State& state) {
    static Found found;
    run_beacons(state, 20, -1, found);
}
BENCHMARK(flying)->Arg(100)->Arg(1'000)->Arg(10'000)->Unit(benchmark::kMillisecond);

// Slow frames: with 10,000 nodes, fifteen are on the air at the same time.
void at_1_mbps(benchmark::State& state) {
    static Found found;
    run_beacons(state, 0, 1e6, found);
}
BENCHMARK(at_1_mbps)->Arg(100)->Arg(1'000)->Arg(10'000)->Unit(benchmark::kMillisecond);

}  // namespace
