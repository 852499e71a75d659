// Draws receiver options for each node of a scenario: the energy that they ignore, and for how
// long.
#pragma once

#include "support/random_scenario.hpp"

namespace netsim::test {

inline RandomScenario with_random_receivers(RandomScenario scenario) {
    RandomStream draws(scenario.seed, 0, Purpose{1007});
    const auto chance = [&draws](double share) { return draws.uniform() < share; };

    const double share_of_detectors = 0.2 + draws.uniform();
    const double longest_detection_s = chance(0.5) ? 10e-6 : 2e-3;
    for (NodeConfig& node : scenario.nodes) {
        RadioConfig& radio = node.wlan[0].radio;
        radio.preamble_detection = chance(share_of_detectors) ? "ThresholdPreambleDetection" : "";
        radio.preamble_threshold = ratio_from_db(-10 + 12 * draws.uniform());
        radio.preamble_minimum_power_w = chance(0.5) ? 0 : radio.sensitivity_w * 2 * draws.uniform();
        radio.preamble_duration_s = longest_detection_s * (0.001 + draws.uniform());
        radio.frame_capture = chance(0.3) ? "SimpleFrameCapture" : "";
        radio.snir_mode = chance(0.3) ? "chunks" : "min";
        radio.lost_header_frees_channel = chance(0.5);
    }
    return scenario;
}

}  // namespace netsim::test
