// The messages of ZigZag in JSON, byte for byte as in examples/zigzag/message.py.
#pragma once

#include <cstdint>
#include <string>
#include <variant>

#include "netsim/mac/frame.hpp"

namespace netsim::zigzag {

// Heartbeat of a UAV, broadcast.
struct UavHeartbeat {
    NodeId sender = 0;
    bool homeward = false;   // flies toward the ground station
    bool available = false;  // ready for an exchange

    bool operator==(const UavHeartbeat&) const = default;
};

// Heartbeat of the ground station, broadcast. The station takes all data.
struct GroundHeartbeat {
    NodeId sender = 0;

    bool operator==(const GroundHeartbeat&) const = default;
};

// One reading of a sensor.
struct SensorData {
    NodeId sender = 0;

    bool operator==(const SensorData&) const = default;
};

// The reply to a heartbeat: a request to exchange data and fly apart.
struct PairRequest {
    NodeId sender = 0;
    NodeId carrier = 0;      // which of the two gets all data
    std::int64_t given = 0;  // total handed to the receiver so far (see Custody)

    bool operator==(const PairRequest&) const = default;
};

// The reply to a PairRequest: the sender agrees and has done its part.
struct PairConfirmation {
    NodeId sender = 0;
    NodeId carrier = 0;
    std::int64_t given = 0;

    bool operator==(const PairConfirmation&) const = default;
};

using Message = std::variant<UavHeartbeat, GroundHeartbeat, SensorData, PairRequest, PairConfirmation>;

Payload encode(const Message& message);
// Throws SimulationError for a string that is not a ZigZag message.
Message decode(const std::string& text);

}  // namespace netsim::zigzag
