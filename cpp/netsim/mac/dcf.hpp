// An 802.11 station without QoS: the distributed coordination function.
//
// It sends the frames of its queue one by one: contention, RTS and CTS at or above the RTS threshold,
// frame, ACK, retries. After SIFS, it responds to data frames with an ACK and to RTS frames with a
// CTS. It maintains the NAV and drops duplicates. For each attempt to send a unicast frame, the rate
// control chooses the mode when the channel is granted.
//
// States of the exchange that this station originates:
//
//   NONE --channel granted, frame below the RTS threshold or broadcast--> SENDING
//    |                                                                     ^   |
//    +--channel granted, unicast at or above threshold--> SENDING_RTS      |   +--end of a broadcast: done--> NONE
//                                                              | end       |   |
//          NONE <--time-out or another frame: retry-- AWAITING_CTS         |   | end of a unicast
//                                                              | CTS       |   v
//                                                              v           |  AWAITING_ACK --ACK: done--> NONE
//                                                         WAITING_SIFS ----+   |
//                                                                              +--time-out or another frame: retry--> NONE
//
// In parallel, the response to a received unicast frame or RTS: NONE --received--> WAITING_SIFS --> SENDING --> NONE. The station
// responds to an RTS only if the NAV is not set.
//
// Source: IEEE 802.11-2020, 10.3 (DCF). Where the standard leaves room, the choices are those of
// INET 4.5. One choice of INET violates the standard and is an option, own_frames_set_nav: a
// station's own frames set its NAV. So a station whose RTS failed stays silent for the duration of
// the planned exchange.
// The standard permits another option, unanswered_rts_resets_nav: a NAV that an RTS set ends if no frame
// begins in the time of the CTS.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <vector>

#include "netsim/kernel/prefetch.hpp"
#include "netsim/mac/channel_access.hpp"
#include "netsim/mac/dcf_parameters.hpp"
#include "netsim/mac/duplicate_filter.hpp"
#include "netsim/mac/network_interface.hpp"
#include "netsim/mac/rate_control.hpp"
#include "netsim/mac/retry.hpp"
#include "netsim/mac/transmit_queue.hpp"
#include "netsim/phy/radio.hpp"

namespace netsim {

class alignas(64) Dcf final : public NetworkInterface, private RadioListener, private ContentionListener {
public:
    Dcf(Radio& radio, std::shared_ptr<const DcfParameters> parameters, std::uint64_t seed);
    Dcf(const Dcf&) = delete;
    Dcf& operator=(const Dcf&) = delete;

    void send(NodeId destination, Payload payload, CauseId cause) override;
    void prefetch(int step) const override {
        if (step == 0) {
            prefetch_before(*this, owned_parameters_);
        }
        radio_.prefetch(step);
    }
    std::size_t longest_message_bytes() const override {
        return parameters_.config.mtu_bytes - datagram_bytes(0);
    }
    const MessageOutcomes& message_outcomes() const override { return queue_.message_outcomes(); }
    std::size_t queued_messages() const override { return queue_.size(); }
    std::map<std::int64_t, std::uint64_t> frames_by_bitrate() const override;

private:
    enum class Exchange : std::uint8_t {
        none,
        sending_rts,
        awaiting_cts,
        waiting_sifs,
        sending,
        awaiting_ack
    };
    enum class Response : std::uint8_t { none, waiting_sifs, sending };

    void channel_busy_changed(bool busy) override { channel_.radio_changed(busy); }
    void frame_received(const Transmission& transmission) override;
    void frame_corrupted(CorruptedFrame frame) override;
    void transmission_ended() override;
    void prefetch_for_corrupted_frame() const override { channel_.prefetch_for_corrupted_frame(); }
    void channel_granted() override;

    Simulator& simulator() const { return parameters_.simulator; }
    bool is_long(const Frame& frame) const {
        return frame.psdu_bytes >= parameters_.config.rts_threshold_bytes;
    }
    const Frame& in_progress() const { return *queue_.in_progress(); }
    bool needs_rts(const Frame& frame) const { return frame.receiver != broadcast_id && is_long(frame); }
    RateAttempt attempt() const;
    void choose_data_mode();
    bool is_awaiting_answer() const;
    void send_rts();
    void send_in_progress();
    void await_answer(Exchange awaiting, const Mode& answer);
    void answer_timed_out();
    void answered();
    void attempt_failed();
    void finish(MessageOutcome outcome);
    void contend_for_next();
    void addressed_here(const Frame& frame, const Mode& mode);
    void respond_after_sifs(Frame response, const Mode& mode);
    void own_frame_ended(const Frame& frame);
    void transmit(std::shared_ptr<const Frame> frame, const Mode& mode);

    // The members that every received frame reads come first: one cache line, which the medium
    // prefetches.
    Exchange exchange_ = Exchange::none;
    Response response_ = Response::none;
    int attempts_ = 0;  // failed attempts of the frame in progress that were on the air
    ChannelAccess channel_;

    // Then the members that sending a broadcast reads: four cache lines with those of the channel.
    Retry retry_;          // of the frame in progress
    TransmitQueue queue_;  // its frame in progress was granted the channel at least once
    const DcfParameters& parameters_;
    Radio& radio_;

    std::shared_ptr<const DcfParameters> owned_parameters_;  // keeps parameters_ alive
    std::unique_ptr<RateControl> rate_control_;
    // [mode index]: unicast frames sent; empty without adaptive rate control.
    std::vector<std::uint64_t> frames_by_mode_;
    DuplicateFilter duplicates_;

    std::shared_ptr<const Frame> rts_;  // on the air
    const Mode* data_mode_;             // of the current or the last unicast frame
    EventHandle answer_timeout_;

    std::shared_ptr<const Frame> response_frame_;
    const Mode* response_mode_ = nullptr;
};

}  // namespace netsim
