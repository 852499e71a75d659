// One frame on the air. It is created once, never changed, and shared by all receivers.
//
// The medium uses only the physical properties. `mode` and `frame` belong to the layers above and
// are passed through.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>

#include "netsim/geometry/position.hpp"
#include "netsim/interface_id.hpp"
#include "netsim/kernel/sim_time.hpp"
#include "netsim/propagation/ppdu_format.hpp"
#include "netsim/trace/frame_label.hpp"

namespace netsim {

struct Frame;  // mac/frame.hpp
struct Mode;   // phy/modes.hpp

// The spectrum of a transmission, or the one that a receiver listens to.
struct Band {
    double carrier_hz = 0;
    double bandwidth_hz = 0;

    bool operator==(const Band&) const = default;

    // Whether a receiver in band `listener` gets all of the signal, and can decode it: the center
    // frequencies must be equal, and the signal must fit.
    bool fits_in(const Band& listener) const {
        return carrier_hz == listener.carrier_hz && bandwidth_hz <= listener.bandwidth_hz;
    }

    // The share of the signal's power that a receiver in band `listener` gets, 0 to 1. The power is
    // spread evenly over the bandwidth, and the receiver's filter has sharp edges. Part of a signal
    // that does not fit is noise.
    double share_in(const Band& listener) const {
        if (fits_in(listener)) {
            return 1;
        }
        const double overlap_hz =
            (bandwidth_hz + listener.bandwidth_hz) / 2 - std::abs(carrier_hz - listener.carrier_hz);
        return std::clamp(overlap_hz, 0.0, std::min(bandwidth_hz, listener.bandwidth_hz)) / bandwidth_hz;
    }
};

struct Transmission {
    Position origin;  // of the sender, at the start
    SimTime start;
    SimTime duration;
    double power_w = 0;
    Band band;
    RadioId radio = 0;  // the sender's
    InterfaceId sender;
    FrameLabel label;
    PpduFormat format = PpduFormat::erp_ofdm;
    int psdu_bytes = 0;
    const Mode* mode = nullptr;
    std::shared_ptr<const Frame> frame;

    FrameNumber id() const { return label.number; }
    // Whether a receiver can decode it that listens to that band and knows those formats.
    bool can_be_decoded(const Band& listener, PpduFormats known) const {
        return known.contains(format) && band.fits_in(listener);
    }
};

}  // namespace netsim
