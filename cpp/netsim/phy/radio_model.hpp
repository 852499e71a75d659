// Data shared by all radios with the same configuration in one network. Created once and never
// changed. The transmit power is not part of it, since it often differs from node to node.
//
// In a large network, the memory that a frame touches at each radio determines the speed. Sharing
// keeps it small.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <utility>

#include "netsim/config/radio_config.hpp"
#include "netsim/medium/medium.hpp"
#include "netsim/phy/error_rate.hpp"
#include "netsim/phy/frame_capture.hpp"
#include "netsim/phy/preamble_detection.hpp"
#include "netsim/phy/reception.hpp"
#include "netsim/propagation/antenna_pattern.hpp"
#include "netsim/propagation/transmission.hpp"

namespace netsim {

class RadioModel {
public:
    // `seed`: of the run. Throws ConfigError for an unknown error model or an invalid file.
    RadioModel(const RadioConfig& config, Medium& medium, std::uint64_t seed);

    // The SNIR, a ratio, with which half of the frames of that length survive; at most 100
    // dB.
    double needed_snir(const Mode& mode, int psdu_bytes) const;
    // The same for the PHY headers alone, where they are decided separately (by_chunks).
    double needed_header_snir(const Mode& mode) const;

    Medium& medium;
    std::uint64_t seed;
    Band band;
    double sensitivity_w;
    double energy_detection_w;
    ReceptionModel reception;
    bool by_chunks;
    FrameCapture frame_capture;
    PreambleDetection preamble_detection;
    std::unique_ptr<const AntennaPattern> antenna;  // null: isotropic
    Orientation antenna_offset;

private:
    std::shared_ptr<const ErrorModel> error_model_;
    mutable std::map<std::pair<const Mode*, int>, double> needed_snir_;  // results so far
};

}  // namespace netsim
