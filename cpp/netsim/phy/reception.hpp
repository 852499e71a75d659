// The success probability of a frame that a radio is locked on to. The radio draws the outcome.
//
// In mode "min", the minimum SNIR of the frame decides. In mode "chunks", the PHY header and the
// data are decided separately, and each interval between two changes of the interference counts
// with its own SNIR. If L(snir) is the logarithm of the probability that a part survives with that
// SNIR throughout,
//
//   success of a part = exp Σ (length of interval / length of part) · L(SNIR of interval).
//
// Bits fail independently, so this is the product over the intervals. With one interval, it is e^L,
// and header and data together have the probability of mode "min". A part (in mode "min": a frame)
// is lost if its SNIR is at or below the threshold at any time.
#pragma once

#include <limits>

#include "netsim/medium/arrival.hpp"
#include "netsim/medium/interference.hpp"
#include "netsim/phy/error_rate.hpp"
#include "netsim/phy/modes.hpp"

namespace netsim {

enum class FramePart { header, data };

// When a part of a frame arrives at a receiver; limited to the frame's end.
struct Period {
    SimTime start;
    SimTime end;
};
Period period_of(FramePart part, const Arrival& arrival);

struct ReceptionModel {
    const ErrorModel* errors = nullptr;
    double snir_threshold = 0;
    double noise_w = 0;
    // From this interference on, every frame is lost, regardless of its power.
    double collision_w = std::numeric_limits<double>::infinity();

    // A linear ratio; 0 if the interference reaches collision_w. Interference is that of other frames and other
    // systems (medium/other_systems.hpp) here and below.
    double snir(const Arrival& arrival, double interference_w) const {
        return interference_w < collision_w ? arrival.power_w / (noise_w + interference_w) : 0;
    }

    // Success probability of the whole frame, in mode "min", with that maximum interference.
    double success(const Arrival& arrival, double interference_w) const;
    // A cheap lower bound for the same with any interference up to `max_interference_w`.
    double min_success(const Arrival& arrival, double max_interference_w) const {
        const double snir = this->snir(arrival, max_interference_w);
        return snir > snir_threshold
                   ? errors->min_success(*arrival.transmission->mode, snir, arrival.transmission->psdu_bytes)
                   : 0;
    }
    // Whether a number drawn from [0, 1) is below `success`. Usually bounds decide that.
    bool survives(double draw, const Arrival& arrival, double interference_w) const;
    // Success probability of one part, in mode "chunks", with the interference during its period.
    double success(FramePart part, const Arrival& arrival, InterferenceSum& interference) const;

private:
    double log_success(FramePart part, const Arrival& arrival, double interference_w) const;
};

}  // namespace netsim
