#include "netsim/mac/ideal_timing.hpp"

#include "netsim/config/medium_config.hpp"
#include "netsim/mac/dcf_parameters.hpp"
#include "netsim/mac/frame_802154.hpp"
#include "netsim/mac/response_modes.hpp"
#include "netsim/mac/timing.hpp"
#include "netsim/phy/oqpsk_mode.hpp"

namespace netsim {

IdealTiming::IdealTiming(std::string_view timing, const InterfaceConfig& config)
    : is_instant_(timing == instant_timing),
      senses_channel_(timing == channel_access_timing),
      collides_(timing == aloha_timing),
      is_802154_(config.type_name == ieee802154_interface),
      queue_capacity_(is_802154_ ? config.csma.queue_capacity : config.mac.queue_capacity),
      blocks_((is_802154_ ? config.csma.queue_when_full : config.mac.queue_when_full) == block_when_full),
      most_attempts_(config.mac.short_retry_limit) {
    if (is_802154_) {
        most_attempts_ = config.csma.use_acks ? config.csma.max_frame_retries + 1 : 1;
        broadcast_ = unicast_ = &oqpsk_250_kbps;
        if (config.csma.use_acks) {
            response_ =
                SimTime::from_seconds(config.csma.sifs_s) + oqpsk_250_kbps.duration(narrowband_ack_bytes);
        }
        gap_ = SimTime::from_seconds(config.csma.lifs_s);
        return;
    }
    const ModeSet& modes = mode_set(config.mac.op_mode);
    const MacTiming intervals(modes);
    broadcast_ = &broadcast_mode(config.mac);
    unicast_ = &modes.mode_for_bitrate(config.mac.bitrate_bps);
    response_ = intervals.sifs + ResponseModes(config.mac).to(*unicast_).duration(ack_bytes);
    gap_ = intervals.difs;
}

int IdealTiming::psdu_bytes(int payload_bytes) const {
    return is_802154_ ? narrowband_psdu_bytes(payload_bytes) : data_psdu_bytes(payload_bytes);
}

SimTime IdealTiming::airtime(FrameKind kind, int psdu_bytes) const {
    return is_instant_ ? SimTime{} : mode(kind).duration(psdu_bytes);
}

}  // namespace netsim
