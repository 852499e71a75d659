// One radio: locks on to frames, decides whether they are decoded, and says whether the channel is busy.
//
//                 transmit()                       arrival ≥ sensitivity
//   TRANSMITTING <----------- LISTENING or LOCKED  <-------------------- LISTENING
//        |   end of the frame      ^  ^                                      |
//        +-------------------------+  +---- end of the arrival locked on <---+--> LOCKED
//
// Frames of other channels that overlap with its own, and those in formats that it does not know, never lock it: they are
// noise, and energy that makes the channel busy.
//
// Half duplex: what starts while it transmits is never received, and starting to transmit gives up a reception.
// There is no capture: locked on one frame, the radio takes all others for interference.
//
// That is the default. Options of the receiver put more between LISTENING and the end of a frame:
//
//                   arrival ≥ sensitivity                 preamble detected (phy/preamble_detection.hpp)
//        LISTENING -----------------------> DETECTING ------------------------------------------------> LOCKED
//          ^  ^  ^                           |  ^                                                      |  |  |
//          |  |  +------ not detected -------+  +---- stronger arrival (phy/frame_capture.hpp) --------+  |  |
//          |  +--------- PHY header lost, or the end of the arrival (SNIR by chunks: phy/reception.hpp) --+  |
//          +------------ end of the arrival locked on -------------------------------------------------------+
//
// DETECTING does not make the channel busy, and the energy of a frame counts only from the end of its detection: sensing
// takes as long. Without preamble detection, LOCKED takes its place in both arrows to it.
#pragma once

#include <memory>
#include <vector>

#include "netsim/kernel/fetch.hpp"
#include "netsim/kernel/random.hpp"
#include "netsim/medium/arrival.hpp"
#include "netsim/medium/medium.hpp"
#include "netsim/phy/modes.hpp"
#include "netsim/phy/present_arrivals.hpp"
#include "netsim/phy/radio_kind.hpp"
#include "netsim/phy/radio_observer.hpp"

namespace netsim {

// The side of a MAC that its radio speaks to. At the end of a frame, the frame is reported before the channel is free.
class RadioListener {
public:
    // Not while it was told to stop (Radio::stop_watching_channel).
    virtual void channel_busy_changed(bool busy) = 0;
    virtual void frame_received(const Transmission& transmission) = 0;
    // A frame that the radio had locked on to could not be decoded, or was given up for another one.
    virtual void frame_corrupted() = 0;
    // The next transmission cannot begin within it.
    virtual void transmission_ended() = 0;
    // frame_corrupted may well be next: has what that touches brought into the cache (kernel/fetch.hpp).
    virtual void fetch_for_corrupted_frame() const {}

protected:
    ~RadioListener() = default;
};

class alignas(64) Radio final : public MediumListener {
public:
    Radio(InterfaceId interface, std::shared_ptr<const RadioKind> kind, double tx_power_w,
          const Trajectory& trajectory, const Attitude& attitude = {},
          PpduFormats formats = PpduFormats::all());
    Radio(const Radio&) = delete;
    Radio& operator=(const Radio&) = delete;

    void set_listener(RadioListener& listener) { listener_ = &listener; }
    // Who is told of every frame sent and received from now on; nobody, if null.
    void set_observer(RadioObserver* observer) {
        observer_ = observer;
        is_observed_ = observer != nullptr;
    }
    InterfaceId interface() const { return InterfaceId::of_stream(stream_); }
    NodeId node() const { return interface().node; }
    RadioId id() const { return id_; }

    // Turns around to send: what comes before the end of the next transmission is not received. Only while not
    // transmitting. Radios that need no time for that go without.
    void turn_to_transmit();
    // Sends a frame now; only while not transmitting.
    void transmit(std::shared_ptr<const Frame> frame, FrameLabel label, int psdu_bytes, const Mode& mode,
                  SimTime duration);

