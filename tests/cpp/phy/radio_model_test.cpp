#include "netsim/phy/radio_model.hpp"

#include <gtest/gtest.h>

#include "support/air.hpp"

namespace netsim {
namespace {

TEST(RadioModel, NeedsTheSnirWithWhichHalfOfTheFramesSurvive) {
    test::Air air;
    RadioConfig config;
    config.snir_threshold = 0;
    const auto model = test::model_of(config, air.medium, 1);
    const Mode& mode = mode_set("a").slowest_mandatory();
    for (const int psdu_bytes : {14, 1500}) {
        const double needed = model->needed_snir(mode, psdu_bytes);
        const auto success = [&](double snir) {
            return model->reception.errors->success_probability(mode, snir, psdu_bytes);
        };
        EXPECT_GE(success(needed), 0.5);
        EXPECT_LT(success(needed * 0.999), 0.5);
    }
    EXPECT_LT(model->needed_snir(mode, 14), model->needed_snir(mode, 1500));
}

TEST(RadioModel, NeedsAtLeastTheThresholdOfTheReceiver) {
    test::Air air;
    RadioConfig config;
    config.error_model = "";
    config.snir_threshold = 4;
    const auto model = test::model_of(config, air.medium, 1);
    EXPECT_NEAR(model->needed_snir(mode_set("a").slowest_mandatory(), 100), 4, 0.001);
}

}  // namespace
}  // namespace netsim
