// Chooses the mode of each attempt to send a unicast frame, from what became of earlier ones. Used by the Dcf.
//
// A station knows of a frame only whether its ACK came back, so that a collision looks to it like a weak signal. What
// it learns it keeps for each destination apart (INET: for the station, so that a far neighbour slows the near ones
// down). RTS, CTS, ACK and broadcast frames are none of its business.
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
    int number = 0;  // of times that the frame was on the air before
};

class RateControl {
public:
    virtual ~RateControl() = default;

    // Of the attempt that comes next: asked when the channel is granted, before an RTS. An attempt whose RTS fails is
    // asked for again, and neither of the two below is called for it.
    virtual const Mode& mode_for(const RateAttempt& attempt, SimTime now) = 0;
    // What became of it. After `failed` comes the next attempt, or the frame is given up if that was the last.
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

// The mode of the first frame to a destination. Throws ConfigError for a bitrate that the operation mode has not.
const Mode& initial_mode(const MacConfig& config);

// The one of MacConfig::rate_control, for the station of `interface`.
std::unique_ptr<RateControl> make_rate_control(const MacConfig& config, std::uint64_t seed,
                                               InterfaceId interface);

}  // namespace netsim
