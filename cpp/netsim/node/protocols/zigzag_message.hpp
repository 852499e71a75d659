// The messages of ZigZag, and their form on the air: the JSON texts of examples/zigzag/message.py, byte for byte.
#pragma once

#include <cstdint>
#include <string>
#include <variant>

#include "netsim/mac/frame.hpp"

namespace netsim::zigzag {

// Broadcast by a UAV: I am here.
struct UavHeartbeat {
    NodeId sender = 0;
    bool homeward = false;   // flies towards the ground station
    bool available = false;  // does not ignore the other UAVs and the ground station

    bool operator==(const UavHeartbeat&) const = default;
};

// Broadcast by the ground station: I am here, and I take everything.
struct GroundHeartbeat {
    NodeId sender = 0;

    bool operator==(const GroundHeartbeat&) const = default;
};

// One reading of a sensor.
struct SensorData {
    NodeId sender = 0;

    bool operator==(const SensorData&) const = default;
};

// The answer to a heartbeat: let us exchange our data and fly apart.
struct PairRequest {
    NodeId sender = 0;
    NodeId carrier = 0;      // the one of the two that gets all data
    std::int64_t given = 0;  // what the sender has handed to the receiver so far, in all (see Custody)

    bool operator==(const PairRequest&) const = default;
};

// The answer to a PairRequest: agreed, and done on my side.
struct PairConfirmation {
    NodeId sender = 0;
    NodeId carrier = 0;
    std::int64_t given = 0;

    bool operator==(const PairConfirmation&) const = default;
};

using Message = std::variant<UavHeartbeat, GroundHeartbeat, SensorData, PairRequest, PairConfirmation>;

Payload encode(const Message& message);
// Throws SimulationError for a text that is no message of ZigZag.
Message decode(const std::string& text);

}  // namespace netsim::zigzag
