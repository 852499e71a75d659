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
        // MacConfig::validate compares values that are both set, so one of these is the mode's.
        const bool is_min_set = config.cw_min >= 0;
        const Quantity min{static_cast<double>(window.min), ""};
        const Quantity max{static_cast<double>(window.max), ""};
        const std::string of_mode = ", of the operation mode " + config.op_mode;
        if (is_min_set) {
            throw ConfigError({.field = "mac.cw_min",
                               .value = min,
                               .message = {"expected at most ", FieldName{"mac.cw_max"}, ", ", max, of_mode},
                               .compared_with = {"mac.op_mode"}});
        }
        throw ConfigError({.field = "mac.cw_max",
                           .value = max,
                           .message = {"expected at least ", FieldName{"mac.cw_min"}, ", ", min, of_mode},
                           .compared_with = {"mac.op_mode"}});
    }
    return window;
}

Retry::Rule retry_rule_of(const MacConfig& config) {
    if (config.inet_station_retry_counters) {
        return Retry::Rule::station_counters;
    }
    return config.ns3_station_window ? Retry::Rule::station_window : Retry::Rule::frame_counters;
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
      responses(config),
      initial_mode(checked_initial_mode(config, modes)),
      broadcast_mode(netsim::broadcast_mode(config)),
      rts_mode(modes.mode_for_bitrate(config.control_bitrate_bps, "mac.control_bitrate_bps")),
      retry{{config.short_retry_limit, config.long_retry_limit},
            contention_window_of(config, modes),
            retry_rule_of(config)},
      // For a new message, the window is at its minimum, unless the rule lets failures of earlier
      // messages enlarge it.
      longest_wait(timing.difs +
                   timing.slot *
                       (retry.rule == Retry::Rule::frame_counters ? retry.window.min : retry.window.max)),
      has_adaptive_rate(!config.rate_control.empty()) {}

}  // namespace netsim
