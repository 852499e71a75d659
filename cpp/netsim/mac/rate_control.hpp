// Rate control: chooses the mode of each attempt to send a unicast frame, by the outcomes of
// earlier ones. Used by the Dcf.
//
// A station knows only whether an ACK came back, so a collision looks like a weak signal. State is
// kept per destination. (INET keeps it per station, so that a far neighbor slows down the near
// ones.) RTS, CTS, ACK and broadcast frames are not affected.
#pragma once

#include <cstdint>
#include <memory>

#include "netsim/config/mac_config.hpp"
#include "netsim/interface_id.hpp"
#include "netsim/kernel/sim_time.hpp"
#include "netsim/mac/frame.hpp"
#include "netsim/phy/modes.hpp"

namespace netsim {

// One attempt to send a frame.
struct RateAttempt {
    NodeId destination = 0;
    int psdu_bytes = 0;
    int number = 0;  // earlier attempts of the frame on the air
};

class RateControl {
public:
    virtual ~RateControl() = default;

    // The mode of the next attempt. Called when the channel is granted, before an RTS. If the RTS
    // fails, it is called again for the same attempt, without a call of the two functions below.
    virtual const Mode& mode_for(const RateAttempt& attempt, SimTime now) = 0;
    // The outcome of the attempt. After `failed` comes the next attempt, or the frame is dropped.
    virtual void succeeded(const RateAttempt& attempt, const Mode& mode, SimTime now) = 0;
    virtual void failed(const RateAttempt& attempt, const Mode& mode, SimTime now) = 0;
};

// All frames in one mode.
class FixedRateControl final : public RateControl {
public:
    explicit FixedRateControl(const Mode& mode) : mode_(mode) {}

    const Mode& mode_for(const RateAttempt&, SimTime) override { return mode_; }
    void succeeded(const RateAttempt&, const Mode&, SimTime) override {}
    void failed(const RateAttempt&, const Mode&, SimTime) override {}

private:
    const Mode& mode_;
};

// The mode of the first frame to a destination. Throws ConfigError for a bitrate that the operation
// mode does not have.
const Mode& initial_mode(const MacConfig& config);

// The rate control named by MacConfig::rate_control, for the station of `interface`.
std::unique_ptr<RateControl> make_rate_control(const MacConfig& config, std::uint64_t seed,
                                               InterfaceId interface);

}  // namespace netsim
