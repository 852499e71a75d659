// Frame capture: a radio that is locked on to a frame switches to a stronger one that begins later.
// Off by default.
//
// The new frame must begin at most `window` after the start of the locked frame, with more than
// `margin` times (a linear ratio) its power. In that time, a receiver can still train on another
// preamble.
#pragma once

#include "netsim/config/radio_config.hpp"
#include "netsim/kernel/sim_time.hpp"
#include "netsim/medium/arrival.hpp"
#include "netsim/propagation/transmission.hpp"

namespace netsim {

class FrameCapture {
public:
    explicit FrameCapture(const RadioConfig& config)
        : is_on_(!config.frame_capture.empty()),
          margin_(config.capture_margin),
          window_(SimTime::from_seconds(config.capture_window_s)) {}

    bool is_on() const { return is_on_; }
    bool captures(const Arrival& locked, const Arrival& newcomer) const {
        return is_on_ && newcomer.start - locked.start <= window_ &&
               newcomer.power_w > locked.power_w * margin_;
    }

private:
    bool is_on_;
    double margin_;
    SimTime window_;
};

}  // namespace netsim
