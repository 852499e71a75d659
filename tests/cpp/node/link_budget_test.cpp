#include "netsim/node/link_budget.hpp"

#include <cmath>
#include <functional>
#include <numbers>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "config/error_text.hpp"
#include "netsim/error.hpp"
#include "netsim/units.hpp"
#include "support/recorder.hpp"

namespace netsim {
namespace {

constexpr int payload_bytes = 90;  // as many as fit into a frame of 802.15.4

NodeConfig node(std::string_view interface_type = ieee80211_interface) {
    NodeConfig config("node", {std::string(interface_type)});
    config.mobility.telemetry_interval_s = 0;
    return config;
}

// `parameter`: m, K in dB or σ in dB, depending on the model.
MediumConfig medium_of(const std::string& path_loss, double parameter = 0) {
    MediumConfig medium;
    medium.path_loss = path_loss;
    (path_loss == "NakagamiFading" ? medium.shape_factor
     : path_loss == "RicianFading" ? medium.k_db
                                   : medium.sigma_db) = parameter;
    return medium;
}

LinkBudget budget_of(const NodeConfig& config, const MediumConfig& medium = MediumConfig()) {
    return {medium, config, config, payload_bytes};
}

// Out of `count` broadcasts over `range_m` in a run of the engine.
double ratio_in_a_run(const MediumConfig& medium, NodeConfig config, double range_m, int count) {
    Network network(medium, 1);
    test::Recorder& sender = test::add_recorder(network, config);
    config.initial_position.x = range_m;
    const test::Recorder& receiver = test::add_recorder(network, config);
    constexpr double interval_s = 0.1;
    sender.on_initialize = [count](test::Recorder& self) {
        for (int i = 0; i < count; ++i) {
            self.node.schedule_timer("send", SimTime::from_seconds(interval_s * i));
        }
    };
    sender.on_timer = [](test::Recorder& self, const std::string&) {
        self.broadcast(std::string(payload_bytes, '.'));
    };
    network.initialize();
    network.run_until(SimTime::from_seconds(interval_s * count + 1));
    return static_cast<double>(receiver.packets.size()) / count;
}

TEST(LinkBudget, OfDefaultsEndsAtTheSensitivity) {
    // Free space: 20 mW and -85 dBm.
    const double wavelength_m = speed_of_light_mps / 2.412e9;
    const double reach_m = wavelength_m / (4 * 3.14159265358979) * std::sqrt(0.02 / w_from_dbm(-85));
    const LinkBudget budget = budget_of(node());
    EXPECT_GT(budget.reception_ratio(reach_m * 0.9999, 0.02), 0.999);
    EXPECT_EQ(budget.reception_ratio(reach_m * 1.0001, 0.02), 0);
    EXPECT_NEAR(budget.tx_power_w_for(reach_m, 0.5), 0.02, 0.02 * 1e-6);
}

TEST(LinkBudget, ThePowerForARangeIsTheLeastThatDoes) {
    NodeConfig config = node();
    config.wlan[0].radio.sensitivity_w = 1e-20;  // noise decides
    config.wlan[0].radio.snir_threshold = 0;
    const LinkBudget budget = budget_of(config);
    for (const double range_m : {0.5, 50.0, 5000.0}) {
        for (const double ratio : {0.01, 0.5, 0.99}) {
            const double power_w = budget.tx_power_w_for(range_m, ratio);
            EXPECT_NEAR(budget.reception_ratio(range_m, power_w), ratio, 1e-6);
            EXPECT_LT(budget.reception_ratio(range_m, power_w * 0.9999), ratio);
        }
    }
}

TEST(LinkBudget, WhereALimitDecidesThePowerForARangeIsEnoughInARun) {
    NodeConfig config = node();
    for (int step = 0; step < 40; ++step) {
        const double range_m = 0.7 * std::pow(1.37, step);
        config.wlan[0].radio.tx_power_w = budget_of(config).tx_power_w_for(range_m, 0.5);
        EXPECT_EQ(ratio_in_a_run(MediumConfig(), config, range_m, 1), 1) << range_m;
    }
}

TEST(LinkBudget, WhereALimitDecidesTheShareIsTheChanceOfTheFading) {
    const double limit_w = w_from_dbm(-85);
    struct Model {
        std::string path_loss;
        double parameter;
        std::function<double(double)> chance_of;
    };
    const std::vector<Model> models{
        {"RayleighFading", 0, [](double gain) { return std::exp(-gain); }},
        {"NakagamiFading", 1, [](double gain) { return std::exp(-gain); }},
        {"NakagamiFading", 0.5, [](double gain) { return std::erfc(std::sqrt(gain / 2)); }},
        {"NakagamiFading", 3,
         [](double gain) { return std::exp(-3 * gain) * (1 + 3 * gain + 9 * gain * gain / 2); }},
        {"LogNormalShadowing", 6,
         [](double gain) { return std::erfc(db_from_ratio(gain) / 6 / std::numbers::sqrt2) / 2; }},
    };
    constexpr double range_m = 100;
    const double path_gain = budget_of(node()).mean_gain(range_m);
    for (const Model& model : models) {
        const LinkBudget budget = budget_of(node(), medium_of(model.path_loss, model.parameter));
        for (const double ratio : {0.01, 0.1, 0.5, 0.9, 0.99}) {
            const double power_w = budget.tx_power_w_for(range_m, ratio);
            EXPECT_NEAR(model.chance_of(limit_w / (power_w * path_gain)), ratio, 1e-8)
                << model.path_loss << " " << model.parameter;
        }
    }
}

// Over the amplitude of a link, whose square is the gain, from its density and the probabilities
// without fading.
double plain_mean(const LinkBudget& without_fading, const std::function<double(double)>& density,
                  double range_m, double power_w) {
    constexpr double step = 0.002;  // of the natural logarithm
    double sum = 0;
    for (int i = 0; i < 9000; ++i) {
        const double log = step * (i - 4500);
        const double amplitude = std::exp(log);
        const double density_of_log = density(amplitude) * amplitude;
        if (density_of_log > 1e-12) {
            sum += density_of_log * step *
                   without_fading.reception_ratio(range_m, power_w * amplitude * amplitude);
        }
    }
    return sum;
}

// Sources: as in fading.hpp.
std::function<double(double)> nakagami_density(double shape) {
    return [shape](double amplitude) {
        return 2 * std::exp(shape * std::log(shape) - std::lgamma(shape) +
                            (2 * shape - 1) * std::log(amplitude) - shape * amplitude * amplitude);
    };
}

std::function<double(double)> rice_density(double k) {
    return [k](double amplitude) {
        return amplitude > 3 ? 0
                             : 2 * (k + 1) * amplitude * std::exp(-k - (k + 1) * amplitude * amplitude) *
                                   std::cyl_bessel_i(0, 2 * std::sqrt(k * (k + 1)) * amplitude);
    };
}

std::function<double(double)> log_normal_density(double sigma_db) {
    const double sigma = sigma_db * std::numbers::ln10 / 20;  // of the logarithm of the amplitude
    return [sigma](double amplitude) {
        const double z = std::log(amplitude) / sigma;
        return std::exp(-z * z / 2) / (sigma * amplitude * std::sqrt(2 * std::numbers::pi));
    };
}

TEST(LinkBudget, WhereTheNoiseDecidesThePowerIsRightToTwoHundredthsOfADecibel) {
    struct Model {
        std::string path_loss;
        double parameter;
        std::function<double(double)> density;
    };
    NodeConfig config = node();
    config.wlan[0].radio.sensitivity_w = 1e-20;
    config.wlan[0].radio.snir_threshold = 0;
    const LinkBudget without_fading = budget_of(config);
    for (const Model& model :
         {Model{"RayleighFading", 0, nakagami_density(1)},
          Model{"NakagamiFading", 0.5, nakagami_density(0.5)},
          Model{"NakagamiFading", 1, nakagami_density(1)},
          Model{"NakagamiFading", 2.3, nakagami_density(2.3)},
          Model{"NakagamiFading", 200, nakagami_density(200)}, Model{"RicianFading", 0, rice_density(1)},
          Model{"RicianFading", 8, rice_density(ratio_from_db(8))},
          Model{"RicianFading", 16, rice_density(ratio_from_db(16))},
          Model{"LogNormalShadowing", 0.1, log_normal_density(0.1)},
          Model{"LogNormalShadowing", 6, log_normal_density(6)}}) {
        const LinkBudget budget = budget_of(config, medium_of(model.path_loss, model.parameter));
        constexpr double range_m = 100;
        for (const double ratio : {0.01, 0.5, 0.99}) {
            const double power_w = budget.tx_power_w_for(range_m, ratio);
            const double little = ratio_from_db(0.02);
            EXPECT_GT(plain_mean(without_fading, model.density, range_m, power_w * little), ratio)
                << model.path_loss << " " << model.parameter;
            EXPECT_LT(plain_mean(without_fading, model.density, range_m, power_w / little), ratio)
                << model.path_loss << " " << model.parameter;
        }
    }
}

TEST(LinkBudget, FadingThatIsNoneChangesNothing) {
    const MediumConfig medium = medium_of("LogNormalShadowing", 0);
    for (const double sensitivity_w : {w_from_dbm(-85), 1e-20}) {
        NodeConfig config = node();
        config.wlan[0].radio.sensitivity_w = sensitivity_w;
        EXPECT_NEAR(
            budget_of(config, medium).tx_power_w_for(100, 0.5) / budget_of(config).tx_power_w_for(100, 0.5),
            1, 0.01 * std::numbers::ln10 / 10);
        EXPECT_DOUBLE_EQ(budget_of(config, medium).mean_gain(100), budget_of(config).mean_gain(100));
    }
}

TEST(LinkBudget, ShadowingBesideAPathLossIsAMeanOverItsGains) {
    constexpr double range_m = 100;
    for (const double sensitivity_w : {w_from_dbm(-85), 1e-20}) {
        NodeConfig config = node();
        config.wlan[0].radio.sensitivity_w = sensitivity_w;
        config.wlan[0].radio.snir_threshold = 0;
        for (const std::string path_loss : {"FreeSpacePathLoss", "RayleighFading", "LogNormalShadowing"}) {
            for (const double sigma_db : {0.1, 6.0}) {
                MediumConfig medium = medium_of(path_loss, 3);
                const LinkBudget alone = budget_of(config, medium);
                medium.shadowing_standard_deviation_db = sigma_db;
                const LinkBudget shadowed = budget_of(config, medium);
                for (const double ratio : {0.01, 0.5, 0.99}) {
                    const double power_w = shadowed.tx_power_w_for(range_m, ratio);
                    const double little = ratio_from_db(0.03);
                    const auto density = log_normal_density(sigma_db);
                    EXPECT_GT(plain_mean(alone, density, range_m, power_w * little), ratio) << path_loss;
                    EXPECT_LT(plain_mean(alone, density, range_m, power_w / little), ratio) << path_loss;
                }
                const double sigma = sigma_db * std::numbers::ln10 / 10;
                EXPECT_NEAR(shadowed.mean_gain(range_m) / alone.mean_gain(range_m),
                            std::exp(sigma * sigma / 2), 1e-4);
            }
        }
    }
}

TEST(LinkBudget, WithoutNoiseTheSensitivityDecides) {
    for (const char* path_loss : {"FreeSpacePathLoss", "RayleighFading"}) {
        const MediumConfig noisy = medium_of(path_loss);
        MediumConfig silent = noisy;
        silent.background_noise_w = 0;
        EXPECT_NEAR(budget_of(node(), silent).tx_power_w_for(100, 0.9) /
                        budget_of(node(), noisy).tx_power_w_for(100, 0.9),
                    1, 1e-8);
    }
}

TEST(LinkBudget, ThePowerThatAPreambleNeedsIsALimitToo) {
    for (const char* path_loss : {"FreeSpacePathLoss", "RayleighFading"}) {
        const MediumConfig medium = medium_of(path_loss);
        NodeConfig config = node();
        const double at_85_dbm = budget_of(config, medium).tx_power_w_for(100, 0.9);
        config.wlan[0].radio.preamble_detection = "ThresholdPreambleDetection";  // -82 dBm
        EXPECT_NEAR(db_from_ratio(budget_of(config, medium).tx_power_w_for(100, 0.9) / at_85_dbm), 3, 1e-7);
        config.wlan[0].radio.preamble_threshold = ratio_from_db(30);  // of a noise of -110 dBm
        EXPECT_NEAR(db_from_ratio(budget_of(config, medium).tx_power_w_for(100, 0.9) / at_85_dbm), 5, 1e-7);
    }
}

struct Case {
    std::string path_loss;
    std::string_view interface_type;
    double shadowing_standard_deviation_db = 0;
};

class LinkBudgets : public testing::TestWithParam<Case> {};

TEST_P(LinkBudgets, ForetellWhatARunShows) {
    const bool narrowband = GetParam().interface_type == ieee802154_interface;
    MediumConfig medium{std::string(narrowband ? ieee802154_scalar_medium : ieee80211_scalar_medium)};
    medium.path_loss = GetParam().path_loss;
    medium.coherence_time_s = 0;  // each frame sees another state of the link
    medium.shadowing_decorrelation_time_s = 0;
    medium.shadowing_standard_deviation_db = GetParam().shadowing_standard_deviation_db;
    NodeConfig config = node(GetParam().interface_type);
    config.initial_position.z = 10;
    config.wlan[0].radio.sensitivity_w = 1e-20;  // noise decides
    config.wlan[0].radio.snir_threshold = 0;
    const LinkBudget budget = budget_of(config, medium);
    constexpr double range_m = 60;
    constexpr int frames = 2000;
    for (const double ratio : {0.1, 0.5, 0.9}) {
        config.wlan[0].radio.tx_power_w = budget.tx_power_w_for(range_m, ratio);
        const double standard_error = std::sqrt(ratio * (1 - ratio) / frames);
        EXPECT_NEAR(ratio_in_a_run(medium, config, range_m, frames), ratio, 4.5 * standard_error);
    }
}

INSTANTIATE_TEST_SUITE_P(Models, LinkBudgets,
                         testing::Values(Case{"FreeSpacePathLoss", ieee80211_interface},
                                         Case{"RayleighFading", ieee80211_interface},
                                         Case{"NakagamiFading", ieee80211_interface},
                                         Case{"LogNormalShadowing", ieee80211_interface},
                                         Case{"TwoRayInterference", ieee80211_interface},
                                         Case{"BreakpointPathLoss", ieee802154_interface},
                                         Case{"RicianFading", ieee802154_interface},
                                         Case{"RicianFading", ieee80211_interface, 6}),
                         [](const auto& tested) {
                             return tested.param.path_loss +
                                    (tested.param.shadowing_standard_deviation_db > 0 ? "WithShadowing" : "");
                         });

TEST(LinkBudget, AntennasHelpWithTheirLargestGain) {
    NodeConfig config = node();
    const double power_w = budget_of(config).tx_power_w_for(100, 0.5);
    config.wlan[0].radio.antenna.type_name = "ConstantGainAntenna";
    config.wlan[0].radio.antenna.gain = 2;
    EXPECT_NEAR(budget_of(config).tx_power_w_for(100, 0.5), power_w / 4, power_w * 1e-6);
}

TEST(LinkBudget, AMessageHasToFitIntoAFrame) {
    const MediumConfig medium;
    EXPECT_EQ(error_text([&] { LinkBudget(medium, node(), node(), 2277); }),
              "a message of 2277 B is too long: expected at most 2276 B, which mac.mtu_bytes = 2304 B leaves "
              "beside the headers of IPv4 and UDP");
    const NodeConfig narrowband = node(ieee802154_interface);
    EXPECT_EQ(error_text([&] { LinkBudget(medium, narrowband, narrowband, 91); }),
              "a message of 91 B is too long: expected at most 90 B, which a frame of 802.15.4 leaves beside "
              "the headers of IPv4 and UDP");
    EXPECT_EQ(error_text([&] { LinkBudget(medium, node(), node(), -1); }),
              "payload_bytes = -1 B: expected at least 0 B");
}

TEST(LinkBudget, RefusesWhatHasNoAnswer) {
    EXPECT_THROW(budget_of(node(), MediumConfig(std::string(unit_disk_medium))), ConfigError);
    NodeConfig elsewhere = node();
    elsewhere.wlan[0].radio.carrier_hz = 2.437e9;
    EXPECT_THROW(LinkBudget(MediumConfig(), node(), elsewhere, payload_bytes), ConfigError);
    NodeConfig of_another_mode = node();
    of_another_mode.wlan[0].mac.op_mode = "a";
    EXPECT_THROW(LinkBudget(MediumConfig(), node(), of_another_mode, payload_bytes), ConfigError);
    const LinkBudget budget = budget_of(node());
    EXPECT_THROW(budget.tx_power_w_for(-1, 0.5), ConfigError);
    EXPECT_THROW(budget.tx_power_w_for(50, 1), ConfigError);
    NodeConfig deaf = node();
    deaf.wlan[0].radio.antenna.type_name = "ConstantGainAntenna";
    deaf.wlan[0].radio.antenna.gain = 0;
    EXPECT_THROW(budget_of(deaf).tx_power_w_for(50, 0.5), ConfigError);
}

}  // namespace
}  // namespace netsim
