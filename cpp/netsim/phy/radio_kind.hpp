// What the radios of one configuration in one network have in common: made once, never changed, shared by all of them. The
// power at which a radio sends is its own: that differs from node to node more often than anything else.
//
// In a large network the memory that a frame touches at each radio decides how fast it is; this lies in one place.
#pragma once

#include <cstdint>
#include <memory>

#include "netsim/config/radio_config.hpp"
#include "netsim/medium/medium.hpp"
#include "netsim/phy/error_rate.hpp"
#include "netsim/phy/frame_capture.hpp"
#include "netsim/phy/preamble_detection.hpp"
#include "netsim/phy/reception.hpp"
#include "netsim/propagation/antenna_pattern.hpp"
#include "netsim/propagation/transmission.hpp"

namespace netsim {

class RadioKind {
public:
    // `seed` is that of the run. Throws ConfigError for an error model that is not there, and for what is wrong in its file.
    RadioKind(const RadioConfig& config, Medium& medium, std::uint64_t seed);

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
};

}  // namespace netsim
