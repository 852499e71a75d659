#include "netsim/propagation/gamma_distribution.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace netsim {

namespace {

constexpr double precision = std::numeric_limits<double>::epsilon();

// Σ x^n / ((a + 1) … (a + n)) from n = 0, so that P(a, x) is e^−x x^a / Γ(a + 1) times that.
// Source: M. Abramowitz, I. A. Stegun, "Handbook of Mathematical Functions", 1964, 6.5.29.
double series(double shape, double x) {
    double term = 1;
    double sum = 1;
    for (double n = shape + 1; term > precision * sum; ++n) {
        term *= x / n;
        sum += term;
    }
    return sum;
}

// The f of Q(a, x) = e^−x x^a / Γ(a) · f, for x > a + 1. Source: Abramowitz and Stegun 6.5.31, in
// its even part, 1/(x+1−a − 1(1−a)/(x+3−a − 2(2−a)/(x+5−a − …))); evaluated as in W. J. Lentz,
// "Generating Bessel functions in Mie scattering calculations", Applied Optics 15, 1976.
double continued_fraction(double shape, double x) {
    constexpr int max_terms = 100'000;
    double denominator = x + 1 - shape;
    double upper = std::numeric_limits<double>::max();  // ratio of successive numerators
    double lower = 1 / denominator;                     // and of successive denominators
    double value = lower;
    double factor = 0;
    for (int n = 1; std::abs(factor - 1) > precision && n < max_terms; ++n) {
        const double numerator = n * (shape - n);
        denominator += 2;
        lower = 1 / (numerator * lower + denominator);
        upper = denominator + numerator / upper;
        factor = upper * lower;
        value *= factor;
    }
    return value;
}

// ln of the probability that a standard normal number is below `z` ≤ 0.
double log_normal_tail(double z) {
    return std::log(std::erfc(-z / std::numbers::sqrt2) / 2);
}

}  // namespace

GammaDistribution::GammaDistribution(double shape) : shape_(shape), log_gamma_(std::lgamma(shape)) {}

double GammaDistribution::log_weight(double x) const {
    return shape_ * std::log(x) - x - log_gamma_;
}

GammaDistribution::LogTail GammaDistribution::log_below(double x) const {
    if (x < shape_ + 1) {
        const double factor = series(shape_, x) / shape_;
        return {log_weight(x) + std::log(factor), 1 / factor};
    }
    const double weight = std::exp(log_weight(x));
    const double probability = 1 - weight * continued_fraction(shape_, x);
    return {std::log(probability), weight / probability};
}

GammaDistribution::LogTail GammaDistribution::log_above(double x) const {
    if (x < shape_ + 1) {
        const double weight = std::exp(log_weight(x));
        const double probability = 1 - weight * series(shape_, x) / shape_;
        return {std::log(probability), -weight / probability};
    }
    const double factor = continued_fraction(shape_, x);
    return {log_weight(x) + std::log(factor), -1 / factor};
}

double GammaDistribution::below(double x) const {
    return x > 0 ? std::exp(log_below(x).value) : 0;
}

double GammaDistribution::above(double x) const {
    return x > 0 ? std::exp(log_above(x).value) : 1;
}

// Newton's method on the logarithm of the smaller tail as a function of u = ln x. The density of u,
// proportional to exp(a u − e^u), is log-concave, so both tails are, too (M. Bagnoli, T. Bergstrom,
// "Log-concave probability and its applications", Economic Theory 26, 2005). Each tangent is above
// the curve, so from its second step on, the search approaches from one side, wherever it begins.
double GammaDistribution::quantile_of_normal(double z) const {
    const double target = log_normal_tail(-std::abs(z));
    // E. B. Wilson, M. M. Hilferty, "The distribution of chi-square", PNAS 17, 1931: close for
    // large shapes. Where it fails, x is so small that P(a, x) is about x^a / Γ(a + 1).
    const double root = 1 - 1 / (9 * shape_) + z / (3 * std::sqrt(shape_));
    double u = root > 0.2 ? std::log(shape_) + 3 * std::log(root)
                          : (target + log_gamma_ + std::log(shape_)) / shape_;
    constexpr int max_steps = 50;
    for (int step = 0; step < max_steps; ++step) {
        const double x = std::exp(u);
        const LogTail tail = z > 0 ? log_above(x) : log_below(x);
        // The first step may overflow.
        const double change = std::clamp((target - tail.value) / tail.slope, -2.0, 2.0);
        u += change;
        if (std::abs(change) < 1e-9) {  // the error left is about its square
            break;
        }
    }
    return std::exp(u);
}

}  // namespace netsim
