// Random scenarios: nodes with good, marginal and hopeless links, and bursts of messages that
// collide.
#pragma once

#include <algorithm>
#include <cmath>
#include <memory>
#include <numeric>
#include <ostream>
#include <string>
#include <vector>

#include "netsim/node/network.hpp"
#include "netsim/units.hpp"
#include "support/talker.hpp"

namespace netsim::test {

struct RandomScenario {
    std::uint64_t seed = 0;
    MediumConfig medium;
    std::vector<NodeConfig> nodes;
    Talk talk;
};

inline RandomScenario make_random_scenario(std::uint64_t seed, int fewest_nodes = 3, int max_nodes = 40) {
    RandomStream draws(seed, 0, Purpose{1001});
    const auto between = [&draws](double low, double high) { return low + draws.uniform() * (high - low); };
    const auto log_between = [&](double low, double high) {
        return low * std::pow(high / low, draws.uniform());
    };
    const auto chance = [&draws](double share) { return draws.uniform() < share; };

    RandomScenario scenario;
    scenario.seed = seed;
    const bool narrowband = chance(0.4);
    scenario.medium =
        MediumConfig(std::string(narrowband ? ieee802154_scalar_medium : ieee80211_scalar_medium));
    if (!narrowband && chance(0.3)) {
        scenario.medium.alpha = between(1.8, 3);
    }
    const double typical_reach_m = narrowband ? 120 : 700;
    const double area_m = typical_reach_m * log_between(0.3, 5);
    const std::string op_mode(op_mode_names[draws.uniform_int(op_mode_names.size())]);
    const bool two_channels = chance(0.2);
    const bool two_bandwidths = chance(0.2);
    // 0: the same for all nodes.
    const double sensitivity_spread_db = chance(0.5) ? 0 : 12;
    const double detection_offset_db = between(-15, 15);
    const double detection_spread_db = chance(0.5) ? 0 : 10;
    const double power_spread_db = chance(0.5) ? 0 : 15;
    const double lattice_m = chance(0.3) ? area_m / 4 : 0;  // equal distances, shared places
    const bool short_backoffs = chance(0.3);                // many frames at one instant

    // From a separate stream, so that scenarios without RTS do not change.
    RandomStream rts_draws(seed, 1, Purpose{1001});
    const bool with_rts = rts_draws.uniform() < 0.5;
    // The same for options of the receiver, drawn for each node.
    RandomStream option_draws(seed, 3, Purpose{1001});
    const auto option = [&option_draws](double share) { return option_draws.uniform() < share; };
    const bool with_options = option(0.5);
    if (with_options && option(0.4)) {
        scenario.medium.background_noise = thermal_noise;
        scenario.medium.temperature_k = 400 * option_draws.uniform();
    }
    const BackgroundNoise noise(scenario.medium);
    // The same for the operation modes of stations with different ones.
    RandomStream mode_draws(seed, 5, Purpose{1001});
    const bool of_several_modes = mode_draws.uniform() < 0.3;

    // The same for rules of ns-3's channel access, drawn for each node.
    RandomStream ns3_draws(seed, 7, Purpose{1001});
    const bool with_ns3_rules = ns3_draws.uniform() < 0.3;

    const int count = fewest_nodes + static_cast<int>(draws.uniform_int(max_nodes - fewest_nodes + 1));
    for (int id = 0; id < count; ++id) {
        NodeConfig node("node " + std::to_string(id));
        node.initial_position = {between(0, area_m), between(0, area_m),
                                 chance(0.5) ? 0 : between(0, area_m / 10)};
        if (lattice_m > 0) {
            node.initial_position = {std::round(node.initial_position.x / lattice_m) * lattice_m,
                                     std::round(node.initial_position.y / lattice_m) * lattice_m, 0};
        }
        RadioConfig& radio = node.wlan[0].radio;
        MacConfig& mac = node.wlan[0].mac;
        radio.tx_power_w *= ratio_from_db(between(-power_spread_db, power_spread_db / 3));
        radio.sensitivity_w *= ratio_from_db(between(-sensitivity_spread_db, sensitivity_spread_db));
        radio.energy_detection_w *=
            ratio_from_db(detection_offset_db + between(-detection_spread_db, detection_spread_db));
        if (two_channels && chance(0.5)) {
            radio.carrier_hz = 2.437e9;
        }
        if (two_bandwidths && chance(0.5)) {
            radio.bandwidth_hz = 20e6;
        }
        if (with_options) {
            mac.skip_backoff_if_idle = option(0.3);
            radio.noise_figure = 1 + 9 * option_draws.uniform();
            radio.snir_mode = option(0.5) ? "chunks" : "min";
            radio.snir_threshold *= option(0.5) ? 1 : option_draws.uniform();
            radio.preamble_detection = option(0.5) ? "ThresholdPreambleDetection" : "";
            radio.preamble_threshold = ratio_from_db(-5 + 12 * option_draws.uniform());
            radio.preamble_minimum_power_w *= ratio_from_db(-15 + 20 * option_draws.uniform());
            radio.preamble_duration_s = option(0.8) ? 4e-6 : 300e-6 * (0.001 + option_draws.uniform());
            radio.frame_capture = option(0.5) ? "SimpleFrameCapture" : "";
            radio.capture_margin = ratio_from_db(10 * option_draws.uniform());
            radio.capture_window_s = option(0.5) ? 16e-6 : 1e-3 * option_draws.uniform();
        }
        radio.energy_detection_w =
            std::max(radio.energy_detection_w, 1.01 * noise.power_w(radio.bandwidth_hz, radio.noise_figure));
        mac.op_mode = of_several_modes
                          ? std::string(op_mode_names[mode_draws.uniform_int(op_mode_names.size())])
                          : op_mode;
        const auto modes = mode_set(mac.op_mode).modes();
        mac.bitrate_bps = static_cast<double>(
            modes[draws.uniform_int(static_cast<std::uint32_t>(modes.size()))].bitrate_bps);
        if (short_backoffs) {
            mac.cw_min = 0;
            mac.cw_max = 3;
        }
        mac.backoff_optimization = chance(0.8);
        mac.initial_channel_busy = chance(0.5);
        mac.queue_capacity = chance(0.8) ? 100 : 2;
        if (with_rts) {
            mac.rts_threshold_bytes = static_cast<int>(rts_draws.uniform_int(600));
            mac.control_bitrate_bps = rts_draws.uniform() < 0.5 ? -1 : mac.bitrate_bps;
            mac.own_frames_set_nav = rts_draws.uniform() < 0.7;
            mac.inet_eifs = rts_draws.uniform() < 0.3;
            mac.inet_station_retry_counters = rts_draws.uniform() < 0.3;
        }
        if (with_ns3_rules) {
            mac.ns3_eifs = ns3_draws.uniform() < 0.5;
            mac.ns3_station_window = ns3_draws.uniform() < 0.5;
            mac.unanswered_rts_resets_nav = ns3_draws.uniform() < 0.5;
        }
        node.mobility.telemetry_interval_s = 0;
        scenario.nodes.push_back(node);
    }

    scenario.talk.seed = seed;
    scenario.talk.node_count = count;
    scenario.talk.rounds = 1 + draws.uniform_int(4);
    scenario.talk.longest_burst = 1 + draws.uniform_int(4);
    scenario.talk.longest_text = chance(0.5) ? 50 : 1500;
    scenario.talk.broadcast_share = between(0, 1);
    scenario.talk.until = SimTime::from_seconds(count * log_between(1e-4, 1e-2));
    scenario.talk.area_m = area_m;
    scenario.talk.moves = chance(0.4);
    scenario.talk.beat = chance(0.5) ? SimTime::from_ps(scenario.talk.until.ps() / 3) : SimTime();
    return scenario;
}

// A running scenario, with its deliveries.
class ScenarioRun {
public:
    explicit ScenarioRun(const RandomScenario& scenario, Culling culling = Culling::enabled,
                         bool is_recorded = false)
        : network(scenario.medium, scenario.seed, culling) {
        for (const NodeConfig& config : scenario.nodes) {
            Node& node = network.add_node(config);
            node.set_protocol(std::make_unique<Talker>(node, scenario.talk, deliveries));
        }
        if (is_recorded) {
            std::vector<NodeId> all(scenario.nodes.size());
            std::iota(all.begin(), all.end(), 0);
            recorder = &network.record(all);
        }
        network.initialize();
    }

    Network network;
    ReplayRecorder* recorder = nullptr;
    std::vector<Delivery> deliveries;
};

}  // namespace netsim::test
