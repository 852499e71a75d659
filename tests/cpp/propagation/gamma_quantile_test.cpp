#include "netsim/propagation/gamma_quantile.hpp"

#include <gtest/gtest.h>

namespace netsim {
namespace {

class GammaQuantiles : public testing::TestWithParam<double> {
protected:
    GammaQuantile quantile{GetParam()};
};

TEST_P(GammaQuantiles, AreThoseOfTheDistribution) {
    constexpr int count = 20'011;  // odd, so that they lie between the points in many ways
    for (int i = 0; i <= count; ++i) {
        const double z = -9 + 18.0 * i / count;
        ASSERT_NEAR(quantile.of_normal(z) / quantile.distribution().quantile_of_normal(z), 1, 1e-11) << z;
    }
}

TEST_P(GammaQuantiles, Rise) {
    double before = 0;
    for (int i = -90'000; i <= 90'000; ++i) {
        const double x = quantile.of_normal(1e-4 * i);
        ASSERT_GT(x, before) << 1e-4 * i;
        before = x;
    }
}

INSTANTIATE_TEST_SUITE_P(Shapes, GammaQuantiles, testing::Values(0.5, 0.51, 0.7, 1.3, 3, 10, 300, 5000));

}  // namespace
}  // namespace netsim
