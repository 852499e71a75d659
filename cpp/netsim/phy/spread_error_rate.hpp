// Bit error rates of 802.11b, in [0, 1]. s is the linear SNIR in a channel of 22 MHz, twice the chip rate.
//
// despreading_rates: a receiver that correlates with the chips that were sent. Ideal, with coherent detection of CCK.
//   DSSS: bit error ½e^(-22 s) at 1 Mbps and f(11 s) at 2 Mbps, with f(x) = (√2+1)/√(8π√2) · x^-½ · e^(-(2-√2)x), an
//     approximation for DQPSK with Gray code, at most 1. 22 and 11 are the ratios of bandwidth to bitrate.
//   CCK: codeword error p = Σ n · Q(√(d² s)), the union bound over the other codewords, n of them at the squared
//     distance d² for chips of amplitude 1; at most 1. Bit error 1 - (1-p)^(1/bits of a codeword).
//     Codewords: IEEE Std 802.11-2020, 16.4.6.6. Bounds and DQPSK: J. G. Proakis, Digital Communications.
// inet_rates: INET's, without the gain of despreading. DSSS ½e^(-2s) and f(s); CCK fitted curves, 0 above s = 10,
//   ½ below s = 0.1.
//
// Comparison with receivers: docs/verification/field.md.
#pragma once

#include <cstdint>

#include "netsim/phy/bit_error_bounds.hpp"

namespace netsim {

struct SpreadRate {
    double (*bit_error)(double snir) = nullptr;
    const BitErrorBounds* bounds = nullptr;  // nullptr: the rate may rise with the SNIR
};

// The rate of 1, 2, 5.5 or 11 Mbps.
using SpreadRates = const SpreadRate& (*)(std::int64_t bitrate_bps);

const SpreadRate& despreading_rates(std::int64_t bitrate_bps);
const SpreadRate& inet_rates(std::int64_t bitrate_bps);

}  // namespace netsim
