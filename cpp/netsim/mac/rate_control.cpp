#include "netsim/mac/rate_control.hpp"

#include "netsim/mac/arf_rate_control.hpp"
#include "netsim/mac/minstrel_rate_control.hpp"

namespace netsim {

const Mode& initial_mode(const MacConfig& config) {
    const ModeSet& modes = mode_set(config.op_mode);
    return config.initial_rate_bps == -1
               ? modes.mode_for_bitrate(config.bitrate_bps)
               : modes.mode_for_bitrate(config.initial_rate_bps, "mac.initial_rate_bps");
}

namespace {

using Made = std::unique_ptr<RateControl>;

ArfRateControl::Parameters arf_parameters(const MacConfig& config) {
    return {SimTime::from_seconds(config.rate_interval_s), config.increase_threshold,
            config.decrease_threshold};
}

constexpr Factory<Made (*)(const MacConfig&, std::uint64_t seed, InterfaceId)> factories[] = {
    {"",
     [](const MacConfig& config, std::uint64_t, InterfaceId) -> Made {
         return std::make_unique<FixedRateControl>(
             mode_set(config.op_mode).mode_for_bitrate(config.bitrate_bps));
     }},
    {"ArfRateControl",
     [](const MacConfig& config, std::uint64_t, InterfaceId) -> Made {
         return std::make_unique<ArfRateControl>(mode_set(config.op_mode), initial_mode(config),
                                                 arf_parameters(config));
     }},
    {"AarfRateControl",
     [](const MacConfig& config, std::uint64_t, InterfaceId) -> Made {
         ArfRateControl::Parameters aarf = arf_parameters(config);
         aarf.increase_threshold_factor = config.increase_threshold_factor;
         aarf.max_increase_threshold = config.max_increase_threshold;
         return std::make_unique<ArfRateControl>(mode_set(config.op_mode), initial_mode(config), aarf);
     }},
    {"MinstrelRateControl",
     [](const MacConfig& config, std::uint64_t seed, InterfaceId interface) -> Made {
         return std::make_unique<MinstrelRateControl>(
             mode_set(config.op_mode), ResponseModes(config), initial_mode(config),
             MinstrelRateControl::Parameters{SimTime::from_seconds(config.rate_update_interval_s),
                                             config.look_around_share, config.ewma_weight},
             RandomStream(seed, interface.stream(), Purpose::rate_control));
     }},
};
static_assert(makes_all(factories, rate_controls));

}  // namespace

std::unique_ptr<RateControl> make_rate_control(const MacConfig& config, std::uint64_t seed,
                                               InterfaceId interface) {
    return factory_of(config.rate_control, factories)(config, seed, interface);
}

}  // namespace netsim
