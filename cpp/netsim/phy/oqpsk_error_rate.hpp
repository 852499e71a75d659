// The probability that an 802.15.4 frame survives noise and interference.
//
//   bit error = 8/15 · 1/16 · Σ_{k=2}^{16} (−1)^k · (16 choose k) · e^(20 s (1/k − 1)),   s the linear SNIR,
//
// for 16-ary quasi-orthogonal modulation. 20 is twice the ratio of the standard's bandwidth to the
// bitrate.
// success = (1 − bit error)^(header bits + 8 · PSDU bytes); the preamble cannot fail.
//
// Source: IEEE Std 802.15.4-2006, E.4.1.8.
#pragma once

#include "netsim/phy/error_rate.hpp"

namespace netsim {

class OqpskErrorModel final : public ErrorModel {
public:
    // Only for oqpsk_250_kbps.
    double success_probability(const Mode& mode, double snir, int psdu_bytes) const override;

    // In [0, 1/2]. `snir`: a linear ratio ≥ 0, may be infinite.
    static double bit_error_rate(double snir);
};

}  // namespace netsim
