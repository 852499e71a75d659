// The quantile of a gamma distribution from a table. Each faded link needs one per coherence time,
// and the exact computation takes twenty times as long as the rest of a link.
//
// Between points of z that are 1/16 apart, ln x is the polynomial of degree five with the exact
// values, slopes and curvatures at both ends. These follow from the densities f(u) = exp(a u − e^u)
// / Γ(a) of u = ln x, and φ(z) of z, at equal probability: u' = φ(z) / f(u) and u'' = −u' (z + (a −
// e^u) u').
#pragma once

#include <cstddef>
#include <vector>

#include "netsim/propagation/gamma_distribution.hpp"

namespace netsim {

class GammaQuantile {
public:
    explicit GammaQuantile(double shape);

    const GammaDistribution& distribution() const { return distribution_; }
    // GammaDistribution::quantile_of_normal, to about 11 digits.
    double of_normal(double z) const;

private:
    // At one of the points.
    struct Point {
        double value = 0;  // of ln x
        double slope = 0;  // over z in steps between points
        double curvature = 0;
    };
    static constexpr int points_in_one = 16;
    static constexpr int farthest = 8;  // beyond this, the quantile is computed on demand

    GammaDistribution distribution_;
    std::vector<Point> points_;
};

}  // namespace netsim
