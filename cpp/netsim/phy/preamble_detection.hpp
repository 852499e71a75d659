// Preamble detection: the rule by which a radio locks on to a frame.
//
// Without it (the default), a radio locks on at once to any frame that reaches its sensitivity.
// With it, the radio first listens to a frame for `duration`. It then locks on to the frame if no
// other frame in detection is stronger, and if its power and its SNIR reach their thresholds. Sensing
// energy takes as long: a frame that has just begun does not make the channel busy yet.
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
          duration_(is_on_ ? SimTime::from_seconds(config.preamble_duration_s) : SimTime()) {}

    bool is_on() const { return is_on_; }
    SimTime duration() const { return duration_; }  // 0 if off
    // `snir` is a linear ratio.
    bool detects(double power_w, double snir) const {
        return power_w >= minimum_power_w_ && snir >= threshold_;
    }

private:
    bool is_on_;
    double threshold_;
    double minimum_power_w_;
    SimTime duration_;
};

}  // namespace netsim
