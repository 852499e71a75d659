// Data shared by all radios with the same configuration in one network. Created once and never
// changed. The usual transmit power is not part of it, since it often differs from node to node.
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

    // The power in W of a frame in that mode, from a radio with that usual power.
    double tx_power_w(const Mode& mode, double usual_w) const {
        return netsim::tx_power_w(static_cast<double>(mode.bitrate_bps), usual_w, tx_power_by_bitrate_w_);
    }

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
    PowersByBitrate tx_power_by_bitrate_w_;
    std::shared_ptr<const ErrorModel> error_model_;
    mutable std::map<std::pair<const Mode*, int>, double> needed_snir_;  // results so far
};

}  // namespace netsim
