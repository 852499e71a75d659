// Random scenarios whose nodes are 802.15.4 devices, some of them beside 802.11 stations.
#pragma once

#include <algorithm>

#include "support/random_scenario.hpp"

namespace netsim::test {

inline RandomScenario make_narrowband_scenario(std::uint64_t seed) {
    RandomScenario scenario = make_random_scenario(seed, 3, 30);
    RandomStream draws(seed, 2, Purpose{1001});
    const auto chance = [&draws](double share) { return draws.uniform() < share; };
    const auto below = [&draws](int count) {
        return static_cast<int>(draws.uniform_int(static_cast<std::uint32_t>(count)));
    };
    const double mixed_share = chance(0.3) ? 0.5 : 1;
    const bool two_channels = chance(0.2);
    const double snir_threshold_db = chance(0.5) ? -8 : 1;
    const bool eager = chance(0.3);  // many frames in one instant

    for (NodeConfig& node : scenario.nodes) {
        if (!chance(mixed_share)) {
            continue;
        }
        const RadioConfig usual = RadioConfig(ieee80211_interface);
        NodeConfig device(node.name, std::string(ieee802154_interface));
        device.initial_position = node.initial_position;
        device.mobility = node.mobility;
        device.radio.tx_power_w *= node.radio.tx_power_w / usual.tx_power_w;
        device.radio.sensitivity_w *= node.radio.sensitivity_w / usual.sensitivity_w;
        device.radio.energy_detection_w *= node.radio.energy_detection_w / usual.energy_detection_w;
        device.radio.noise_figure = node.radio.noise_figure;
        device.radio.energy_detection_w =
            std::max(device.radio.energy_detection_w,
                     1.01 * BackgroundNoise(scenario.medium)
                                .power_w(device.radio.bandwidth_hz, device.radio.noise_figure));
        device.radio.snir_mode = node.radio.snir_mode;
        device.radio.preamble_detection = node.radio.preamble_detection;
        device.radio.preamble_threshold = node.radio.preamble_threshold;
        device.radio.preamble_minimum_power_w = node.radio.preamble_minimum_power_w;
        device.radio.preamble_duration_s = node.radio.preamble_duration_s;
        device.radio.frame_capture = node.radio.frame_capture;
        device.radio.capture_margin = node.radio.capture_margin;
        device.radio.capture_window_s = 20 * node.radio.capture_window_s;  // frames are longer as well
        device.radio.snir_threshold = ratio_from_db(snir_threshold_db);
        if (two_channels && chance(0.5)) {
            device.radio.carrier_hz = 2.455e9;
        }
        device.csma.use_acks = chance(0.8);
        device.csma.max_frame_retries = below(4);
        device.csma.max_backoffs = below(5);
        device.csma.backoff_method = backoff_method_names[static_cast<std::size_t>(below(3))];
        device.csma.min_be = eager ? 0 : below(4);
        device.csma.max_be = eager ? 1 : 3 + below(3);
        device.csma.cca_whole_window = chance(0.3);
        device.csma.queue_capacity = chance(0.8) ? 100 : 1;
        device.csma.lifs_s = chance(0.3) ? 640e-6 : 0;
        node = device;
    }
    scenario.talk.longest_text = 70;  // behind a number of the sender and one of the message
    scenario.talk.until = SimTime::from_seconds(scenario.talk.until.seconds() * 5);
    if (scenario.talk.beat > SimTime()) {
        scenario.talk.beat = SimTime::from_ps(scenario.talk.until.ps() / 3);
    }
    return scenario;
}

}  // namespace netsim::test