    // A radio tells of its channel from the start, and what it says includes frames that only together make it busy. A MAC
    // that need not know that for a while saves much of the cost of a large network by telling it to stop. When it begins again, it
    // learns when the channel was busy for the last time, if that is over: by frames that only together made it busy, not
    // before `since`; long ago if it never was.
    SimTime watch_channel(SimTime since) {
        tells_of_channel_ = true;
        watches_energy_ = true;
        return std::max(free_since_, may_ignore_energy() && !transmitting_ ? medium().watch_energy(id_, since)
                                                                           : SimTime::long_ago());
    }
    void stop_watching_channel() {
        tells_of_channel_ = false;
        if (watches_energy_ && may_ignore_energy()) {
            medium().stop_watching_energy(id_);
        }
        watches_energy_ = false;
    }
    // Tells of its channel again, but only what it hears of anyway: what frames do to it one by one.
    void tell_of_channel() { tells_of_channel_ = true; }
    // How far back watch_channel may ask.
    void remember_channel(SimTime duration) { medium().remember(duration); }
    // At the end of a frame that was received broken: whether the others on the air are too weak to make the channel busy
    // together.
    bool are_others_weak() const { return others_are_weak_; }

    // It will probably send soon (NetworkInterface::fetch).
    void fetch(int step) const {
        if (step == 0) {
            fetch_before(*this, owned_kind_);
        } else {
            medium().fetch_sender(id_);
        }
    }

    bool is_transmitting() const { return transmitting_; }
    bool is_receiving() const { return present_.is_locked(); }
    // Transmitting, locked on a frame, or noise and all arrivals together reach the energy detection level.
    bool is_channel_busy() const { return busy_; }

    void arrival_started(const Arrival& arrival) override;
    void arrival_ended(const Arrival& arrival) override;

private:
    struct Candidate {  // a frame whose beginning is being listened to
        Arrival arrival;
        EventHandle detection;
    };

    Medium& medium() const { return kind_.medium; }
    Simulator& simulator() const { return medium().simulator(); }
    bool detects_preambles() const { return kind_.preamble_detection.is_on(); }
    // One that detects preambles leaves out of its sums what the medium cannot know: it is told of energy all the time.
    bool may_ignore_energy() const { return !detects_preambles(); }
    void begin_reception(const Arrival& arrival);
    std::vector<Candidate>::iterator candidate_of(const Transmission* transmission);
    bool is_candidate(const Transmission* transmission) {
        return detects_preambles() && candidate_of(transmission) != candidates_.end();
    }
    void end_detection(const Transmission* transmission);
    void drop_candidates(FrameFate fate);
    void lock_on(const Arrival& arrival);
    void give_up_reception();
    void end_header();
    void end_reception(const Arrival& arrival);
    void end_report();
    double draw() { return RandomStream(kind_.seed, stream_, Purpose::reception, drawn_++).uniform(); }
    // Both draw, and find interferers only if interference is to blame.
    FrameFate decide_at_once(const Arrival& arrival, const std::vector<NodeId>*& interferers);
    FrameFate decide_data(const Arrival& arrival, const std::vector<NodeId>*& interferers);
    bool header_survives();
    InterferenceSum& interference_in(const Arrival& arrival, Period period) {
        return medium().interference_with(id_, arrival, period.start, period.end);
    }
    void add_to_fingerprint(const Transmission& transmission, FrameFate fate);
    void book(const Transmission& transmission, FrameFate fate);
    void transmission_over();
    void update_busy();

    // First what an arrival touches: one cache line. In a large network it is in no cache, so the medium has it
    // fetched ahead (Links::fetch_touched).
    [[no_unique_address]] PresentArrivals present_;  // the bits below lie in its padding
    bool transmitting_ : 1 = false;
    bool turned_ : 1 = false;  // to transmit, which it does not yet
    bool busy_ : 1 = false;
    bool reports_ : 1 = false;  // the end of a frame, before its channel may be free
    bool is_observed_ : 1 = false;
    bool others_are_weak_ : 1 = false;
    bool tells_of_channel_ : 1 = true;
    bool watches_energy_ : 1 = true;  // but while it transmits
    std::uint32_t stream_;            // of its interface (InterfaceId)
    const RadioKind& kind_;
    RadioListener* listener_ = nullptr;
    SimTime free_since_ = SimTime::long_ago();  // its channel, if it is
    std::uint64_t drawn_ = 0;                   // numbers that decide about receptions

    RadioId id_ = 0;
    double tx_power_w_;
    RadioObserver* observer_ = nullptr;
    std::shared_ptr<const RadioKind> owned_kind_;  // kind_ again: keeps it alive
    Arrival locked_arrival_;             // if locked on, for the options that ask for it before its end
    std::vector<Candidate> candidates_;  // none without preamble detection
    EventHandle header_end_;             // SNIR by chunks: pending until the header is decided
};

}  // namespace netsim
