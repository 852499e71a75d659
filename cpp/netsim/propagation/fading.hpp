// Fading and shadowing: the random factor of a link's gain, a ratio of powers.
//
// A deterministic function of the run's seed, the pair of radios and the time (link_gaussians.hpp), so the channel is
// the same in both directions, and who asks twice gets the same answer. With x, y, z standard normal,
// and a mean of 1 but for shadowing:
//   LogNormalShadowing: 10^(σ z / 10), σ in dB: 1 in the median. Source: T. S. Rappaport, "Wireless
//     Communications: Principles and Practice", 2nd ed. 2002, 4.9.2.
//   RayleighFading: (x² + y²) / 2, no line of sight. Source: Rappaport, 5.6.1.
//   RicianFading: ((x + √(2K))² + y²) / (2 (K + 1)), K the power of the line of sight over that of all scattered waves.
//     Source: S. O. Rice, "Mathematical analysis of random noise", Bell System Technical Journal 24, 1945, 3.10.
//   NakagamiFading: gamma distributed of shape m and mean 1, at the quantile of z. m = 1 is Rayleigh's distribution.
//     Source: M. Nakagami, "The m-distribution, a general formula of intensity distribution of rapid fading", 1960.
// Each is cut off at most(), so that a search for receivers can end somewhere. What is above that comes once in 10⁹
// draws (with a line of sight, the scattered part alone has that chance to reach it).
//
// INET multiplies with the root of x² + y² for Rayleigh, an amplitude; here it is the power, whose mean is 1.
#pragma once

#include <cstdint>
#include <optional>

#include "netsim/config/medium_config.hpp"
#include "netsim/propagation/gamma_quantile.hpp"
#include "netsim/propagation/link_gaussians.hpp"
#include "netsim/propagation/rare_gains.hpp"

namespace netsim {

class Fading {
public:
    // None, if config.path_loss names a model without.
    Fading(const MediumConfig& config, std::uint64_t seed);

    // The factor between the interfaces of streams `a` and `b` (interface_id.hpp) for a transmission that starts at `time`: from 0 to most().
    // Where it is less than `least`, perhaps 0 instead: that costs a fraction.
    double gain(std::uint32_t a, std::uint32_t b, SimTime time, std::uint64_t transmission,
                double least = 0) const;

    // Never more than that.
    double most() const { return most_; }
    // Over all states of a link: the chance of at least `gain` ≥ 0, and the mean.
    double chance_of(double gain) const;
    double mean() const;
    bool is_none() const { return kind_ == Kind::none; }

private:
    enum class Kind { none, log_normal, rician, nakagami };

    double untruncated(const GaussianPair& normal) const;

    Kind kind_ = Kind::none;
    LinkGaussians gaussians_;
    double sigma_ = 0;                    // log-normal: of the natural logarithm
    double k_ = 0;                        // Rician: a ratio; 0 is Rayleigh
    std::optional<GammaQuantile> gamma_;  // Nakagami, unless it is Rayleigh's distribution
    double shape_ = 1;                    // Nakagami
    double most_ = 1;
    RareGains rare_;
};

}  // namespace netsim
