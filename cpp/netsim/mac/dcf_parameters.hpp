// What the stations of one configuration in one network have in common: worked out once, never changed, shared by all of them.
#pragma once

#include "netsim/config/mac_config.hpp"
#include "netsim/kernel/sim_time.hpp"
#include "netsim/kernel/simulator.hpp"
#include "netsim/mac/retry.hpp"
#include "netsim/mac/timing.hpp"
#include "netsim/phy/modes.hpp"

namespace netsim {

// In which broadcast frames are sent. Throws ConfigError for a bitrate that the operation mode has not.
const Mode& broadcast_mode(const MacConfig& config);

struct DcfParameters {
    // Throws ConfigError for what MacConfig::validate cannot know: bitrates and windows that the operation mode has not.
    DcfParameters(Simulator& simulator, MacConfig mac_config);

    Simulator& simulator;
    MacConfig config;
    const ModeSet& modes;
    MacTiming timing;
    const Mode& initial_mode;  // of unicast frames
    const Mode& broadcast_mode;
    const Mode& rts_mode;
    Retry::Rules retry;
    SimTime longest_wait;  // for a channel that is free: what counts of the time before
    bool has_adaptive_rate;
};

}  // namespace netsim
