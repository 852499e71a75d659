// The time that a message takes without a MAC: the airtime of its frame in the format of the interface, or none.
//
// No rate control, RTS or fragmentation. A unicast frame occupies the channel until the end of its
// ACK, if ACKs are used.
#pragma once

#include <string_view>

#include "netsim/config/interface_config.hpp"
#include "netsim/kernel/sim_time.hpp"
#include "netsim/mac/frame.hpp"
#include "netsim/phy/modes.hpp"

namespace netsim {

class IdealTiming {
public:
    // `timing`: MediumConfig::timing. Throws ConfigError for a bitrate that the operation mode does
    // not have.
    IdealTiming(std::string_view timing, const InterfaceConfig& config);

    bool is_instant() const { return is_instant_; }
    // Whether a node sends one frame after the other.
    bool has_queue() const { return senses_channel_ || collides_; }
    // Whether it waits until the channel is free around it, too.
    bool senses_channel() const { return senses_channel_; }
    bool collides() const { return collides_; }
    // Of a unicast frame.
    int most_attempts() const { return most_attempts_; }
    int queue_capacity() const { return queue_capacity_; }
    // Whether messages wait in front of a full queue.
    bool blocks() const { return blocks_; }

    const Mode& mode(FrameKind kind) const { return kind == FrameKind::broadcast ? *broadcast_ : *unicast_; }
    // Length of the PSDU in bytes, with MAC, IP and UDP headers.
    int psdu_bytes(int payload_bytes) const;
    SimTime airtime(FrameKind kind, int psdu_bytes) const;
    // From the end of a data frame to the end of its exchange: SIFS and the ACK of a unicast frame.
    SimTime response(FrameKind kind) const {
        return kind == FrameKind::broadcast || is_instant_ ? SimTime{} : response_;
    }
    // Between two exchanges: DIFS, or the LIFS of 802.15.4.
    SimTime gap() const { return gap_; }

private:
    bool is_instant_;
    bool senses_channel_;
    bool collides_;
    bool is_802154_;
    int queue_capacity_;
    bool blocks_;
    int most_attempts_;
    const Mode* broadcast_;
    const Mode* unicast_;
    SimTime response_;
    SimTime gap_;
};

}  // namespace netsim
