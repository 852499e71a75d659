// The MAC of one 802.15.4 interface: what `*.<node>.wlan[*].mac.…` sets in an .ini file for a node whose interface is
// an Ieee802154NarrowbandInterface. Used by the mac.
//
// Defaults are those of INET 4.5's Ieee802154NarrowbandMac; so are the names of the values in .ini files, which are
// those of IEEE Std 802.15.4-2006, table 86.
#pragma once

#include <array>
#include <string>
#include <string_view>

namespace netsim {

inline constexpr std::array<std::string_view, 3> backoff_method_names{"exponential", "linear", "constant"};

struct CsmaConfig {
    bool use_acks = true;       // its unicast frames ask for ACKs; if not, they count as sent once on the air
    int max_frame_retries = 3;  // repetitions of a frame that is not acknowledged; 0 … 255
    double ack_wait_s = 560e-6;  // from the end of a frame until its sender gives up waiting; 1e-6 … 1
    double sifs_s = 192e-6;      // from the end of a received frame until its ACK begins; 0 … 1
    // From the end of an exchange until the next wait; 0 … 1. The standard's long interframe space is 640e-6, 40 symbols
    // (7.5.1.3), which all frames of this stack are long enough for; INET has none.
    double lifs_s = 0;

    // A wait is a number of unit backoff periods, drawn from
    //   exponential: 0 … 2^BE − 1, where BE = min_be + failed assessments of this frame, at most max_be
    //   linear: 1 … contention_window + failed assessments of this frame
    //   constant: 1 … contention_window
    std::string backoff_method = "exponential";  // one of backoff_method_names
    int max_backoffs = 4;                        // further ones after the first; 0 … 255
    int min_be = 3;                              // 0 … max_be
    int max_be = 5;                              // min_be … 20
    int contention_window = 2;                   // linear and constant only; 1 … 32767
    double unit_backoff_s = 320e-6;              // 20 symbols; 1e-6 … 1

    double cca_s = 128e-6;          // clear channel assessment: 8 symbols; 0 … 1
    bool cca_whole_window = false;  // busy at any moment of it counts; INET: busy at its end does
    double turnaround_s = 192e-6;   // from receiving to transmitting: 12 symbols; 0 … 1

    int queue_capacity = 100;  // waiting frames, without the one in progress; 1 … 1000000

    // Throws ConfigError for the first field out of its range: "csma.min_be = -2: expected …".
    void validate() const;
};

}  // namespace netsim
