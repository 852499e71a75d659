// Groups of receivers that notice about the same transmissions. One neighbor search around a sender
// serves a whole group. Used by Links.
#pragma once

#include "netsim/medium/neighbor_search.hpp"
#include "netsim/medium/receiver.hpp"
#include "netsim/propagation/ppdu_format.hpp"
#include "netsim/propagation/transmission.hpp"

namespace netsim {

// The last computed distance with its inputs, as a cache: most transmissions have equal inputs.
struct KnownReach {
    double gain = -1;
    double carrier_hz = 0;
    double reach_m = 0;
};

// Receivers with equal bands and formats, and similar thresholds. A sender that is too far away for
// the most sensitive member is too far away for all. Thresholds within a group differ by at most a
// factor of 4, so that one very sensitive receiver does not widen the search for all others.
struct ReceiverGroup {
    Band band;
    PpduFormats formats = PpduFormats::all();
    int sensitivity_class = 0;
    double min_power_w = 0;   // no member notices a single transmission below this
    double min_energy_w = 0;  // no member notices the sum of several below this
    double max_energy_w = 0;  // for every member, this power makes the channel busy
    double max_antenna_gain = 0;
    KnownReach reach{};
    KnownReach zone_reach{};
    KnownReach outer_zone_reach{};
    NeighborSearch members;

    bool can_decode(const Transmission& sent) const { return sent.can_be_decoded(band, formats); }
    // In W. No member notices a transmission below this power on its own.
    double min_noticed_w(const Transmission& sent) const {
        // A receiver that cannot decode it notices only its energy.
        return can_decode(sent) ? min_power_w : min_energy_w;
    }
    // In W. No member notices the sum of several transmissions below this.
    double min_noticed_energy_w() const { return min_energy_w * (1 - rounding_margin); }
};

}  // namespace netsim
