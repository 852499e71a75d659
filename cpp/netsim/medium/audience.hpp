// The receivers of one network that notice about the same: one search around a sender serves all of an audience. Used by Links.
#pragma once

#include "netsim/medium/neighbours.hpp"
#include "netsim/medium/receiver.hpp"
#include "netsim/propagation/ppdu_format.hpp"
#include "netsim/propagation/transmission.hpp"

namespace netsim {

// The last one that was worked out: mostly all transmissions have the same.
struct KnownReach {
    double gain = -1;
    double carrier_hz = 0;
    double reach_m = 0;
};

// Receivers of one band and the same formats that notice about the same powers: what is too far away for the keenest of them is too
// far away for all. Within a factor of 4, so that one of very keen ears does not make all others listen.
struct Audience {
    Band band;
    PpduFormats formats = PpduFormats::all();
    int keenness = 0;
    double least_w = 0;         // below that, none of them notices a transmission that is alone
    double least_energy_w = 0;  // below that, the sum of several is not noticed either
    double most_energy_w = 0;   // from that on, the noise or one transmission is enough for all of them
    double most_antenna_gain = 0;
    KnownReach reach{};
    KnownReach ring_reach{};
    KnownReach outer_reach{};
    Neighbours members;

    bool can_decode(const Transmission& sent) const { return sent.can_be_decoded(band, formats); }
    // Below that, none of them notices the transmission without others beside it.
    double noticed_w(const Transmission& sent) const {
        // Who cannot decode it notices only its energy.
        return can_decode(sent) ? least_w : least_energy_w;
    }
    // The sum of several is not noticed below that.
    double noticed_energy_w() const { return least_energy_w * (1 - rounding_margin); }
};

}  // namespace netsim
