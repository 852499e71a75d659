// Random scenarios on a line of places a light-microsecond apart. All frames start at integer
// microseconds: they arrive, end and are sent at the same instants, in all orders. Some are
// answered at the instant in which they end.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "netsim/propagation/path_loss.hpp"
#include "support/random_scenario.hpp"

namespace netsim::test {

inline RandomScenario make_light_step_scenario(std::uint64_t seed) {
    RandomStream draws(seed, 9, Purpose{1001});
    const auto between = [&draws](double low, double high) { return low + draws.uniform() * (high - low); };
    const auto chance = [&draws](double share) { return draws.uniform() < share; };
    const auto steps = [&draws](std::uint32_t count) {
        return 299.792458 * static_cast<double>(draws.uniform_int(count));
    };

    RandomScenario scenario;
    scenario.seed = seed;
    scenario.medium = MediumConfig(std::string(ieee80211_scalar_medium));
    std::vector<double> crowded_places_m;
    for (std::uint32_t i = 0; i <= draws.uniform_int(4); ++i) {
        crowded_places_m.push_back(steps(6));
    }
    const double detection_w =
        std::max(std::pow(10, between(-12.5, -9)), 1.05 * scenario.medium.background_noise_w);
    const int count = 12 + static_cast<int>(draws.uniform_int(30));
    for (int id = 0; id < count; ++id) {
        NodeConfig node("node " + std::to_string(id));
        const auto crowd = draws.uniform_int(static_cast<std::uint32_t>(crowded_places_m.size()));
        node.initial_position.x = chance(0.5) ? crowded_places_m[crowd] : steps(13);
        RadioConfig& radio = node.wlan[0].radio;
        radio.energy_detection_w = detection_w;
        radio.sensitivity_w *= chance(0.5) ? 1 : ratio_from_db(between(0, 30));
        radio.tx_power_w *= ratio_from_db(between(-10, 0));
        MacConfig& mac = node.wlan[0].mac;
        mac.bitrate_bps = chance(0.5) ? 1e6 : -1;
        mac.cw_min = chance(0.5) ? 0 : 7;
        mac.cw_max = 15;
        mac.skip_backoff_if_idle = chance(0.3);
        mac.initial_channel_busy = false;
        mac.rts_threshold_bytes = chance(0.5) ? 0 : 2000;
        node.mobility.telemetry_interval_s = 0;
        scenario.nodes.push_back(node);
    }
    scenario.talk.seed = seed;
    scenario.talk.node_count = count;
    scenario.talk.rounds = 20 + draws.uniform_int(60);
    scenario.talk.longest_burst = 1;
    scenario.talk.longest_text = chance(0.5) ? 30 : 600;
    scenario.talk.broadcast_share = between(0, 0.6);
    scenario.talk.until = SimTime::from_us(20'000 + draws.uniform_int(60'000));
    scenario.talk.beat = SimTime::from_us(1);
    scenario.talk.late = chance(0.5) ? 0.5 : 0;
    scenario.talk.answers = chance(0.6) ? between(0, 0.6) : 0;
    if (chance(0.5)) {
        // Some frames give each receiver exactly the necessary energy, if they come together: then
        // their sum must not depend on the model.
        const PathLoss path_loss = make_path_loss(scenario.medium);
        for (NodeConfig& node : scenario.nodes) {
            RadioConfig& radio = node.wlan[0].radio;
            radio.energy_detection_w = 1.05 * scenario.medium.background_noise_w;
            double sum_w = scenario.medium.background_noise_w;
            for (std::uint32_t i = 0; i < 4; ++i) {
                const NodeConfig& other =
                    scenario.nodes[draws.uniform_int(static_cast<std::uint32_t>(count))];
                const double distance_m = distance(node.initial_position, other.initial_position);
                if (distance_m > 0) {
                    sum_w += other.wlan[0].radio.tx_power_w * path_loss.gain(distance_m, radio.carrier_hz);
                    radio.energy_detection_w = sum_w;
                }
            }
        }
    }
    return scenario;
}

}  // namespace netsim::test
