// One radio: locks on to frames, decides whether they are decoded, and says whether the channel is busy.
//
//                 transmit()                       arrival ≥ sensitivity
//   TRANSMITTING <----------- LISTENING or LOCKED  <-------------------- LISTENING
//        |   end of the frame      ^  ^                                      |
//        +-------------------------+  +---- end of the arrival locked on <---+--> LOCKED
//
// Half duplex: what starts while it transmits is never received, and starting to transmit gives up a reception.
// There is no capture: locked on one frame, the radio takes all others for interference.
#pragma once

#include <memory>
#include <vector>

#include "netsim/config/radio_config.hpp"
#include "netsim/kernel/random.hpp"
#include "netsim/medium/antenna_pattern.hpp"
#include "netsim/medium/medium.hpp"
#include "netsim/phy/error_rate.hpp"
#include "netsim/phy/modes.hpp"
#include "netsim/phy/radio_observer.hpp"

namespace netsim {

// The side of a MAC that its radio speaks to. At the end of a frame, the frame is reported before the channel is free.
class RadioListener {
public:
    virtual void channel_busy_changed(bool busy) = 0;
    virtual void frame_received(const Transmission& transmission) = 0;
    // A frame that the radio had locked on to could not be decoded.
    virtual void frame_corrupted() = 0;
    virtual void transmission_ended() = 0;

protected:
    ~RadioListener() = default;
};

class Radio final : public MediumListener {
public:
    Radio(Simulator& simulator, Medium& medium, const RadioConfig& config, const Trajectory& trajectory,
          std::uint64_t seed, FrameFates& fates, Fingerprint& fingerprint, const Attitude& attitude = {});
    Radio(const Radio&) = delete;
    Radio& operator=(const Radio&) = delete;

    void set_listener(RadioListener& listener) { listener_ = &listener; }
    // Who is told of every frame sent and received from now on; nobody, if null.
    void set_observer(RadioObserver* observer) { observer_ = observer; }
    NodeId id() const { return id_; }

    // Turns around to send: what comes before the end of the next transmission is not received. Only while not
    // transmitting. Radios that need no time for that go without.
    void turn_to_transmit();
    // Sends a frame now; only while not transmitting.
    void transmit(std::shared_ptr<const Frame> frame, FrameLabel label, int psdu_bytes, const Mode& mode,
                  SimTime duration);

    bool is_transmitting() const { return transmitting_; }
    bool is_receiving() const { return locked_ != nullptr; }
    // Transmitting, locked on a frame, or noise and all arrivals together reach the energy detection level.
    bool is_channel_busy() const { return busy_; }

    void arrival_started(const Arrival& arrival) override;
    void arrival_ended(const Arrival& arrival) override;

private:
    struct Present {  // an arrival that lasts
        const Transmission* transmission;
        double power_w;
    };

    bool decide(const Arrival& arrival, const Interference& interference, FrameFate& fate);
    void book(const Transmission& transmission, FrameFate fate);
    void give_up_reception();
    void transmission_over();
    void update_busy();

    Simulator& simulator_;
    Medium& medium_;
    RadioConfig config_;
    const ErrorModel& error_model_;
    std::unique_ptr<const AntennaPattern> antenna_;  // null: isotropic
    FrameFates& fates_;
    Fingerprint& fingerprint_;
    RadioListener* listener_ = nullptr;
    RadioObserver* observer_ = nullptr;
    NodeId id_;
    RandomStream reception_draws_;
    std::vector<Present> present_;
    const Transmission* locked_ = nullptr;
    bool transmitting_ = false;
    bool turned_ = false;  // to transmit, which it does not yet
    bool busy_ = false;
};

}  // namespace netsim
