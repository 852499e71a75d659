// The MAC of one 802.15.4 interface: settings `*.<node>.wlan[*].mac.…` of an .ini file for a node whose interface is an
// Ieee802154NarrowbandInterface. Used by the mac. The meaning and range of each field are in csma_config.cpp.
//
// Defaults are those of INET 4.5's Ieee802154NarrowbandMac. So are the names of the values in .ini files, which come
// from IEEE Std 802.15.4-2006, table 86.
#pragma once

#include <array>
#include <string>
#include <string_view>

#include "netsim/config/field.hpp"
#include "netsim/config/full_queue.hpp"

namespace netsim {

inline constexpr std::array<std::string_view, 3> backoff_method_names{"exponential", "linear", "constant"};

struct CsmaConfig {
    bool use_acks = true;  // without ACKs, unicast frames count as sent once they are on the air
    int max_frame_retries = 3;
    double ack_wait_s = 560e-6;
    double sifs_s = 192e-6;
    // INET has no long interframe space. In the standard it is 640e-6, 40 symbols (7.5.1.3), for all frames of this
    // length.
    double lifs_s = 0;

    // A wait is a random number of unit backoff periods:
    //   exponential: 0 … 2^BE − 1, where BE = min_be + failed assessments of this frame, at most max_be
    //   linear: 1 … contention_window + failed assessments of this frame
    //   constant: 1 … contention_window
    std::string backoff_method = "exponential";
    int max_backoffs = 4;  // further ones after the first
    int min_be = 3;
    int max_be = 5;
    int contention_window = 2;
    double unit_backoff_s = 320e-6;  // 20 symbols

    double cca_s = 128e-6;  // 8 symbols
    bool cca_whole_window = false;
    double turnaround_s = 192e-6;  // 12 symbols

    int queue_capacity = 100;
    std::string queue_when_full{drop_when_full};

    static const Schema schema;

    // Throws ConfigError for the first field outside its range: "csma.min_be = -2: expected …".
    void validate() const;
};

}  // namespace netsim
