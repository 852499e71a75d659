// Preamble detection: the rule by which a radio locks on to a frame.
//
// Without it (the default), a radio locks on at once to any frame that reaches its sensitivity.
// With it, the radio first listens to a frame for `duration`. It then locks on to the frame if no
// other frame in detection is stronger, and if its power and its SNIR reach their thresholds. Sensing
// energy takes as long: a frame that has just begun does not make the channel busy yet.
//
// With `frees_channel`, a radio that loses a PHY header ignores the energy of the frames in the air. It senses
// energy again after it has listened to another frame, or when one begins while it transmits. The header is
// the part after the preamble: if another frame begins within it, no energy is ignored. ns-3 3.44 does so.
#pragma once

#include "netsim/config/radio_config.hpp"
#include "netsim/kernel/sim_time.hpp"

namespace netsim {

class PreambleDetection {
public:
    explicit PreambleDetection(const RadioConfig& config)
        : is_on_(!config.preamble_detection.empty()),
          threshold_(config.preamble_threshold),
          minimum_power_w_(config.preamble_minimum_power_w),
          frees_channel_(is_on_ && config.lost_header_frees_channel),
          duration_(is_on_ ? SimTime::from_seconds(config.preamble_duration_s) : SimTime()) {}

    bool is_on() const { return is_on_; }
    SimTime duration() const { return duration_; }  // 0 if off
    bool frees_channel() const { return frees_channel_; }
    double threshold() const { return threshold_; }  // of the SNIR, a ratio
    double minimum_power_w() const { return minimum_power_w_; }
    // `snir` is a linear ratio.
    bool detects(double power_w, double snir) const {
        return power_w >= minimum_power_w_ && snir >= threshold_;
    }

private:
    bool is_on_;
    double threshold_;
    double minimum_power_w_;
    bool frees_channel_;
    SimTime duration_;
};

}  // namespace netsim
