// What one radio sent and received, written to a capture file.
//
// A frame's time stamp is its start on the air at this radio: when it began to send it, or when its first bit
// arrived. In the file are the frames that the radio sent, and those that it was locked on to until their end; not
// those that it missed because it was transmitting or locked on another one, nor those too weak. So the time stamps
// never fall, although a reception is written when it ends.
#pragma once

#include <string>

#include "netsim/phy/radio_observer.hpp"
#include "netsim/trace/octets.hpp"
#include "netsim/trace/pcap_writer.hpp"

namespace netsim {

class RadioCapture final : public RadioObserver {
public:
    // Throws ConfigError if the file cannot be written.
    explicit RadioCapture(std::string path);

    void transmitted(const Transmission& transmission) override;
    void received(const Arrival& arrival, double noise_w, bool decoded) override;
    // Throws SimulationError if part of the file could not be written.
    void close() { writer_.close(); }

private:
    PcapWriter writer_;
    Octets packet_;
};

}  // namespace netsim
