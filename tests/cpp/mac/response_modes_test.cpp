#include "netsim/mac/response_modes.hpp"

#include <utility>

#include <gtest/gtest.h>

#include "netsim/error.hpp"
#include "netsim/mac/control_frames.hpp"

namespace netsim {
namespace {

MacConfig cell(const char* op_mode, Bitrates basic_bitrates_bps) {
    MacConfig config;
    config.op_mode = op_mode;
    config.basic_bitrates_bps = std::move(basic_bitrates_bps);
    return config;
}

// In Mbps, to a frame of that bitrate.
double response_mbps(const MacConfig& config, double frame_mbps) {
    const Mode& frame = mode_set(config.op_mode).mode_for_bitrate(frame_mbps * 1e6);
    return static_cast<double>(ResponseModes(config).to(frame).bitrate_bps) / 1e6;
}

TEST(ResponseModes, AreThoseOfTheMandatoryBitratesByDefault) {
    for (const char* op_mode : {"b", "g(erp)", "g(mixed)", "a"}) {
        const ModeSet& modes = mode_set(op_mode);
        const ResponseModes responses(cell(op_mode, {}));
        for (const Mode& mode : modes.modes()) {
            EXPECT_EQ(&responses.to(mode), &modes.response_mode(mode)) << mode.name;
        }
    }
}

TEST(ResponseModes, AreTheFastestBasicOneThatIsNotFasterThanTheFrame) {
    const MacConfig config = cell("b", {1e6, 2e6});
    EXPECT_EQ(response_mbps(config, 11), 2);
    EXPECT_EQ(response_mbps(config, 5.5), 2);
    EXPECT_EQ(response_mbps(config, 2), 2);
    EXPECT_EQ(response_mbps(config, 1), 1);
    EXPECT_EQ(response_mbps(cell("a", {12e6, 6e6}), 54), 12);
    EXPECT_EQ(response_mbps(cell("a", {54e6}), 54), 54);
}

TEST(ResponseModes, AreMandatoryOnesWithoutABasicOneOfThatModulation) {
    EXPECT_EQ(response_mbps(cell("g(mixed)", {1e6, 2e6}), 54), 24);
    EXPECT_EQ(response_mbps(cell("g(mixed)", {1e6, 2e6}), 11), 2);
    EXPECT_EQ(response_mbps(cell("g(mixed)", {6e6}), 11), 11);
    EXPECT_EQ(response_mbps(cell("a", {12e6}), 9), 6);
}

TEST(ResponseModes, RejectABasicBitrateOfAnotherOperationMode) {
    try {
        const ResponseModes rejected(cell("b", {6e6}));
        ADD_FAILURE();
    } catch (const ConfigError& error) {
        EXPECT_EQ(error.problem()->field, "mac.basic_bitrates_bps");
    }
}

TEST(ResponseModes, DecideDurationFields) {
    const MacConfig config = cell("b", {2e6});
    const ModeSet& modes = mode_set("b");
    const MacTiming timing(modes);
    const ResponseModes responses(config);
    const Mode& data = modes.mode_for_bitrate(11e6);
    const SimTime ack = SimTime::from_us(192 + 14 * 8 / 2);
    EXPECT_EQ(data_duration_field(timing, responses, data), timing.sifs + ack);
    Frame frame;
    frame.psdu_bytes = 1000;
    frame.duration_field = timing.sifs + ack;
    const Frame rts = make_rts(frame, timing, responses, data, data);
    EXPECT_EQ(rts.duration_field, timing.sifs * 3 + ack * 2 + data.duration(1000));  // a CTS is as long
}

}  // namespace
}  // namespace netsim
