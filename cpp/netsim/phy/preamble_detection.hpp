// Whether a radio notices that a frame begins: the rule by which it locks on to one.
//
// Without it (the default), a radio locks on at once to whatever reaches its sensitivity. With it, it listens for
// `duration` first, and then locks on to the strongest of the frames that began meanwhile if that one is strong enough
// both in itself and beside all other energy in the band at the end of that time. Sensing energy takes as long: what
// has just begun does not yet make its channel busy.
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
    SimTime duration() const { return duration_; }  // none, if off
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
