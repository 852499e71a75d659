#include "netsim/mac/rate_control.hpp"

#include "netsim/error.hpp"
#include "netsim/mac/arf_rate_control.hpp"
#include "netsim/mac/minstrel_rate_control.hpp"

namespace netsim {

const Mode& initial_mode(const MacConfig& config) {
    const ModeSet& modes = mode_set(config.op_mode);
    return config.initial_rate_bps == -1
               ? modes.mode_for_bitrate(config.bitrate_bps)
               : modes.mode_for_bitrate(config.initial_rate_bps, "mac.initial_rate_bps");
}

std::unique_ptr<RateControl> make_rate_control(const MacConfig& config, std::uint64_t seed,
                                               InterfaceId interface) {
    const ModeSet& modes = mode_set(config.op_mode);
    if (config.rate_control.empty()) {
        return std::make_unique<FixedRateControl>(modes.mode_for_bitrate(config.bitrate_bps));
    }
    ArfRateControl::Parameters arf{SimTime::from_seconds(config.rate_interval_s), config.increase_threshold,
                                   config.decrease_threshold};
    if (config.rate_control == "ArfRateControl") {
        return std::make_unique<ArfRateControl>(modes, initial_mode(config), arf);
    }
    if (config.rate_control == "AarfRateControl") {
        arf.increase_threshold_factor = config.increase_threshold_factor;
        arf.max_increase_threshold = config.max_increase_threshold;
        return std::make_unique<ArfRateControl>(modes, initial_mode(config), arf);
    }
    NETSIM_ASSERT(config.rate_control == "MinstrelRateControl");
    return std::make_unique<MinstrelRateControl>(
        modes, ResponseModes(config), initial_mode(config),
        MinstrelRateControl::Parameters{SimTime::from_seconds(config.rate_update_interval_s),
                                        config.look_around_share, config.ewma_weight},
        RandomStream(seed, interface.stream(), Purpose::rate_control));
}

}  // namespace netsim
