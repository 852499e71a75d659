// Parameters shared by all stations with the same configuration in a network. Computed once and never
// changed.
#pragma once

#include "netsim/config/mac_config.hpp"
#include "netsim/kernel/sim_time.hpp"
#include "netsim/kernel/simulator.hpp"
#include "netsim/mac/response_modes.hpp"
#include "netsim/mac/retry.hpp"
#include "netsim/mac/timing.hpp"
#include "netsim/phy/modes.hpp"

namespace netsim {

// The mode of broadcast frames. Throws ConfigError for a bitrate that the operation mode does not
// have.
const Mode& broadcast_mode(const MacConfig& config);

struct DcfParameters {
    // Throws ConfigError for values that MacConfig::validate cannot check: bitrates and windows that
    // the operation mode excludes.
    DcfParameters(Simulator& simulator, MacConfig mac_config);

    Simulator& simulator;
    MacConfig config;
    const ModeSet& modes;
    MacTiming timing;
    ResponseModes responses;
    const Mode& initial_mode;  // of unicast frames
    const Mode& broadcast_mode;
    const Mode& rts_mode;
    Retry::Rules retry;
    SimTime longest_wait;  // for the channel: the time for which its past state matters
    bool has_adaptive_rate;
};

}  // namespace netsim
