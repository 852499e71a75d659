// Networks of the benchmarks: nodes stand or fly in a square with 100 nodes per square kilometer.
// Each has 2 mW, so that about 20 nodes receive a frame. Each broadcasts 100 B once a second, at
// its own phase within `spread_s`.
#pragma once

#include <cstdint>
#include <memory>

#include "netsim/node/network.hpp"

// Initialized, at time 0. At a speed above 0 the nodes fly from place to place. A bitrate of -1 bps
// is the default bitrate. Each seed has its own places and phases.
std::unique_ptr<netsim::Network> make_beacon_network(std::int64_t nodes, double speed_mps, double bitrate_bps,
                                                     double spread_s = 1, std::uint64_t seed = 1);
