// What all nodes of one network have around them: its clock, how many they are, and what is noted of all of them together.
#pragma once

#include <cstdint>

#include "netsim/kernel/fingerprint.hpp"
#include "netsim/kernel/simulator.hpp"
#include "netsim/node/filler.hpp"
#include "netsim/node/payload_hash.hpp"
#include "netsim/trace/message_delays.hpp"

namespace netsim {

struct Surroundings {
    Simulator& simulator;
    Fingerprint& fingerprint;
    PayloadHash payload_hash{};
    MessageDelays message_delays{};
    Filler filler{};
    std::int32_t node_count = 0;
};

}  // namespace netsim
