// The networks of the benchmarks: nodes that stand or fly in a square with 100 of them to each
// square kilometre, with 2 mW each, so that about 20 hear a frame; each broadcasts 100 B once a
// second, at a phase of its own within `spread_s`.
#pragma once

#include <cstdint>
#include <memory>

#include "netsim/node/network.hpp"

// Initialized, at time 0. At a speed above 0 the nodes fly from place to place; -1 bps is the
// bitrate by default. Each seed has places and phases of its own.
std::unique_ptr<netsim::Network> make_beacon_network(std::int64_t nodes, double speed_mps, double bitrate_bps,
                                                     double spread_s = 1, std::uint64_t seed = 1);
