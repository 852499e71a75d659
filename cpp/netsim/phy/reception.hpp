// What becomes of a frame that a radio is locked on to: the chances, without the dice. Used by the radio.
//
// In mode "min" the least SNIR of the whole frame decides about all of it, in mode "chunks" the PHY header and the data
// are decided apart, and each stretch of time between two changes of the interference counts with its own SNIR: with
// L(snir) the logarithm of the chance that a part survives if all of it has that SNIR,
//
//   success of a part = exp Σ (length of stretch / length of part) · L(SNIR of stretch).
//
// Bits fail independently, so this is the product over the stretches; for one stretch it is L, and header and data
// together have the chance of mode "min". Nothing survives where the SNIR is not above the threshold anywhere in the
// part (in mode "min": in the frame).
#pragma once

#include "netsim/medium/arrival.hpp"
#include "netsim/medium/interference.hpp"
#include "netsim/phy/error_rate.hpp"
#include "netsim/phy/modes.hpp"

namespace netsim {

enum class FramePart { header, data };

// When a part of a frame is on the air at a receiver, never beyond the frame's end.
struct Period {
    SimTime start;
    SimTime end;
};
Period period_of(FramePart part, const Arrival& arrival);

struct ReceptionModel {
    const ErrorModel* errors = nullptr;
    double snir_threshold = 0;
    double noise_w = 0;

    // Of the whole frame, in mode "min", beside interference of at most that power.
    double success(const Arrival& arrival, double interference_w) const;
    // No more than that, for all interference up to `most_interference_w`: known at once.
    double least_success(const Arrival& arrival, double most_interference_w) const {
        const double snir = arrival.power_w / (noise_w + most_interference_w);
        return snir > snir_threshold ? errors->least_success(*arrival.transmission->mode, snir,
                                                             arrival.transmission->psdu_bytes)
                                     : 0;
    }
    // Whether a number drawn from [0, 1) is below `success`, which mostly need not be worked out for that.
    bool survives(double draw, const Arrival& arrival, double interference_w) const;
    // Of one part, in mode "chunks", beside the interference of its period.
    double success(FramePart part, const Arrival& arrival, InterferenceSum& interference) const;
    double success_undisturbed(FramePart part, const Arrival& arrival) const;

private:
    double log_success(FramePart part, const Arrival& arrival, double interference_w) const;
};

}  // namespace netsim
