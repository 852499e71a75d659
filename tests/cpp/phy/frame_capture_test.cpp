#include "netsim/phy/frame_capture.hpp"

#include <gtest/gtest.h>

namespace netsim {
namespace {

constexpr double locked_w = 1e-10;

bool captures(double newcomer_w, std::int64_t after_us, const char* model = "SimpleFrameCapture") {
    RadioConfig config;
    config.frame_capture = model;
    config.capture_margin = 4;
    config.capture_window_s = 16e-6;
    const SimTime start = SimTime::from_us(100);
    return FrameCapture(config).captures({nullptr, start, start, locked_w},
                                         {nullptr, start + SimTime::from_us(after_us), start, newcomer_w});
}

TEST(FrameCapture, TakesMoreThanTheMargin) {
    EXPECT_FALSE(captures(4 * locked_w, 10));
    EXPECT_TRUE(captures(4.001 * locked_w, 10));
}

TEST(FrameCapture, EndsWithTheWindow) {
    EXPECT_TRUE(captures(5 * locked_w, 16));
    EXPECT_FALSE(captures(5 * locked_w, 17));
}

TEST(FrameCapture, IsOffByDefault) {
    EXPECT_EQ(RadioConfig().frame_capture, "");
    EXPECT_FALSE(captures(1000 * locked_w, 0, ""));
}

}  // namespace
}  // namespace netsim
