// The modes of responses: of the ACK or CTS that follows a frame.
//
// A cell has a set of basic bitrates, which all its stations know. The response has the fastest one that
// is not faster than the frame and has its format. If there is none, the same rule holds among the
// mandatory bitrates, which are also the set of a station without one. All durations that include a
// response follow: duration fields, time-outs, the attempts of Minstrel. EIFS does not: its ACK always has
// the slowest mandatory bitrate (IEEE 802.11-2020, 10.3.7).
//
// Source: IEEE 802.11-2020, 10.6.6.5.2. That a response has the modulation of its frame: IEEE 802.11-2007,
// 9.6.
#pragma once

#include <vector>

#include "netsim/config/mac_config.hpp"
#include "netsim/phy/modes.hpp"

namespace netsim {

class ResponseModes {
public:
    // Throws ConfigError for a basic bitrate that the operation mode does not have.
    explicit ResponseModes(const MacConfig& config);

    // The mode of the response to a frame in mode `received`.
    const Mode& to(const Mode& received) const;

private:
    const ModeSet& modes_;
    std::vector<const Mode*> basic_;  // the fastest first
};

}  // namespace netsim
