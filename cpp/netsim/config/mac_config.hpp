// One 802.11 interface: what `*.<node>.wlan[*].opMode`, `.bitrate` and `.mac.…` set in an .ini file. Used by
// the mac.
//
// Defaults are those of INET 4.5's Ieee80211Interface. -1 stands for "as the operation mode has it"; whether
// a bitrate is one of the operation mode's is checked where it is looked up, by ModeSet::mode_for_bitrate.
#pragma once

#include <array>
#include <string>
#include <string_view>

namespace netsim {

inline constexpr std::array<std::string_view, 4> op_mode_names{"b", "g(erp)", "g(mixed)", "a"};
// "": none, all unicast frames have one bitrate.
inline constexpr std::array<std::string_view, 4> rate_control_names{"", "ArfRateControl", "AarfRateControl",
                                                                    "MinstrelRateControl"};

struct MacConfig {
    std::string op_mode = "g(mixed)";   // one of op_mode_names
    double bitrate_bps = -1;            // of data frames; -1: the fastest mandatory one; otherwise > 0
    double multicast_bitrate_bps = -1;  // of broadcast frames; -1: as data; otherwise > 0
    double control_bitrate_bps = -1;    // of RTS frames; -1: the fastest mandatory one; otherwise > 0

    int rts_threshold_bytes = 2346;  // unicast frames (MPDU) of this length on begin with RTS; 0 … 1000000
    int short_retry_limit = 7;       // failures at which RTS, or a shorter frame, is given up; 1 … 255
    int long_retry_limit = 4;        // the same for frames from the RTS threshold on; 1 … 255
    bool inet_station_retry_counters =
        false;        // the window after frames given up by INET's rule (mac/retry.hpp)
    int cw_min = -1;  // smallest contention window in slots; -1: of the operation mode; otherwise 0 … 32767
    int cw_max = -1;  // largest one; -1: of the operation mode; otherwise cw_min … 32767

    int queue_capacity = 100;  // waiting frames, without the one in progress; 1 … 1000000
    int mtu_bytes = 2304;      // largest IP packet; 29 … 2304: 28 B of IPv4 and UDP headers and a payload
    bool backoff_optimization = true;  // immediate access: idle time before the frame counts towards its wait
    bool initial_channel_busy = true;  // for that, the channel was busy before the run; false: it never was
    // DIFS only, from then, for a frame that finds station and channel idle. A station is not before the backoff after its
    // last frame is over, which it has whether or not another frame waits (IEEE 802.11-2020, 10.3.4.2).
    bool skip_backoff_if_idle = false;
    bool own_frames_set_nav = true;  // as INET has it; the standard: only frames of others do
    bool inet_eifs = false;  // EIFS by INET's rules, not by those of the standard (mac/contention.hpp)

    // How the bitrate of unicast frames is chosen, attempt by attempt: one of rate_control_names.
    std::string rate_control;
    double initial_rate_bps = -1;   // of the first frame to a destination; -1: bitrate_bps; otherwise > 0
    double rate_interval_s = 0.05;  // ARF, AARF: time after which a faster one is tried; 1e-6 … 1e6
    int increase_threshold = 10;    // ARF, AARF: successes in a row that lead to a faster one; 1 … 1000000
    int decrease_threshold = 2;     // ARF, AARF: failures in a row that lead to a slower one; 1 … 1000000
    double increase_threshold_factor = 2;  // AARF: of increase_threshold, if the faster one fails; 1 … 1000
    int max_increase_threshold = 50;       // AARF: its bound; increase_threshold … 1000000
    double rate_update_interval_s =
        0.1;  // Minstrel: time from one evaluation of the rates to the next; 1e-6 … 1e6
    double look_around_share = 0.1;  // Minstrel: of frames that try a rate drawn at random; 0 … 1
    double ewma_weight = 0.75;       // Minstrel: of the past in the mean of successes; 0 … 0.999999

    // Throws ConfigError for the first field out of its range: "mac.cw_min = -2: expected …".
    void validate() const;

    bool operator==(const MacConfig&) const = default;
};

}  // namespace netsim
