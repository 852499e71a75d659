// The quantile of a gamma distribution, worked out beforehand: one is needed for each faded link and coherence time, and
// finding it takes as long as twenty of what else a link costs.
//
// Between points of z that lie 1/16 apart, ln x is the polynomial of the fifth degree that has its values, slopes and
// curvatures at both ends. Slope and curvature follow from the densities: that of ln x at u, f(u) = exp(a u − e^u) / Γ(a),
// and that of z, φ(z), belong to the same probability, so u' = φ(z) / f(u) and u'' = −u' (z + (a − e^u) u').
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
    static constexpr int farthest = 8;  // from there on it is worked out when it is asked for

    GammaDistribution distribution_;
    std::vector<Point> points_;
};

}  // namespace netsim
