// The gamma distribution of a given shape and of scale 1: how Nakagami's fading gets its powers.
//
// below(x) and above(x) are the regularised incomplete gamma functions P(a, x) and Q(a, x), a the shape. The quantile
// is asked for by a standard normal number z, "as far out as z", since so both tails keep their accuracy.
#pragma once

namespace netsim {

class GammaDistribution {
public:
    // shape > 0; meant for up to some thousands.
    explicit GammaDistribution(double shape);

    // x ≥ 0.
    double below(double x) const;
    double above(double x) const;

    // The x that is exceeded with the same probability as `z` is by a standard normal number: rises with z. To about
    // 14 digits, for |z| up to 30.
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
