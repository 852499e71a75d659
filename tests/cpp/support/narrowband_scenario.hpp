// Random scenarios whose nodes are 802.15.4 devices, some of them next to 802.11 stations.
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
    const bool eager = chance(0.3);  // many frames at one instant

    for (NodeConfig& node : scenario.nodes) {
        if (!chance(mixed_share)) {
            continue;
        }
        const RadioConfig usual = RadioConfig(ieee80211_interface);
        NodeConfig device(node.name, {std::string(ieee802154_interface)});
        device.initial_position = node.initial_position;
        device.mobility = node.mobility;
        const RadioConfig& station = node.wlan[0].radio;
        RadioConfig& radio = device.wlan[0].radio;
        CsmaConfig& csma = device.wlan[0].csma;
        radio.tx_power_w *= station.tx_power_w / usual.tx_power_w;
        radio.sensitivity_w *= station.sensitivity_w / usual.sensitivity_w;
        radio.energy_detection_w *= station.energy_detection_w / usual.energy_detection_w;
        radio.noise_figure = station.noise_figure;
        radio.energy_detection_w =
            std::max(radio.energy_detection_w,
                     1.01 * BackgroundNoise(scenario.medium).power_w(radio.bandwidth_hz, radio.noise_figure));
        radio.snir_mode = station.snir_mode;
        radio.preamble_detection = station.preamble_detection;
        radio.preamble_threshold = station.preamble_threshold;
        radio.preamble_minimum_power_w = station.preamble_minimum_power_w;
        radio.preamble_duration_s = station.preamble_duration_s;
        radio.frame_capture = station.frame_capture;
        radio.capture_margin = station.capture_margin;
        radio.capture_window_s = 20 * station.capture_window_s;  // frames are longer as well
        radio.snir_threshold = ratio_from_db(snir_threshold_db);
        if (two_channels && chance(0.5)) {
            radio.carrier_hz = 2.455e9;
        }
        csma.use_acks = chance(0.8);
        csma.max_frame_retries = below(4);
        csma.max_backoffs = below(5);
        csma.backoff_method = backoff_method_names[static_cast<std::size_t>(below(3))];
        csma.min_be = eager ? 0 : below(4);
        csma.max_be = eager ? 1 : 3 + below(3);
        csma.cca_whole_window = chance(0.3);
        csma.queue_capacity = chance(0.8) ? 100 : 1;
        csma.lifs_s = chance(0.3) ? 640e-6 : 0;
        node = device;
    }
    scenario.talk.longest_text = 70;  // after the numbers of the sender and of the message
    scenario.talk.until = SimTime::from_seconds(scenario.talk.until.seconds() * 5);
    if (scenario.talk.beat > SimTime()) {
        scenario.talk.beat = SimTime::from_ps(scenario.talk.until.ps() / 3);
    }
    return scenario;
}

}  // namespace netsim::test
