// Writes the frames that one radio sent and received to a capture file.
//
// A frame's time stamp is its start at this radio: of the transmission, or of the arrival of its
// first bit. The file has the frames that the radio sent, and those that it was locked on to until
// their end. It does not have frames that were too weak, or that the radio missed while transmitting
// or locked on to another one. So time stamps never decrease, although a reception is written at its
// end.
//
// 802.15.4 frames do not have a header with their power.
#pragma once

#include <string>

#include "netsim/medium/arrival.hpp"
#include "netsim/phy/radio_observer.hpp"
#include "netsim/trace/octets.hpp"
#include "netsim/trace/pcap_writer.hpp"
#include "netsim/trace/radiotap.hpp"

namespace netsim {

class RadioCapture final : public RadioObserver {
public:
    // Throws ConfigError if the file cannot be written.
    RadioCapture(std::string path, LinkType link_type);

    void transmitted(const Transmission& transmission) override;
    void received(const Arrival& arrival, double noise_w, bool decoded) override;
    // Throws SimulationError if part of the file could not be written.
    void close() { writer_.close(); }

private:
    void append(const Transmission& transmission, const Radiotap& radiotap, bool intact);

    LinkType link_type_;
    PcapWriter writer_;
    Octets packet_;
};

}  // namespace netsim
