#include "netsim/mac/dcf_parameters.hpp"

#include <string>
#include <utility>

#include "netsim/error.hpp"
#include "netsim/mac/rate_control.hpp"

namespace netsim {

namespace {

const Mode& checked_initial_mode(const MacConfig& config, const ModeSet& modes) {
    modes.mode_for_bitrate(config.bitrate_bps);
    return initial_mode(config);
}

Retry::Window contention_window_of(const MacConfig& config, const ModeSet& modes) {
    const Retry::Window window{config.cw_min < 0 ? modes.cw_min() : config.cw_min,
                               config.cw_max < 0 ? modes.cw_max() : config.cw_max};
    if (window.max < window.min) {
        throw ConfigError("mac.cw_min = " + std::to_string(window.min) +
                          " and mac.cw_max = " + std::to_string(window.max) +
                          " slots: expected the second to be at least the first (what " +
                          "is not set is that of the operation mode, " + config.op_mode + ")");
    }
    return window;
}

}  // namespace

const Mode& broadcast_mode(const MacConfig& config) {
    const ModeSet& modes = mode_set(config.op_mode);
    return config.multicast_bitrate_bps < 0
               ? modes.mode_for_bitrate(config.bitrate_bps)
               : modes.mode_for_bitrate(config.multicast_bitrate_bps, "mac.multicast_bitrate_bps");
}

DcfParameters::DcfParameters(Simulator& simulator_, MacConfig mac_config)
    : simulator(simulator_),
      config(std::move(mac_config)),
      modes(mode_set(config.op_mode)),
      timing(modes),
      initial_mode(checked_initial_mode(config, modes)),
      broadcast_mode(netsim::broadcast_mode(config)),
      rts_mode(modes.mode_for_bitrate(config.control_bitrate_bps, "mac.control_bitrate_bps")),
      retry{{config.short_retry_limit, config.long_retry_limit},
            contention_window_of(config, modes),
            config.inet_station_retry_counters ? Retry::Rule::station_counters : Retry::Rule::frame_counters},
      // For a new message, the window is at its minimum, unless INET's counters have left it
      // larger.
      longest_wait(timing.difs +
                   timing.slot *
                       (retry.rule == Retry::Rule::station_counters ? retry.window.max : retry.window.min)),
      has_adaptive_rate(!config.rate_control.empty()) {}

}  // namespace netsim
