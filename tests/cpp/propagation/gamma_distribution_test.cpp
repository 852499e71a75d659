// Expected numbers were computed with 40 digits (mpmath), not with this code.
#include "netsim/propagation/gamma_distribution.hpp"

#include <gtest/gtest.h>

namespace netsim {
namespace {

TEST(GammaDistribution, BothTailsAreTheRegularisedIncompleteGammaFunctions) {
    struct Case {
        double shape, x, below, above;
    };
    for (const Case& expected : {
             Case{0.5, 0.25, 0.52049987781304654, 0.47950012218695346},
             Case{0.5, 1.6, 0.92636172987969735, 0.073638270120302654},
             Case{0.5, 30, 0.99999999999999051, 9.4857375710738484e-15},
             Case{2.5, 0.001, 9.5085345986079493e-9, 0.9999999904914654},
             Case{2.5, 3, 0.6937810815867216, 0.3062189184132784},
             Case{2.5, 12, 0.99978288705654728, 0.00021711294345272332},
             Case{100, 80, 0.017108313035133114, 0.98289168696486689},
             Case{100, 140, 0.99983894282528744, 0.00016105717471255586},
         }) {
        const GammaDistribution gamma(expected.shape);
        EXPECT_NEAR(gamma.below(expected.x) / expected.below, 1, 2e-13)
            << expected.shape << " " << expected.x;
        EXPECT_NEAR(gamma.above(expected.x) / expected.above, 1, 2e-13)
            << expected.shape << " " << expected.x;
    }
}

TEST(GammaDistribution, NothingIsBelowZero) {
    EXPECT_EQ(GammaDistribution(2).below(0), 0);
    EXPECT_EQ(GammaDistribution(2).above(0), 1);
}

TEST(GammaDistribution, QuantilesAreAccurateInBothTails) {
    struct Case {
        double shape, z, x;
    };
    for (const Case& expected : {
             Case{0.5, -8, 3.0395184179339721e-31}, Case{0.5, -3, 1.431173294881609e-6},
             Case{0.5, -0.1, 0.18792946938950528},  Case{0.5, 0, 0.22746821155978638},
             Case{0.5, 0.1, 0.27273793928300394},   Case{0.5, 3, 5.1365090325197768},
             Case{0.5, 8, 32.682892998720476},      Case{0.7, -6, 1.1886074679952178e-13},
             Case{0.7, 1, 1.3504978940456604},      Case{1, -1, 0.17275377902344989},
             Case{1, 3, 6.6077262215103495},        Case{2.5, -8, 1.3371299879271377e-6},
             Case{2.5, -1, 1.0279951346305934},     Case{2.5, 0, 2.1757300955477637},
             Case{2.5, 3, 9.910724094625814},       Case{2.5, 8, 40.310652909701149},
             Case{10, -6, 0.60127556987754142},     Case{10, 0.1, 9.98209214985865},
             Case{10, 8, 59.084099639904224},       Case{300, -8, 181.65034020406397},
             Case{300, 0, 299.66673259043924},      Case{300, 8, 460.24520389739417},
         }) {
        EXPECT_NEAR(GammaDistribution(expected.shape).quantile_of_normal(expected.z) / expected.x, 1, 1e-12)
            << expected.shape << " " << expected.z;
    }
}

TEST(GammaDistribution, QuantilesRise) {
    for (const double shape : {0.5, 0.51, 1.3, 4.0, 30.0, 1000.0}) {
        const GammaDistribution gamma(shape);
        double before = 0;
        for (int step = 0; step < 1700; ++step) {
            const double z = -8.5 + 0.01 * step;
            const double x = gamma.quantile_of_normal(z);
            ASSERT_GT(x, before) << shape << " " << z;
            before = x;
        }
    }
}

}  // namespace
}  // namespace netsim
