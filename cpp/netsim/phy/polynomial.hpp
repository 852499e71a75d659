// Polynomials with constant coefficients.
#pragma once

#include <array>
#include <cstddef>

namespace netsim {

// coefficients[0] + coefficients[1] x + …, by Horner's rule.
template <std::size_t N>
constexpr double polynomial(double x, const std::array<double, N>& coefficients) {
    double sum = 0;
    for (std::size_t i = N; i-- > 0;) {
        sum = sum * x + coefficients[i];
    }
    return sum;
}

}  // namespace netsim
