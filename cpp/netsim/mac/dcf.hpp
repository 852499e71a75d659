// An 802.11 station without QoS: the distributed coordination function.
//
// Sends the frames of its queue one by one (contention, frame, ACK, retries), answers data frames with an ACK after
// SIFS, keeps the NAV and drops duplicates.
//
// States of the exchange that this station originates:
//   NONE --channel granted--> SENDING --end of a broadcast--> NONE
//                                |
//                       end of a unicast --> AWAITING_ACK --ACK: done; time-out or another frame: retry--> NONE
// Beside it, the response to a received unicast frame: NONE --received--> WAITING_SIFS --> SENDING --> NONE.
//
// Source: IEEE 802.11-2020, 10.3 (DCF); the choices where the standard leaves room are those of INET 4.5.
#pragma once

#include <cstdint>
#include <memory>

#include "netsim/config/mac_config.hpp"
#include "netsim/mac/contention.hpp"
#include "netsim/mac/duplicate_filter.hpp"
#include "netsim/mac/link.hpp"
#include "netsim/mac/timing.hpp"
#include "netsim/mac/tx_queue.hpp"
#include "netsim/phy/radio.hpp"
#include "netsim/trace/message_fates.hpp"

namespace netsim {

class Dcf final : public Link, private RadioListener, private ContentionListener {
public:
    Dcf(Simulator& simulator, Radio& radio, const MacConfig& config, std::uint64_t seed, MessageFates& fates,
        LinkListener& listener);
    Dcf(const Dcf&) = delete;
    Dcf& operator=(const Dcf&) = delete;

    // Throws ConfigError for what MacConfig::validate cannot know: bitrates and windows that the operation mode has not.
    static void check(const MacConfig& config);

    void send(NodeId destination, Payload payload) override;
    std::size_t queued_messages() const override { return queue_.size() + (in_progress_ ? 1 : 0); }

private:
    enum class Exchange { none, sending, awaiting_ack };
    enum class Response { none, waiting_sifs, sending };

    void channel_busy_changed(bool busy) override;
    void frame_received(const Transmission& transmission) override;
    void frame_corrupted() override;
    void transmission_ended() override;
    void channel_granted() override;

    void send_ack(NodeId receiver, const Mode& mode);
    void ack_timed_out();
    void attempt_failed();
    void finish(MessageFate fate);
    void contend_for_next();
    void set_nav(SimTime duration);
    void update_contention();
    void transmit(std::shared_ptr<const Frame> frame, const Mode& mode);

    Simulator& simulator_;
    Radio& radio_;
    MessageFates& fates_;
    LinkListener& listener_;
    const ModeSet& modes_;
    MacTiming timing_;
    const Mode& data_mode_;
    const Mode& multicast_mode_;
    int retry_limit_;
    int mtu_bytes_;
    int cw_min_;
    int cw_max_;

    TxQueue queue_;
    DuplicateFilter duplicates_;
    Contention contention_;
    bool contention_sees_busy_ = false;
    SimTime nav_end_ = SimTime::long_ago();
    EventHandle nav_event_;

    Exchange exchange_ = Exchange::none;
    Response response_ = Response::none;
    std::shared_ptr<const Frame> in_progress_;  // granted once, not finished yet
    EventHandle ack_timeout_;
    int failures_ = 0;  // of the frame in progress
    int cw_;
    std::uint32_t next_sequence_ = 0;
};

}  // namespace netsim
