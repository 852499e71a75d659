#include "netsim/config/csma_config.hpp"

#include "netsim/config/check.hpp"
#include "netsim/config/interface_type.hpp"

namespace netsim {
namespace {

constexpr std::array exponential{backoff_method_names[0]};
constexpr std::array fixed_window{backoff_method_names[1], backoff_method_names[2]};
constexpr ReadBy with_exponential{"csma.backoff_method", exponential, "802.15.4, exponential"};
constexpr ReadBy with_fixed_window{"csma.backoff_method", fixed_window, "802.15.4, linear and constant"};

constexpr ValueType count = integer().at_least(0).at_most(255);
constexpr ValueType exponent = integer().at_least(0).at_most(20);
constexpr ValueType time = quantity("s").shown_in("us").at_least(0).at_most(1);
constexpr ValueType period = time.at_least(1e-6);

constexpr Field fields[] = {
    {NETSIM_FIELD(CsmaConfig, use_acks), "mac.useMACAcks", boolean(),
     "whether the interface asks for an ACK of each unicast frame that it sends"},
    {NETSIM_FIELD(CsmaConfig, max_frame_retries), "mac.macMaxFrameRetries", count,
     "number of retries of a frame without an ACK"},
    {NETSIM_FIELD(CsmaConfig, ack_wait_s), "mac.macAckWaitDuration", period,
     "how long a sender waits for the end of an ACK"},
    {NETSIM_FIELD(CsmaConfig, sifs_s), "mac.sifs", time, "time from the end of a frame to its ACK"},
    {NETSIM_FIELD(CsmaConfig, lifs_s), "mac.macLIFSPeriod", time,
     "pause after a frame or its ACK, before the next wait; 0s in INET, 640us in the standard"},
    {NETSIM_FIELD(CsmaConfig, max_backoffs), "mac.macMaxCSMABackoffs", count,
     "further waits after the first if the channel is busy; then the frame is dropped"},
    {NETSIM_FIELD(CsmaConfig, backoff_method), "mac.backoffMethod", one_of(backoff_method_names),
     "how the longest wait grows when the channel is busy"},
    {NETSIM_FIELD(CsmaConfig, min_be), "mac.macMinBE", exponent, "the first wait is 0 to 2^BE - 1 periods",
     with_exponential},
    {NETSIM_FIELD(CsmaConfig, max_be), "mac.macMaxBE", exponent, "BE grows by 1 up to this value",
     with_exponential},
    {NETSIM_FIELD(CsmaConfig, contention_window), "mac.contentionWindow",
     integer().at_least(1).at_most(32767), "the first wait is 1 to this number of periods",
     with_fixed_window},
    {NETSIM_FIELD(CsmaConfig, unit_backoff_s), "mac.aUnitBackoffPeriod", period,
     "period in which waits are counted"},
    {NETSIM_FIELD(CsmaConfig, cca_s), "mac.ccaDetectionTime", time,
     "how long a device listens before it sends"},
    {NETSIM_FIELD(CsmaConfig, cca_whole_window), "mac.ccaWholeWindow", boolean(),
     "whether the channel must be free during all of that time; in INET, at its end"},
    {NETSIM_FIELD(CsmaConfig, turnaround_s), "mac.aTurnaroundTime", time,
     "time from listening to sending, in which the radio is deaf"},
    {NETSIM_FIELD(CsmaConfig, queue_capacity), "queue.packetCapacity",
     integer().at_least(1).at_most(1'000'000),
     "number of frames that can wait in the queue, without the one in progress"},
    {NETSIM_FIELD(CsmaConfig, queue_when_full), "queue.whenFull", one_of(when_full_names),
     "what happens to a message if the queue is full: see that of 802.11"},
};

}  // namespace

const Schema CsmaConfig::schema{"csma", "wlan[0]", true, fields, with_ieee802154};

void CsmaConfig::validate() const {
    check_fields(*this);
    check_at_most("csma.min_be", min_be, "csma.max_be", max_be);
}

}  // namespace netsim
