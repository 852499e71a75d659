#include "netsim/node/processing_time.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace netsim {
namespace {

ProcessingTime of(double median_s, double spread) {
    return {{.processing_time_s = median_s, .processing_time_spread = spread},
            RandomStream(1, 0, Purpose::processing)};
}

TEST(ProcessingTime, IsTheMedianWithoutASpread) {
    ProcessingTime time = of(4e-4, 0);
    EXPECT_EQ(time.draw(), SimTime::from_us(400));
    EXPECT_EQ(time.draw(), SimTime::from_us(400));
}

TEST(ProcessingTime, IsLogNormal) {
    constexpr int count = 20'000;
    ProcessingTime time = of(4e-4, 1.5);
    double sum = 0;
    double squares = 0;
    for (int number = 0; number < count; ++number) {
        const double logarithm = std::log(time.draw().seconds() / 4e-4);
        sum += logarithm;
        squares += logarithm * logarithm;
    }
    EXPECT_NEAR(sum / count, 0, 0.04);
    EXPECT_NEAR(std::sqrt(squares / count), 1.5, 0.03);
}

TEST(ProcessingTime, IsNoneByDefault) {
    EXPECT_FALSE(ProcessingTime({}, RandomStream(1, 0, Purpose::processing)).is_any());
}

}  // namespace
}  // namespace netsim
