#include "netsim/propagation/gamma_quantile.hpp"

#include <cmath>
#include <numbers>

namespace netsim {

GammaQuantile::GammaQuantile(double shape) : distribution_(shape) {
    constexpr double step = 1.0 / points_in_one;
    for (int index = -farthest * points_in_one; index <= farthest * points_in_one; ++index) {
        const double z = index * step;
        const double x = distribution_.quantile_of_normal(z);
        const double u = std::log(x);
        const double log_density = shape * u - x - std::lgamma(shape);
        const double slope =
            std::exp(-z * z / 2 - log_density) * (std::numbers::inv_sqrtpi / std::numbers::sqrt2);
        const double curvature = -slope * (z + (shape - x) * slope);
        points_.push_back({u, slope * step, curvature * step * step});
    }
}

double GammaQuantile::of_normal(double z) const {
    if (!(std::abs(z) < farthest)) {
        return distribution_.quantile_of_normal(z);
    }
    const double steps = (z + farthest) * points_in_one;
    const auto index = static_cast<std::size_t>(steps);
    const double t = steps - static_cast<double>(index);
    const Point& from = points_[index];
    const Point& to = points_[index + 1];
    // The differences of value, slope and curvature at the second point from the parabola of the
    // first point.
    const double value = to.value - (from.value + from.slope + from.curvature / 2);
    const double slope = to.slope - (from.slope + from.curvature);
    const double curvature = to.curvature - from.curvature;
    const double third = 10 * value - 4 * slope + curvature / 2;
    const double fourth = -15 * value + 7 * slope - curvature;
    const double fifth = 6 * value - 3 * slope + curvature / 2;
    return std::exp(from.value +
                    t * (from.slope + t * (from.curvature / 2 + t * (third + t * (fourth + t * fifth)))));
}

}  // namespace netsim
