// What the medium knows of those who hear: their radios' receivers.
#pragma once

#include "netsim/kernel/sim_time.hpp"
#include "netsim/medium/arrival.hpp"
#include "netsim/mobility/trajectory.hpp"
#include "netsim/propagation/transmission.hpp"

namespace netsim {

// The side of a radio that the medium speaks to.
class MediumListener {
public:
    virtual void arrival_started(const Arrival& arrival) = 0;
    virtual void arrival_ended(const Arrival& arrival) = 0;

protected:
    ~MediumListener() = default;
};

// Bounds are taken so much larger and levels so much lower, for rounding.
inline constexpr double rounding_margin = 1e-9;

// What a receiver can hear. Mostly all of a network have the same.
struct ReceiverKind {
    Band band;
    double sensitivity_w = 0;       // the least power it can lock on to
    double energy_detection_w = 0;  // noise and signals together that make its channel busy
    double noise_w = 0;             // in its band when nobody sends
    // So long it may leave out of the energy a frame that it can lock on to.
    SimTime detection_time = SimTime::from_ps(0);
    PpduFormats formats = PpduFormats::all();

    bool operator==(const ReceiverKind&) const = default;

    bool can_decode(const Transmission& sent) const { return sent.can_be_decoded(band, formats); }
    // If that power of it arrives.
    bool can_lock_on(const Transmission& sent, double power_w) const {
        return power_w >= sensitivity_w && can_decode(sent);
    }
    // Whether that power makes the channel busy,
    bool is_loud(double power_w) const { return noise_w + power_w >= energy_detection_w; }
    // also if it is a sum, however that was rounded.
    bool is_surely_loud(double power_w) const { return is_loud(power_w * (1 - rounding_margin)); }
    // Of what its channel needs to be busy, beside that power.
    double missing_beside_w(double power_w) const {
        return energy_detection_w * (1 - rounding_margin) - (noise_w + power_w);
    }
};

struct Receiver {
    MediumListener* listener = nullptr;
    const Trajectory* trajectory = nullptr;
    ReceiverKind kind;
};

}  // namespace netsim
