// Rate control: chooses the mode of each attempt to send a unicast frame by the outcomes of earlier
// attempts. Used by the Dcf.
//
// A station knows only whether it received an ACK, so a collision looks like a weak signal. State is
// kept per destination. (INET keeps it per station, so that a distant neighbor slows down the frames
// to near ones.) RTS, CTS, ACK and broadcast frames are not affected.
#pragma once

#include <cstdint>
#include <memory>

#include "netsim/config/mac_config.hpp"
#include "netsim/interface_id.hpp"
#include "netsim/kernel/sim_time.hpp"
#include "netsim/mac/frame.hpp"
#include "netsim/phy/modes.hpp"

namespace netsim {

struct RateAttempt {
    NodeId destination = 0;
    int psdu_bytes = 0;
    int number = 0;  // of earlier attempts in which the frame was on the air
};

class RateControl {
public:
    virtual ~RateControl() = default;

    // The mode of the next attempt. Called when the channel is granted, before an RTS. If the RTS
    // fails, it is called again for the same attempt, without a call of `succeeded` or `failed`.
    virtual const Mode& mode_for(const RateAttempt& attempt, SimTime now) = 0;
    // Report the outcome of the attempt. After `failed`, the next attempt follows, or the frame is
    // dropped.
    virtual void succeeded(const RateAttempt& attempt, const Mode& mode, SimTime now) = 0;
    virtual void failed(const RateAttempt& attempt, const Mode& mode, SimTime now) = 0;
};

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

// Creates the rate control named by MacConfig::rate_control, for the station of `interface`.
std::unique_ptr<RateControl> make_rate_control(const MacConfig& config, std::uint64_t seed,
                                               InterfaceId interface);

}  // namespace netsim
