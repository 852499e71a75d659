// The options of a receiver: preamble detection, frame capture, and SNIR by chunks. They add steps
// between LISTENING and the end of a frame (the default is in phy/radio.hpp):
//
//                   arrival ≥ sensitivity                 preamble detected (phy/preamble_detection.hpp)
//        LISTENING -----------------------> DETECTING ------------------------------------------------> LOCKED
//          ^  ^  ^                           |  ^                                                      |  |  |
//          |  |  +------ not detected -------+  +---- stronger arrival (phy/frame_capture.hpp) --------+  |  |
//          |  +--------- PHY header lost, or the end of the arrival (SNIR by chunks: phy/reception.hpp) --+  |
//          +------------ end of the arrival locked on -------------------------------------------------------+
//
// In DETECTING, the energy of a frame does not count yet, since sensing takes as long. Without
// preamble detection, both arrows to DETECTING lead to LOCKED.
//
// A radio has this object only if one of the options is on. It is a part of the radio: the radio
// calls it at each step that an option can change, and it acts on the radio's state.
#pragma once

#include <vector>

#include "netsim/kernel/event_queue.hpp"
#include "netsim/medium/arrival.hpp"
#include "netsim/medium/interference.hpp"
#include "netsim/phy/radio.hpp"
#include "netsim/phy/radio_model.hpp"
#include "netsim/trace/frame_outcomes.hpp"

namespace netsim {

class ReceiverOptions {
public:
    static bool are_on(const RadioModel& model) {
        return model.preamble_detection.is_on() || model.frame_capture.is_on() || model.by_chunks;
    }

    explicit ReceiverOptions(Radio& radio) : radio_(radio) {}

    // Starts to listen to the frame: detects its preamble, or locks on at once.
    void begin_reception(const Arrival& arrival);
    // Whether the radio gives up the frame that it is locked on to, for a later one.
    bool captures(const Arrival& later);
    // A frame began while the radio transmitted.
    void missed_a_frame() { ignores_energy_ = false; }
    // The radio stops to receive.
    void give_up(FrameOutcome outcome);
    // Of a frame that the radio is not locked on to.
    void arrival_ended(const Arrival& arrival);
    // SNIR by chunks: decides the rest of the frame that the radio was locked on to. Draws random
    // numbers, and sets `cause` only if the frame was lost to interference.
    FrameOutcome decide_data(const Arrival& arrival, InterferenceSum*& cause);

    // SNIR by chunks: whether the PHY header is not decided yet.
    bool awaits_header() const;
    // Whether the energy of that frame does not count yet.
    bool is_in_detection(const Transmission* transmission) {
        return find(transmission) != in_detection_.end();
    }
    // PreambleDetection::frees_channel.
    bool ignores_energy() const { return ignores_energy_; }

private:
    struct Detection {
        Arrival arrival;
        EventHandle end;
    };

    std::vector<Detection>::iterator find(const Transmission* transmission);
    void end_detection(const Transmission* transmission);
    bool is_detected(const Arrival& arrival);
    void stop_detections(FrameOutcome outcome);
    void lock_on(const Arrival& arrival);
    void end_header();
    // Fills in the interference with the header. Valid until the medium is asked for another one.
    bool header_survives(InterferenceSum*& interference);
    // Always false without PreambleDetection::frees_channel.
    bool is_receiving_header() const;

    Radio& radio_;
    std::vector<Detection> in_detection_;  // empty without preamble detection
    Arrival locked_;                       // while the radio is locked on
    EventHandle header_end_;               // SNIR by chunks: pending until the header is decided
    bool began_in_header_ = false;         // another frame, while this radio received a header
    bool ignores_energy_ = false;
};

}  // namespace netsim
