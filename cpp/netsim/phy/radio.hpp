// One radio: it locks on to frames, decides whether they are decoded, and reports whether the
// channel is busy.
//
//                 transmit()                       arrival ≥ sensitivity
//   TRANSMITTING <----------- LISTENING or LOCKED  <-------------------- LISTENING
//        |   end of the frame      ^  ^                                      |
//        +-------------------------+  +---- end of the arrival locked on <---+--> LOCKED
//
// The radio does not lock on to frames of overlapping channels or of formats that it does not know.
// They count as interference, and as energy that makes the channel busy.
//
// Half duplex: a frame that starts while the radio transmits is not received, and starting to
// transmit aborts a reception. Without capture, all other frames are interference while the radio
// is locked on to one.
//
// That is the default. Receiver options add steps between LISTENING and the end of a frame
// (phy/receiver_options.hpp).
#pragma once

#include <algorithm>
#include <cstdint>
#include <memory>

#include "netsim/kernel/prefetch.hpp"
#include "netsim/kernel/random.hpp"
#include "netsim/medium/arrival.hpp"
#include "netsim/medium/medium.hpp"
#include "netsim/phy/modes.hpp"
#include "netsim/phy/present_arrivals.hpp"
#include "netsim/phy/radio_model.hpp"
#include "netsim/phy/radio_observer.hpp"

namespace netsim {

class ReceiverOptions;  // phy/receiver_options.hpp

// How a frame that a radio was locked on to was lost.
struct CorruptedFrame {
    bool header_lost = false;  // the PHY header, before the end of the frame (SNIR by chunks)
    // The other frames on the air are too weak to make the channel busy together.
    bool others_are_weak = false;
};

// What a radio reports of its channel.
enum class ChannelWatch : std::uint8_t {
    off,
    reporting,  // its state, but without frames that make it busy only together
    watching    // its state
};

// The side of a MAC that its radio notifies. At the end of a frame, the radio reports the frame
// first, then the free channel.
class RadioListener {
public:
    // Not called after Radio::stop_watching_channel.
    virtual void channel_busy_changed(bool busy) = 0;
    virtual void frame_received(const Transmission& transmission) = 0;
    // A frame that the radio was locked on to could not be decoded, or was dropped for a stronger
    // one.
    virtual void frame_corrupted(CorruptedFrame frame) = 0;
    // The next transmission must not begin within this call.
    virtual void transmission_ended() = 0;
    // frame_corrupted may be called next: prefetches what it reads (kernel/prefetch.hpp).
    virtual void prefetch_for_corrupted_frame() const {}

protected:
    ~RadioListener() = default;
};

class alignas(64) Radio final : public MediumListener {
public:
    Radio(InterfaceId interface, std::shared_ptr<const RadioModel> model, double tx_power_w,
          const Trajectory& trajectory, const Attitude& attitude = {},
          PpduFormats formats = PpduFormats::all());
    Radio(const Radio&) = delete;
    Radio& operator=(const Radio&) = delete;
    ~Radio();

    void set_listener(RadioListener& listener) { listener_ = &listener; }
    // Sets the observer of all frames sent and received from now on; null for none.
    void set_observer(RadioObserver* observer) {
        observer_ = observer;
        is_observed_ = observer != nullptr;
    }
    InterfaceId interface() const { return InterfaceId::of_stream(stream_); }
    NodeId node() const { return interface().node; }
    RadioId id() const { return id_; }
    Simulator& simulator() const { return medium().simulator(); }

    // Starts the turnaround to transmit mode: frames that arrive before the end of the next
    // transmission are not received. Only while not transmitting.
    void turn_to_transmit();
    // Sends a frame now. Only while not transmitting.
    void transmit(std::shared_ptr<const Frame> frame, FrameLabel label, int psdu_bytes, const Mode& mode,
                  SimTime duration);

    // Starts reporting the channel state, including frames that make the channel busy only together.
    // Initially on. In a large network, a MAC saves much time if it stops the reports while it does
    // not need them. Returns when the channel last became free; long ago if it never did. Frames that
    // made it busy only together count only after `since`.
    SimTime watch_channel(SimTime since) {
        watch_ = ChannelWatch::watching;
        return std::max(free_since_, transmitting_ ? SimTime::long_ago() : watch_energy(since));
    }
    void stop_watching_channel() {
        stop_watching_energy();
        watch_ = ChannelWatch::off;
    }
    // Reports the channel state again, if it is not watched, but without frames that make it busy only together.
    void report_channel() {
        if (watch_ == ChannelWatch::off) {
            watch_ = ChannelWatch::reporting;
        }
    }
    bool watches_channel() const { return watch_ == ChannelWatch::watching; }
    // Sets how far back `since` of watch_channel may be.
    void remember_channel(SimTime duration) { medium().remember(duration); }

