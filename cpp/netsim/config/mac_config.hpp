// One 802.11 interface: settings `*.<node>.wlan[*].opMode`, `.bitrate` and `.mac.…` of an .ini file. Used by the mac.
// Each field has a row below the struct.
//
// Defaults are those of INET 4.5's Ieee80211Interface. ModeSet::mode_for_bitrate checks whether a bitrate is one of the
// operation mode's.
#pragma once

#include <array>
#include <string>
#include <string_view>

#include "netsim/config/field.hpp"
#include "netsim/config/full_queue.hpp"
#include "netsim/config/interface_type.hpp"

namespace netsim {

inline constexpr std::array<std::string_view, 4> op_mode_names{"b", "g(erp)", "g(mixed)", "a"};
// "": none, all unicast frames have the same bitrate.
inline constexpr Model rate_controls[] = {
    {""},
    {"ArfRateControl", {"initial_rate_bps", "rate_interval_s", "increase_threshold", "decrease_threshold"}},
    {"AarfRateControl",
     {"initial_rate_bps", "rate_interval_s", "increase_threshold", "decrease_threshold",
      "increase_threshold_factor", "max_increase_threshold"}},
    {"MinstrelRateControl",
     {"initial_rate_bps", "rate_update_interval_s", "look_around_share", "ewma_weight"}},
};
inline constexpr auto rate_control_names = names_of(rate_controls);
inline constexpr ReadBy by_rate_control{"mac.rate_control", rate_controls};

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

namespace mac_values {
inline constexpr ValueType retry_limit = integer().at_least(1).at_most(255);
inline constexpr ValueType window =
    integer().at_least(0).at_most(32767).or_special(-1, "that of the operation mode");
inline constexpr ValueType threshold = integer().at_least(1).at_most(1'000'000);
inline constexpr ValueType interval = quantity("s").shown_in("ms").at_least(1e-6).at_most(1e6);
}  // namespace mac_values

inline constexpr Field mac_fields[] = {
    {NETSIM_FIELD(MacConfig, op_mode), "opMode", one_of(op_mode_names),
     "Generation of IEEE 802.11, which sets bit rates and timing"},
    {NETSIM_FIELD(MacConfig, bitrate_bps), "bitrate", bitrate(),
     "Bit rate of data frames; -1bps: the fastest mandatory one"},
    {NETSIM_FIELD(MacConfig, mtu_bytes), "mac.mtu", bytes().at_least(29).at_most(2304),
     "802.11: largest IP packet, made of 28 B of headers and the message; a longer message is refused"},
    {NETSIM_FIELD(MacConfig, multicast_bitrate_bps), "mac.dcf.rateSelection.multicastFrameBitrate", bitrate(),
     "Bit rate of broadcast frames; -1bps: that of data frames"},
    {NETSIM_FIELD(MacConfig, control_bitrate_bps), "mac.dcf.rateSelection.controlFrameBitrate", bitrate(),
     "Bit rate of RTS frames; -1bps: the fastest mandatory one"},
    {NETSIM_FIELD(MacConfig, basic_bitrates_bps), "mac.basicBitrates", bitrates(),
     "Bit rates of ACK and CTS frames: the fastest of them with the modulation of the answered frame that is "
     "not faster than it; if there is none, and with [], the same among the mandatory bit rates"},
    {NETSIM_FIELD(MacConfig, rts_threshold_bytes), "mac.dcf.rtsPolicy.rtsThreshold",
     bytes().at_least(0).at_most(1'000'000), "Unicast frames of at least this length begin with RTS and CTS"},
    {NETSIM_FIELD(MacConfig, short_retry_limit), "mac.dcf.recoveryProcedure.shortRetryLimit",
     mac_values::retry_limit,
     "Number of failures after which an RTS, or a frame below the RTS threshold, is dropped"},
    {NETSIM_FIELD(MacConfig, long_retry_limit), "mac.dcf.recoveryProcedure.longRetryLimit",
     mac_values::retry_limit,
     "Number of failures after which a frame at or above the RTS threshold is dropped"},
    {NETSIM_FIELD(MacConfig, inet_station_retry_counters),
     "mac.dcf.recoveryProcedure.inetStationRetryCounters", boolean(),
     "Whether failures are counted across dropped frames, as in INET: from the second in a row on, the "
     "contention"
     " window stays large"},
    {NETSIM_FIELD(MacConfig, ns3_station_window), "mac.dcf.recoveryProcedure.ns3StationWindow", boolean(),
     "Whether a dropped frame leaves the contention window as it is, as in ns-3 3.44: the failure after "
     "shortRetryLimit others in a row resets it"},
    {NETSIM_FIELD(MacConfig, cw_min), "mac.dcf.channelAccess.cwMin", mac_values::window,
     "Smallest contention window in slots; -1: that of opMode"},
    {NETSIM_FIELD(MacConfig, cw_max), "mac.dcf.channelAccess.cwMax", mac_values::window,
     "Largest contention window in slots; -1: that of opMode"},
    {NETSIM_FIELD(MacConfig, queue_capacity), "mac.dcf.channelAccess.pendingQueue.packetCapacity",
     integer().at_least(1).at_most(1'000'000),
     "Number of frames that can wait in the queue, without the one in progress"},
    {NETSIM_FIELD(MacConfig, queue_when_full), "mac.dcf.channelAccess.pendingQueue.whenFull",
     one_of(when_full_names),
     "What happens to a message if the queue is full: it is dropped, or it waits in front of the queue, and "
     "with it the "
     "events of its protocol, as with a socket that blocks (docs/how-to/model-a-board.md)"},
    {NETSIM_FIELD(MacConfig, backoff_optimization), "mac.dcf.channelAccess.contention.backoffOptimization",
     boolean(), "Whether idle time before a frame arrives counts toward its wait"},
    {NETSIM_FIELD(MacConfig, initial_channel_busy), "mac.dcf.channelAccess.contention.initialChannelBusy",
     boolean(),
     "For backoffOptimization: whether the channel was busy until the run began; false: it has always been "
     "idle"},
    {NETSIM_FIELD(MacConfig, skip_backoff_if_idle), "mac.dcf.channelAccess.contention.skipBackoffIfIdle",
     boolean(),
     "Whether a frame that finds station and channel idle waits only for DIFS, without a backoff; the "
     "station is idle"
     " after the backoff that follows each frame"},
    {NETSIM_FIELD(MacConfig, inet_eifs), "mac.dcf.channelAccess.contention.inetEifs", boolean(),
     "Whether EIFS follows INET's rules instead of the standard's"},
    {NETSIM_FIELD(MacConfig, ns3_eifs), "mac.dcf.channelAccess.contention.ns3Eifs", boolean(),
     "Whether EIFS begins at the end of the corrupted frame, as in ns-3, instead of when the channel is "
     "free; a lost PHY header brings none"},
    {NETSIM_FIELD(MacConfig, rate_control), "mac.dcf.rateControl.typename", one_of(rate_control_names),
     "How the bit rate of unicast frames follows the losses; \"\": it is constant"},
    {NETSIM_FIELD(MacConfig, initial_rate_bps), "mac.dcf.rateControl.initialRate", bitrate(),
     "bit rate of the first frame to a node; -1bps: that of data frames", by_rate_control},
    {NETSIM_FIELD(MacConfig, rate_interval_s), "mac.dcf.rateControl.interval", mac_values::interval,
     "time after the last change at which the next faster rate is tried", by_rate_control},
    {NETSIM_FIELD(MacConfig, increase_threshold), "mac.dcf.rateControl.increaseThreshold",
     mac_values::threshold, "successes in a row that lead to the next faster rate", by_rate_control},
    {NETSIM_FIELD(MacConfig, decrease_threshold), "mac.dcf.rateControl.decreaseThreshold",
     mac_values::threshold, "failures in a row that lead to the next slower rate", by_rate_control},
    {NETSIM_FIELD(MacConfig, increase_threshold_factor), "mac.dcf.rateControl.increaseThresholdFactor",
     number().at_least(1).at_most(1000),
     "factor by which increaseThreshold grows when the faster rate fails at once", by_rate_control},
    {NETSIM_FIELD(MacConfig, max_increase_threshold), "mac.dcf.rateControl.maxIncreaseThreshold",
     mac_values::threshold, "upper bound of that growth", by_rate_control},
    {NETSIM_FIELD(MacConfig, rate_update_interval_s), "mac.dcf.rateControl.updateInterval",
     mac_values::interval, "time from one choice of the best rates to the next", by_rate_control},
    {NETSIM_FIELD(MacConfig, look_around_share), "mac.dcf.rateControl.lookAroundRate",
     number().at_least(0).at_most(1), "fraction of the frames that try a random rate", by_rate_control},
    {NETSIM_FIELD(MacConfig, ewma_weight), "mac.dcf.rateControl.ewmaWeight",
     number().at_least(0).at_most(0.999999), "weight of the past in the mean success probability",
     by_rate_control},
    {NETSIM_FIELD(MacConfig, own_frames_set_nav), "mac.rx.ownFramesSetNav", boolean(),
     "Whether a node's own frames reserve the channel against itself, as in INET; not in the standard"},
    {NETSIM_FIELD(MacConfig, unanswered_rts_resets_nav), "mac.rx.unansweredRtsResetsNav", boolean(),
     "Whether the channel that an RTS reserved is free again if no frame follows it, as in ns-3"},
};

inline constexpr Schema MacConfig::schema{"mac", "wlan[0]", true, mac_fields, by_interface};

}  // namespace netsim
