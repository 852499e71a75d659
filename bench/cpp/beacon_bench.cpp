// Beacons in networks of constant density: what a delivered frame costs from 100 to 10,000 nodes.
//
// Nodes stand or fly in a square with 100 of them to each square kilometre and 2 mW each, so that about 20 hear a
// frame; each broadcasts 100 B once a second, at a phase of its own.
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

#include "netsim/kernel/random.hpp"
#include "netsim/node/network.hpp"

namespace {

using netsim::Node;
using netsim::NodeConfig;
using netsim::Payload;
using netsim::Position;
using netsim::SimTime;

constexpr netsim::Purpose scenario_draws{1002};

std::size_t heap_bytes() {
    const struct mallinfo2 info = mallinfo2();
    return info.uordblks + info.hblkhd;
}

class Beacon final : public netsim::Protocol {
public:
    Beacon(Node& node, SimTime first, Payload text, double flight_area_m)
        : node_(node),
          next_(first),
          text_(std::move(text)),
          flight_area_m_(flight_area_m),
          draws_(2, static_cast<std::uint32_t>(node.id()), scenario_draws) {}

    void initialize() override { node_.schedule_timer("beacon", next_); }
    void handle_timer(const std::string&) override {
        node_.broadcast(text_);
        next_ += SimTime::from_us(1'000'000);
        node_.schedule_timer("beacon", next_);
        if (flight_area_m_ > 0 && draws_.uniform_int(10) == 0) {
            node_.go_to({draws_.uniform() * flight_area_m_, draws_.uniform() * flight_area_m_, 0});
        }
    }
    void handle_packet(const Payload&) override {}
    void handle_telemetry(const Position&) override {}
    void finish() override {}

private:
    Node& node_;
    SimTime next_;
    Payload text_;
    double flight_area_m_;
    netsim::RandomStream draws_;
};

std::unique_ptr<netsim::Network> make_network(std::int64_t count, double speed_mps, double bitrate_bps) {
    auto network = std::make_unique<netsim::Network>(netsim::MediumConfig(), 1);
    netsim::RandomStream draws(1, 0, scenario_draws);
    const double side_m = 100 * std::sqrt(static_cast<double>(count));
    const auto text = std::make_shared<const std::string>(100, 'x');
    for (std::int64_t i = 0; i < count; ++i) {
        NodeConfig config("node " + std::to_string(i));
        config.initial_position = {draws.uniform() * side_m, draws.uniform() * side_m, 0};
        config.wlan[0].radio.tx_power_w = 0.002;
        config.wlan[0].mac.bitrate_bps = bitrate_bps;
        config.mobility.speed_mps = speed_mps;
        config.mobility.telemetry_interval_s = 0;
        Node& node = network->add_node(config);
        node.set_protocol(std::make_unique<Beacon>(node, SimTime::from_seconds(draws.uniform()), text,
                                                   speed_mps > 0 ? side_m : 0));
    }
    network->initialize();
    return network;
}

void run_beacons(benchmark::State& state, std::int64_t count, double speed_mps, double bitrate_bps) {
    const std::size_t before = heap_bytes();
    const auto network = make_network(count, speed_mps, bitrate_bps);
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
