// What one radio sent and received, written to a capture file.
//
// A frame's time stamp is its start on the air at this radio: when it began to send it, or when its first bit
// arrived. In the file are the frames that the radio sent, and those that it was locked on to until their end; not
// those that it missed because it was transmitting or locked on another one, nor those too weak. So the time stamps
// never fall, although a reception is written when it ends.
//
// The frames of 802.15.4 have no header that tells how strong they were.
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
