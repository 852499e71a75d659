// The gamma distribution of a given shape and scale 1. Nakagami fading draws its powers from it.
//
// below(x) and above(x) are the regularized incomplete gamma functions P(a, x) and Q(a, x), with a
// the shape. The argument of the quantile is a standard normal number z of the same probability,
// which keeps both tails accurate.
#pragma once

namespace netsim {

class GammaDistribution {
public:
    // shape > 0, up to some thousands.
    explicit GammaDistribution(double shape);

    // x ≥ 0.
    double below(double x) const;
    double above(double x) const;

    // The x that is exceeded with the same probability as `z` by a standard normal number. Rises
    // with z. Accurate to about 14 digits for |z| up to 30.
    double quantile_of_normal(double z) const;

private:
    // The logarithm of a probability and its slope over ln x.
    struct LogTail {
        double value;
        double slope;
    };

    double log_weight(double x) const;  // of x times the density
    LogTail log_below(double x) const;
    LogTail log_above(double x) const;

    double shape_;
    double log_gamma_;  // ln Γ(shape)
};

}  // namespace netsim
