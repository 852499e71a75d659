// A radio's receiver, as the medium sees it.
#pragma once

#include "netsim/kernel/sim_time.hpp"
#include "netsim/medium/arrival.hpp"
#include "netsim/mobility/trajectory.hpp"
#include "netsim/propagation/ppdu_format.hpp"
#include "netsim/propagation/transmission.hpp"

namespace netsim {

// The side of a radio that the medium notifies.
class MediumListener {
public:
    virtual void arrival_started(const Arrival& arrival) = 0;
    virtual void arrival_ended(const Arrival& arrival) = 0;

protected:
    ~MediumListener() = default;
};

// Relative margin for rounding: upper bounds are raised, and thresholds lowered, by this fraction.
inline constexpr double rounding_margin = 1e-9;

// What a receiver can detect. Most radios of a network have the same parameters.
struct ReceiverParameters {
    Band band;
    double sensitivity_w = 0;       // the least power that it can lock on to
    double energy_detection_w = 0;  // ED threshold: noise and signals that make the channel busy together
    double noise_w = 0;             // in its band when no radio sends
    // For this long after the start of a lockable frame, the receiver may ignore its energy.
    SimTime detection_time = SimTime::from_ps(0);
    PpduFormats formats = PpduFormats::all();

    bool operator==(const ReceiverParameters&) const = default;

    bool can_decode(const Transmission& sent) const { return sent.can_be_decoded(band, formats); }
    bool can_lock_on(const Transmission& sent, double power_w) const {
        return power_w >= sensitivity_w && can_decode(sent);
    }
    // Whether that power plus the noise makes the channel busy.
    bool exceeds_ed(double power_w) const { return noise_w + power_w >= energy_detection_w; }
    // The same with a margin for the rounding of a sum of powers.
    bool surely_exceeds_ed(double power_w) const { return exceeds_ed(power_w * (1 - rounding_margin)); }
    // By how many W that power may rise before the channel can become busy.
    double headroom_w(double power_w) const {
        return energy_detection_w * (1 - rounding_margin) - (noise_w + power_w);
    }
};

struct Receiver {
    MediumListener* listener = nullptr;
    const Trajectory* trajectory = nullptr;
    ReceiverParameters parameters;
};

}  // namespace netsim
