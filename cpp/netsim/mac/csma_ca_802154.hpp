// An 802.15.4 device in a network without beacons: unslotted CSMA/CA.
//
// It sends the frames of its queue one by one: random backoff, clear channel assessment (CCA),
// turnaround, transmission. If an ACK is requested, it retries until it receives one, up to a limit.
// It acknowledges received frames and drops duplicates.
//
//   IDLE --frame in the queue--> BACKING_OFF --time is up--> ASSESSING --free--> TURNING --turnaround--> SENDING
//    ^                            ^   ^                        |  |                                     |     |
//    |                            |   +-- busy: wait again <---+  +-- busy too often: given up --+      |     |
//    |                            |                                                              |      |     |
//    |                            |            end of a broadcast, or of a frame without ACK: done <----+     |
//    |                            |                                                              |            |
//    |                            +-- time-out: repeat -- AWAITING_ACK <----- end of a frame with ACK --------+
//    |                                                      |                                    |
//    |                                                      +-- ACK: done, or given up ----------+
//    |                                                                                           |
//    +--------------------- queue empty (otherwise: BACKING_OFF for the next frame) <------------+
//
// A unicast frame received in IDLE, BACKING_OFF or ASSESSING is acknowledged: WAITING_SIFS -->
// SENDING_ACK. Then the device backs off again for its own frame, which keeps its count of failed
// assessments. A unicast frame received in AWAITING_ACK is accepted without an ACK. From the start of
// a turnaround until the frame or ACK has been sent, the radio cannot receive. Only in ASSESSING does
// the device need to know whether frames make the channel busy together.
//
// Source: IEEE Std 802.15.4-2006, 7.5.1.4 (CSMA-CA algorithm), 7.5.6.4 (acknowledgments). Where the
// standard leaves room, the choices are those of INET 4.5, with four differences. A frame is dropped
// after its last failed assessment even if it was never on the air; INET starts over. A frame that
// arrives at the instant at which an assessment ends makes the channel busy. INET has neither
// cca_whole_window nor lifs_s. (The latter is 7.5.1.3; as in ns-3, the backoff begins at its end.)
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>

#include "netsim/config/csma_config.hpp"
#include "netsim/kernel/prefetch.hpp"
#include "netsim/kernel/random.hpp"
#include "netsim/mac/duplicate_filter.hpp"
#include "netsim/mac/frame_802154.hpp"
#include "netsim/mac/network_interface.hpp"
#include "netsim/mac/transmit_queue.hpp"
#include "netsim/phy/radio.hpp"

namespace netsim {

// How the longest wait grows when the channel is busy (CsmaConfig::backoff_method).
enum class BackoffMethod : std::uint8_t { exponential, linear, constant };

class CsmaCa802154 final : public NetworkInterface, private RadioListener {
public:
    CsmaCa802154(Simulator& simulator, Radio& radio, const CsmaConfig& config, std::uint64_t seed);
    CsmaCa802154(const CsmaCa802154&) = delete;
    CsmaCa802154& operator=(const CsmaCa802154&) = delete;

    void send(NodeId destination, Payload payload, CauseId cause) override;
    void prefetch(int step) const override {
        if (step == 0) {
            netsim::prefetch(*this);
        }
        radio_.prefetch(step);
    }
    std::size_t longest_message_bytes() const override { return narrowband_mtu_bytes - datagram_bytes(0); }
    const MessageOutcomes& message_outcomes() const override { return queue_.message_outcomes(); }
    std::size_t queued_messages() const override { return queue_.size(); }

private:
    enum class State {
        idle,
        backing_off,
        assessing,
        turning,
        sending,
        awaiting_ack,
        waiting_sifs,
        sending_ack,
    };

    void channel_busy_changed(bool busy) override;
    void frame_received(const Transmission& transmission) override;
    void frame_corrupted(CorruptedFrame /*frame*/) override {}
    void transmission_ended() override;

    void go_on();
    void back_off();
    int backoff_periods();
    void assess();
    void assessed();
    void channel_is_busy();
    void transmit(std::shared_ptr<const Frame> frame);
    void ack_timed_out();
    void begin_next();
    void fail(MessageOutcome outcome);
    void finish(MessageOutcome outcome);
    void unicast_received(const Frame& frame);
    void acknowledge(const Frame& frame);

    Simulator& simulator_;
    Radio& radio_;
    CsmaConfig config_;
    BackoffMethod backoff_method_;
    SimTime unit_backoff_;
    SimTime cca_;
    SimTime turnaround_;
    SimTime sifs_;
    SimTime lifs_;
    SimTime ack_wait_;
    RandomStream draws_;

    TransmitQueue queue_;  // its frame in progress was sent, or is about to be sent
    DuplicateFilter duplicates_;
    State state_ = State::idle;
    EventHandle timer_;                 // of the current state
    std::shared_ptr<const Frame> ack_;  // to be sent after SIFS
    SimTime earliest_wait_;             // no backoff begins before this
    int failed_assessments_ = 0;        // of the current attempt
    int retries_ = 0;                   // of the frame in progress
    bool interrupted_by_ack_ = false;   // whether an ACK interrupted the current attempt
    bool was_busy_ = false;             // whether the channel was busy during the assessment
};

}  // namespace netsim