    // The radio will probably send soon (NetworkInterface::prefetch).
    void prefetch(int step) const {
        if (step == 0) {
            prefetch_before(*this, owned_model_);
        } else {
            medium().prefetch_sender(id_);
        }
    }

    bool is_transmitting() const { return transmitting_; }
    bool is_receiving() const { return present_.is_locked(); }
    // The same without the PHY header, where that is decided separately (SNIR by chunks).
    bool is_receiving_data() const;
    // Whether the radio transmits, is locked on to a frame, or noise and all arrivals together reach
    // the ED threshold.
    bool is_channel_busy() const { return busy_; }

    void arrival_started(const Arrival& arrival) override;
    void arrival_ended(const Arrival& arrival) override;

private:
    friend class ReceiverOptions;  // a part of the radio in a file of its own

    Medium& medium() const { return model_.medium; }
    // Energy of frames that make the channel busy only together. With preamble detection, the radio's
    // sums leave out frames in detection, which the medium does not know. So the radio always watches it.
    bool may_ignore_energy() const { return !model_.preamble_detection.is_on(); }
    SimTime watch_energy(SimTime since) {
        return may_ignore_energy() ? medium().watch_energy(id_, since) : SimTime::long_ago();
    }
    void stop_watching_energy() {
        if (watches_channel() && may_ignore_energy()) {
            medium().stop_watching_energy(id_);
        }
    }
    void begin_reception(const Arrival& arrival);
    void give_up_reception();
    void end_reception(const Arrival& arrival);
    void end_report();
    double draw() { return RandomStream(model_.seed, stream_, Purpose::reception, drawn_++).uniform(); }
    // Draws a random number, and sets `cause` only if the frame was lost to interference.
    FrameOutcome decide(const Arrival& arrival, InterferenceSum*& cause);
    void book_loss(const Arrival& arrival, FrameOutcome outcome, InterferenceSum* interference);
    // Tells the observer of a loss, if there is one. `interference` may be null.
    void tell_loss(const Arrival& arrival, FrameOutcome outcome, InterferenceSum* interference);
    // Other frames and other systems.
    InterferenceSum& interference_in(const Arrival& arrival, Period period) {
        InterferenceSum& sum = medium().interference_with(id_, arrival, period.start, period.end);
        medium().other_systems().add_to(sum, stream_, period.start, period.end);
        return sum;
    }
    // The most that other systems add to the noise during the frame, in W.
    double other_systems_w(const Arrival& arrival) const {
        return medium().other_systems().max_w(stream_, arrival.start, arrival.end);
    }
    void add_to_fingerprint(const Transmission& transmission, FrameOutcome outcome);
    void book(const Transmission& transmission, FrameOutcome outcome);
    void transmission_over();
    void update_busy();

    // The members that an arrival reads come first: one cache line, which the medium prefetches
    // (Links::prefetch_targets).
    [[no_unique_address]] PresentArrivals present_;  // its padding holds the bits below
    bool transmitting_ : 1 = false;
    bool turned_ : 1 = false;  // turnaround to transmit has started
    bool busy_ : 1 = false;
    bool reports_ : 1 = false;  // while it reports the end of a frame: the channel counts as busy
    bool is_observed_ : 1 = false;
    const bool has_options_ : 1;
    ChannelWatch watch_ : 2 = ChannelWatch::watching;
    std::uint32_t stream_;  // of its interface (InterfaceId)
    const RadioModel& model_;
    RadioListener* listener_ = nullptr;
    SimTime free_since_ = SimTime::long_ago();  // when the channel became free, if it is
    std::uint64_t drawn_ = 0;                   // random numbers drawn for receptions

    RadioId id_ = 0;
    double tx_power_w_;
    RadioObserver* observer_ = nullptr;
    std::shared_ptr<const RadioModel> owned_model_;  // keeps model_ alive
    std::unique_ptr<ReceiverOptions> options_;       // null without options
};

}  // namespace netsim
