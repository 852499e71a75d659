// An 802.11 station without QoS: the distributed coordination function.
//
// Sends the frames of its queue one by one (contention, RTS and CTS from the RTS threshold on, frame, ACK, retries),
// answers data frames with an ACK and RTS frames with a CTS after SIFS, keeps the NAV and drops duplicates. The mode of
// a unicast frame is chosen when the channel is granted, anew for each attempt, by the rate control.
//
// States of the exchange that this station originates:
//
//   NONE --channel granted, frame below the RTS threshold or broadcast--> SENDING
//    |                                                                     ^   |
//    +--channel granted, unicast from the threshold on--> SENDING_RTS      |   +--end of a broadcast: done--> NONE
//                                                              | end       |   |
//          NONE <--time-out or another frame: retry-- AWAITING_CTS         |   | end of a unicast
//                                                              | CTS       |   v
//                                                              v           |  AWAITING_ACK --ACK: done--> NONE
//                                                         WAITING_SIFS ----+   |
//                                                                              +--time-out or another frame: retry--> NONE
//
// Beside it, the response to a received unicast frame or RTS: NONE --received--> WAITING_SIFS --> SENDING --> NONE.
// An RTS is answered only if the NAV is not set.
//
// Source: IEEE 802.11-2020, 10.3 (DCF); the choices where the standard leaves room are those of INET 4.5. One of
// INET's goes against the standard and has a switch, own_frames_set_nav: that a station's own frames set its NAV, so
// that one whose RTS failed stays silent for as long as the exchange would have taken.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <vector>

#include "netsim/kernel/fetch.hpp"
#include "netsim/mac/contention.hpp"
#include "netsim/mac/dcf_parameters.hpp"
#include "netsim/mac/duplicate_filter.hpp"
#include "netsim/mac/network_interface.hpp"
#include "netsim/mac/outbox.hpp"
#include "netsim/mac/rate_control.hpp"
#include "netsim/mac/retry.hpp"
#include "netsim/phy/radio.hpp"

namespace netsim {

class alignas(64) Dcf final : public NetworkInterface, private RadioListener, private ContentionListener {
public:
    Dcf(Radio& radio, std::shared_ptr<const DcfParameters> parameters, std::uint64_t seed);
    Dcf(const Dcf&) = delete;
    Dcf& operator=(const Dcf&) = delete;

    void send(NodeId destination, Payload payload) override;
    void fetch(int step) const override {
        if (step == 0) {
            fetch_before(*this, nav_turn_);
        }
        radio_.fetch(step);
    }
    std::size_t longest_message_bytes() const override {
        return parameters_.config.mtu_bytes - datagram_bytes(0);
    }
    const MessageFates& message_fates() const override { return outbox_.message_fates(); }
    std::size_t queued_messages() const override { return outbox_.size(); }
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

    void channel_busy_changed(bool busy) override;
    void frame_received(const Transmission& transmission) override;
    void frame_corrupted() override;
    void transmission_ended() override;
    void fetch_for_corrupted_frame() const override { netsim::fetch(contention_); }
    void channel_granted() override;

    Simulator& simulator() const { return parameters_.simulator; }
    bool is_long(const Frame& frame) const {
        return frame.psdu_bytes >= parameters_.config.rts_threshold_bytes;
    }
    const Frame& in_progress() const { return *outbox_.in_progress(); }
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
    void finish(MessageFate fate);
    void contend_for_next();
    void addressed_here(const Frame& frame, const Mode& mode);
    void respond_after_sifs(Frame response, const Mode& mode);
    bool is_nav_set() const { return nav_end_ > simulator().now(); }
    void own_frame_ended(const Frame& frame);
    void set_nav(SimTime duration);
    bool is_channel_busy() const { return radio_.is_channel_busy() || is_nav_set(); }
    void await_end_of_nav();
    void update_contention();
    // Counts what made it busy from `since` on.
    void watch_channel(SimTime since);
    // Unless there is something to send or a backoff to count down.
    void stop_watching_channel();
    void transmit(std::shared_ptr<const Frame> frame, const Mode& mode);

    // First what every frame that is heard touches: one cache line, which the medium fetches ahead.
    const DcfParameters& parameters_;
    Radio& radio_;
    SimTime nav_end_ = SimTime::long_ago();
    bool watches_channel_ = false;  // and contention is told of it
    // Only then is contention told of a frame that is received well: it lies in another cache line.
    bool last_frame_was_broken_ = false;
    Exchange exchange_ = Exchange::none;
    Response response_ = Response::none;
    int attempts_ = 0;  // of those of the frame in progress on the air, the ones that failed

    // Then what a broadcast frame touches, when it is sent: three lines.
    EventHandle nav_event_;  // pending while the channel is watched
    Retry retry_;            // of the frame in progress
    Contention contention_;
    Outbox outbox_;  // its frame in progress was granted once, and is not finished yet

    Turn nav_turn_ = 0;  // of the event at the end of the NAV, since that was set
    std::shared_ptr<const DcfParameters> owned_parameters_;  // parameters_ again: keeps them alive
    std::unique_ptr<RateControl> rate_control_;
    std::vector<std::uint64_t>
        frames_by_mode_;  // unicast frames on the air, by their mode's place in the mode set, if the rate adapts
    DuplicateFilter duplicates_;

    std::shared_ptr<const Frame> rts_;  // on the air
    const Mode* data_mode_;             // of the frame in progress, a unicast; before the first: of none
    EventHandle answer_timeout_;

    std::shared_ptr<const Frame> response_frame_;
    const Mode* response_mode_ = nullptr;
};

}  // namespace netsim
