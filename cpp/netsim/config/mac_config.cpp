#include "netsim/config/mac_config.hpp"

#include "netsim/config/check.hpp"
#include "netsim/config/interface_type.hpp"

namespace netsim {
namespace {

constexpr std::array arf_and_aarf{rate_control_names[1], rate_control_names[2]};
constexpr std::array aarf{rate_control_names[2]};
constexpr std::array minstrel{rate_control_names[3]};
constexpr std::array any{rate_control_names[1], rate_control_names[2], rate_control_names[3]};

constexpr ReadBy with_rate_control{"mac.rate_control", any, ""};
constexpr ReadBy with_arf{"mac.rate_control", arf_and_aarf, "ARF, AARF"};
constexpr ReadBy with_aarf{"mac.rate_control", aarf, "AARF"};
constexpr ReadBy with_minstrel{"mac.rate_control", minstrel, "Minstrel"};

constexpr std::string_view of_the_mode = "that of the operation mode";
constexpr ValueType retry_limit = integer().at_least(1).at_most(255);
constexpr ValueType window = integer().at_least(0).at_most(32767).or_special(-1, of_the_mode);
constexpr ValueType threshold = integer().at_least(1).at_most(1'000'000);
constexpr ValueType interval = quantity("s").shown_in("ms").at_least(1e-6).at_most(1e6);

constexpr Field fields[] = {
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
    {NETSIM_FIELD(MacConfig, short_retry_limit), "mac.dcf.recoveryProcedure.shortRetryLimit", retry_limit,
     "Number of failures after which an RTS, or a frame below the RTS threshold, is dropped"},
    {NETSIM_FIELD(MacConfig, long_retry_limit), "mac.dcf.recoveryProcedure.longRetryLimit", retry_limit,
     "Number of failures after which a frame at or above the RTS threshold is dropped"},
    {NETSIM_FIELD(MacConfig, inet_station_retry_counters),
     "mac.dcf.recoveryProcedure.inetStationRetryCounters", boolean(),
     "Whether failures are counted across dropped frames, as in INET: from the second in a row on, the "
     "contention"
     " window stays large"},
    {NETSIM_FIELD(MacConfig, ns3_station_window), "mac.dcf.recoveryProcedure.ns3StationWindow", boolean(),
     "Whether a dropped frame leaves the contention window as it is, as in ns-3 3.44: the failure after "
     "shortRetryLimit others in a row resets it"},
    {NETSIM_FIELD(MacConfig, cw_min), "mac.dcf.channelAccess.cwMin", window,
     "Smallest contention window in slots; -1: that of opMode"},
    {NETSIM_FIELD(MacConfig, cw_max), "mac.dcf.channelAccess.cwMax", window,
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
     "Bit rate of the first frame to a node; -1bps: that of data frames", with_rate_control},
    {NETSIM_FIELD(MacConfig, rate_interval_s), "mac.dcf.rateControl.interval", interval,
     "time after the last change at which the next faster rate is tried", with_arf},
    {NETSIM_FIELD(MacConfig, increase_threshold), "mac.dcf.rateControl.increaseThreshold", threshold,
     "successes in a row that lead to the next faster rate", with_arf},
    {NETSIM_FIELD(MacConfig, decrease_threshold), "mac.dcf.rateControl.decreaseThreshold", threshold,
     "failures in a row that lead to the next slower rate", with_arf},
    {NETSIM_FIELD(MacConfig, increase_threshold_factor), "mac.dcf.rateControl.increaseThresholdFactor",
     number().at_least(1).at_most(1000),
     "factor by which increaseThreshold grows when the faster rate fails at once", with_aarf},
    {NETSIM_FIELD(MacConfig, max_increase_threshold), "mac.dcf.rateControl.maxIncreaseThreshold", threshold,
     "upper bound of that growth", with_aarf},
    {NETSIM_FIELD(MacConfig, rate_update_interval_s), "mac.dcf.rateControl.updateInterval", interval,
     "time from one choice of the best rates to the next", with_minstrel},
    {NETSIM_FIELD(MacConfig, look_around_share), "mac.dcf.rateControl.lookAroundRate",
     number().at_least(0).at_most(1), "fraction of the frames that try a random rate", with_minstrel},
    {NETSIM_FIELD(MacConfig, ewma_weight), "mac.dcf.rateControl.ewmaWeight",
     number().at_least(0).at_most(0.999999), "weight of the past in the mean success probability",
     with_minstrel},
    {NETSIM_FIELD(MacConfig, own_frames_set_nav), "mac.rx.ownFramesSetNav", boolean(),
     "Whether a node's own frames reserve the channel against itself, as in INET; not in the standard"},
    {NETSIM_FIELD(MacConfig, unanswered_rts_resets_nav), "mac.rx.unansweredRtsResetsNav", boolean(),
     "Whether the channel that an RTS reserved is free again if no frame follows it, as in ns-3"},
};

}  // namespace

const Schema MacConfig::schema{"mac", "wlan[0]", true, fields, with_ieee80211};

void MacConfig::validate() const {
    check_fields(*this);
    if (cw_max != -1) {
        check_at_most("mac.cw_min", cw_min, "mac.cw_max", cw_max);
    }
    // ARF has no upper bound, so the bound of AARF must not reject its threshold.
    if (rate_control == "AarfRateControl") {
        check_at_most("mac.increase_threshold", increase_threshold, "mac.max_increase_threshold",
                      max_increase_threshold);
    }
}

}  // namespace netsim
