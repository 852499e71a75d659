// One 802.11 interface: settings `*.<node>.wlan[*].opMode`, `.bitrate` and `.mac.…` of an .ini file. Used by the mac.
// The meaning and range of each field are in mac_config.cpp.
//
// Defaults are those of INET 4.5's Ieee80211Interface. ModeSet::mode_for_bitrate checks whether a bitrate is one of the
// operation mode's.
#pragma once

#include <array>
#include <string>
#include <string_view>

#include "netsim/config/field.hpp"
#include "netsim/config/full_queue.hpp"

namespace netsim {

inline constexpr std::array<std::string_view, 4> op_mode_names{"b", "g(erp)", "g(mixed)", "a"};
// "": none, all unicast frames have the same bitrate.
inline constexpr std::array<std::string_view, 4> rate_control_names{"", "ArfRateControl", "AarfRateControl",
                                                                    "MinstrelRateControl"};

struct MacConfig {
    std::string op_mode = "g(mixed)";
    double bitrate_bps = -1;            // -1: the fastest mandatory one
    double multicast_bitrate_bps = -1;  // -1: that of data frames
    double control_bitrate_bps = -1;    // of RTS frames; -1: the fastest mandatory one

    Bitrates basic_bitrates_bps;  // mac/response_modes.hpp; empty: the mandatory ones

    int rts_threshold_bytes = 2346;  // length of the MPDU
    int short_retry_limit = 7;
    int long_retry_limit = 4;
    bool inet_station_retry_counters = false;  // mac/retry.hpp
    bool ns3_station_window = false;           // mac/retry.hpp
    int cw_min = -1;                           // -1: that of the operation mode
    int cw_max = -1;                           // -1: that of the operation mode

    int queue_capacity = 100;
    std::string queue_when_full{drop_when_full};
    int mtu_bytes = 2304;  // with 28 B of IPv4 and UDP headers
    // Immediate access: idle time before the frame counts toward its wait.
    bool backoff_optimization = true;
    bool initial_channel_busy = true;
    // A station is idle after the backoff that follows its last frame. There is such a backoff even if no other frame
    // waits (IEEE 802.11-2020, 10.3.4.2).
    bool skip_backoff_if_idle = false;
    bool own_frames_set_nav = true;          // as in INET; in the standard, only frames of other stations do
    bool unanswered_rts_resets_nav = false;  // as in ns-3; the standard permits it
    bool inet_eifs = false;                  // mac/contention.hpp
    bool ns3_eifs = false;                   // mac/contention.hpp

    std::string rate_control;  // of unicast frames, attempt by attempt
    double initial_rate_bps = -1;
    double rate_interval_s = 0.05;
    int increase_threshold = 10;
    int decrease_threshold = 2;
    double increase_threshold_factor = 2;
    int max_increase_threshold = 50;
    double rate_update_interval_s = 0.1;
    double look_around_share = 0.1;
    double ewma_weight = 0.75;

    static const Schema schema;

    // Throws ConfigError for the first field outside its range: "mac.cw_min = -2: expected …".
    void validate() const;

    bool operator==(const MacConfig&) const = default;
};

}  // namespace netsim
