// The MAC of one 802.15.4 interface: settings `*.<node>.wlan[*].mac.…` of an .ini file for a node whose interface is an
// Ieee802154NarrowbandInterface. Used by the mac. Each field has a row below the struct.
//
// Defaults are those of INET 4.5's Ieee802154NarrowbandMac. So are the names of the values in .ini files, which come
// from IEEE Std 802.15.4-2006, table 86.
#pragma once

#include <string>
#include <string_view>

#include "netsim/config/field.hpp"
#include "netsim/config/full_queue.hpp"
#include "netsim/config/interface_type.hpp"

namespace netsim {

inline constexpr Model backoff_methods[] = {
    {"exponential", {"min_be", "max_be"}},
    {"linear", {"contention_window"}},
    {"constant", {"contention_window"}},
};
inline constexpr auto backoff_method_names = names_of(backoff_methods);
inline constexpr ReadBy by_backoff{"csma.backoff_method", backoff_methods};

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

namespace csma_values {
inline constexpr ValueType count = integer().at_least(0).at_most(255);
inline constexpr ValueType exponent = integer().at_least(0).at_most(20);
inline constexpr ValueType time = quantity("s").shown_in("us").at_least(0).at_most(1);
inline constexpr ValueType period = time.at_least(1e-6);
}  // namespace csma_values

inline constexpr Field csma_fields[] = {
    {NETSIM_FIELD(CsmaConfig, use_acks), "mac.useMACAcks", boolean(),
     "whether the interface asks for an ACK of each unicast frame that it sends"},
    {NETSIM_FIELD(CsmaConfig, max_frame_retries), "mac.macMaxFrameRetries", csma_values::count,
     "number of retries of a frame without an ACK"},
    {NETSIM_FIELD(CsmaConfig, ack_wait_s), "mac.macAckWaitDuration", csma_values::period,
     "how long a sender waits for the end of an ACK"},
    {NETSIM_FIELD(CsmaConfig, sifs_s), "mac.sifs", csma_values::time,
     "time from the end of a frame to its ACK"},
    {NETSIM_FIELD(CsmaConfig, lifs_s), "mac.macLIFSPeriod", csma_values::time,
     "pause after a frame or its ACK, before the next wait; 0s in INET, 640us in the standard"},
    {NETSIM_FIELD(CsmaConfig, max_backoffs), "mac.macMaxCSMABackoffs", csma_values::count,
     "further waits after the first if the channel is busy; then the frame is dropped"},
    {NETSIM_FIELD(CsmaConfig, backoff_method), "mac.backoffMethod", one_of(backoff_method_names),
     "how the longest wait grows when the channel is busy"},
    {NETSIM_FIELD(CsmaConfig, min_be), "mac.macMinBE", csma_values::exponent,
     "the first wait is 0 to 2^BE - 1 periods", by_backoff},
    {NETSIM_FIELD(CsmaConfig, max_be), "mac.macMaxBE", csma_values::exponent,
     "BE grows by 1 up to this value", by_backoff},
    {NETSIM_FIELD(CsmaConfig, contention_window), "mac.contentionWindow",
     integer().at_least(1).at_most(32767), "the first wait is 1 to this number of periods", by_backoff},
    {NETSIM_FIELD(CsmaConfig, unit_backoff_s), "mac.aUnitBackoffPeriod", csma_values::period,
     "period in which waits are counted"},
    {NETSIM_FIELD(CsmaConfig, cca_s), "mac.ccaDetectionTime", csma_values::time,
     "how long a device listens before it sends"},
    {NETSIM_FIELD(CsmaConfig, cca_whole_window), "mac.ccaWholeWindow", boolean(),
     "whether the channel must be free during all of that time; in INET, at its end"},
    {NETSIM_FIELD(CsmaConfig, turnaround_s), "mac.aTurnaroundTime", csma_values::time,
     "time from listening to sending, in which the radio is deaf"},
    {NETSIM_FIELD(CsmaConfig, queue_capacity), "queue.packetCapacity",
     integer().at_least(1).at_most(1'000'000),
     "number of frames that can wait in the queue, without the one in progress"},
    {NETSIM_FIELD(CsmaConfig, queue_when_full), "queue.whenFull", one_of(when_full_names),
     "what happens to a message if the queue is full: see that of 802.11"},
};

inline constexpr Schema CsmaConfig::schema{"csma", "wlan[0]", true, csma_fields, by_interface, "802.15.4"};

}  // namespace netsim
