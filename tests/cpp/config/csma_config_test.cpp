#include "netsim/config/csma_config.hpp"

#include <functional>
#include <string>

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

TEST(CsmaConfig, EachFieldHasARange) {
    struct Case {
        std::function<void(CsmaConfig&)> spoil;
        std::string text;
    };
    for (const Case& each : {
             Case{[](CsmaConfig& c) { c.max_frame_retries = -1; },
                  "csma.max_frame_retries = -1: expected from 0 to 255"},
             Case{[](CsmaConfig& c) { c.ack_wait_s = 0; },
                  "csma.ack_wait_s = 0 s: expected from 1e-06 s to 1 s"},
             Case{[](CsmaConfig& c) { c.sifs_s = -1; }, "csma.sifs_s = -1 s: expected from 0 s to 1 s"},
             Case{[](CsmaConfig& c) { c.lifs_s = 2; }, "csma.lifs_s = 2 s: expected from 0 s to 1 s"},
             Case{[](CsmaConfig& c) { c.max_backoffs = 256; },
                  "csma.max_backoffs = 256: expected from 0 to 255"},
             Case{[](CsmaConfig& c) { c.min_be = 6; }, "csma.min_be = 6: expected from 0 to 5"},
             Case{[](CsmaConfig& c) { c.max_be = 21; }, "csma.max_be = 21: expected from 0 to 20"},
             Case{[](CsmaConfig& c) { c.contention_window = 0; },
                  "csma.contention_window = 0: expected from 1 to 32767"},
             Case{[](CsmaConfig& c) { c.unit_backoff_s = 2; },
                  "csma.unit_backoff_s = 2 s: expected from 1e-06 s to 1 s"},
             Case{[](CsmaConfig& c) { c.cca_s = 2; }, "csma.cca_s = 2 s: expected from 0 s to 1 s"},
             Case{[](CsmaConfig& c) { c.turnaround_s = 2; },
                  "csma.turnaround_s = 2 s: expected from 0 s to 1 s"},
             Case{[](CsmaConfig& c) { c.queue_capacity = 0; },
                  "csma.queue_capacity = 0 frames: expected from 1 frames to 1000000 frames"},
             Case{[](CsmaConfig& c) { c.backoff_method = "exponentiel"; },
                  "csma.backoff_method = \"exponentiel\": expected one of exponential, linear, constant; did "
                  "you "
                  "mean exponential?"},
         }) {
        CsmaConfig config;
        each.spoil(config);
        EXPECT_EQ(error_text([&] { config.validate(); }), each.text);
    }
}

}  // namespace
}  // namespace netsim
