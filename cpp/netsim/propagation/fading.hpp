// Fading and shadowing: the random factor of a link's gain, a ratio of powers.
//
// A deterministic function of the run's seed, the pair of radios and the time (link_gaussians.hpp).
// So the channel is the same in both directions, and equal calls give equal results. With x, y, z
// standard normal, and a mean of 1 except for shadowing:
//   LogNormalShadowing, and shadowing beside a path loss: 10^(σ z / 10), σ in dB: 1 in the median. Source:
//     T. S. Rappaport, "Wireless Communications: Principles and Practice", 2nd ed. 2002, 4.9.2.
//   RayleighFading: (x² + y²) / 2, no line of sight. Source: Rappaport, 5.6.1.
//   RicianFading: ((x + √(2K))² + y²) / (2 (K + 1)), K the power of the line of sight over that of all scattered waves.
//     Source: S. O. Rice, "Mathematical analysis of random noise", Bell System Technical Journal 24, 1945, 3.10.
//   NakagamiFading: gamma distributed of shape m and mean 1, at the quantile of z. m = 1 is Rayleigh's distribution.
//     Source: M. Nakagami, "The m-distribution, a general formula of intensity distribution of rapid fading", 1960.
// Each is cut off at max(), so that the search for receivers has a radius. Larger values occur once
// in 10⁹ draws. (With a line of sight, that is the probability for the scattered part alone.)
//
// For Rayleigh, INET multiplies the power by the root of x² + y², an amplitude. Here it is the
// power, with a mean of 1.
#pragma once

#include <cstdint>
#include <optional>

#include "netsim/config/medium_config.hpp"
#include "netsim/propagation/gain_tail_bound.hpp"
#include "netsim/propagation/gamma_quantile.hpp"
#include "netsim/propagation/link_gaussians.hpp"

namespace netsim {

class Fading {
public:
    // Of config.path_loss. is_none() if that is a model without fading, or shadowing of 0 dB.
    Fading(const MediumConfig& config, std::uint64_t seed);
    // The shadowing beside any path loss, with random numbers of its own. is_none() for 0 dB. Times
    // Rayleigh fading, it is the channel of H. Suzuki, "A statistical model for urban radio
    // propagation", IEEE Transactions on Communications 25, 1977.
    static Fading shadowing(const MediumConfig& config, std::uint64_t seed);

    // The factor, from 0 to max(), between the interfaces of streams `a` and `b` (interface_id.hpp)
    // for a transmission that starts at `time`. May return 0 for a factor below `least`, which is
    // cheaper.
    double gain(std::uint32_t a, std::uint32_t b, SimTime time, std::uint64_t transmission,
                double least = 0) const;

    // An upper bound for the factor.
    double max() const { return max_; }
    // Over all states of a link: the probability of at least `gain` ≥ 0, and the mean.
    double chance_of(double gain) const;
    double mean() const;
    bool is_none() const { return kind_ == Kind::none; }

private:
    enum class Kind { none, log_normal, rician, nakagami };

    explicit Fading(const LinkGaussians& gaussians) : gaussians_(gaussians) {}

    void set_log_normal(double sigma_db);
    void set_rician(double k);
    void set_nakagami(double shape);
    // Cuts the model off at the gain of a pair that is `farthest` from 0.
    void cut_off(double farthest);
    double untruncated(const GaussianPair& normal) const;

    Kind kind_ = Kind::none;
    LinkGaussians gaussians_;
    double sigma_ = 0;                    // log-normal: of the natural logarithm
    double k_ = 0;                        // Rician: a ratio; 0 is Rayleigh
    std::optional<GammaQuantile> gamma_;  // Nakagami, unless it is Rayleigh's distribution
    double shape_ = 1;                    // Nakagami
    double max_ = 1;
    GainTailBound tail_bound_;
};

}  // namespace netsim
