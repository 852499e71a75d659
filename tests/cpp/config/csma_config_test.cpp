#include "netsim/config/csma_config.hpp"

#include <gtest/gtest.h>

#include "config/error_text.hpp"

namespace netsim {
namespace {

TEST(CsmaConfig, DefaultsAreThoseOfInet) {
    const CsmaConfig config;
    EXPECT_TRUE(config.use_acks);
    EXPECT_EQ(config.max_frame_retries, 3);
    EXPECT_EQ(config.ack_wait_s, 560e-6);
    EXPECT_EQ(config.sifs_s, 192e-6);
    EXPECT_EQ(config.lifs_s, 0);
    EXPECT_EQ(config.backoff_method, "exponential");
    EXPECT_EQ(config.max_backoffs, 4);
    EXPECT_EQ(config.min_be, 3);
    EXPECT_EQ(config.max_be, 5);
    EXPECT_EQ(config.contention_window, 2);
    EXPECT_EQ(config.unit_backoff_s, 320e-6);
    EXPECT_EQ(config.cca_s, 128e-6);
    EXPECT_FALSE(config.cca_whole_window);
    EXPECT_EQ(config.turnaround_s, 192e-6);
    EXPECT_EQ(config.queue_capacity, 100);
    config.validate();
}

TEST(CsmaConfig, TheFirstExponentIsAtMostTheLast) {
    CsmaConfig config;
    config.min_be = 6;
    EXPECT_EQ(error_text([&] { config.validate(); }), "csma.min_be = 6: expected at most csma.max_be, 5");
}

}  // namespace
}  // namespace netsim
