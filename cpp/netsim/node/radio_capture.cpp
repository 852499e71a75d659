#include "netsim/node/radio_capture.hpp"

#include <utility>

#include "netsim/mac/frame_octets.hpp"
#include "netsim/phy/modes.hpp"
#include "netsim/trace/radiotap.hpp"

namespace netsim {

namespace {

Radiotap radiotap_of(const Transmission& transmission) {
    Radiotap radiotap;
    radiotap.bitrate_bps = transmission.mode->bitrate_bps;
    radiotap.carrier_hz = transmission.band.carrier_hz;
    radiotap.modulation =
        transmission.mode->family == ModeFamily::ofdm ? ChannelModulation::ofdm : ChannelModulation::cck;
    return radiotap;
}

}  // namespace

RadioCapture::RadioCapture(std::string path) : writer_(std::move(path)) {}

void RadioCapture::transmitted(const Transmission& transmission) {
    Radiotap radiotap = radiotap_of(transmission);
    radiotap.tx_power_w = transmission.power_w;
    packet_.clear();
    append_radiotap(packet_, radiotap);
    append_frame(packet_, *transmission.frame, true);
    writer_.write(transmission.start, packet_);
}

void RadioCapture::received(const Arrival& arrival, double noise_w, bool decoded) {
    Radiotap radiotap = radiotap_of(*arrival.transmission);
    radiotap.received = Radiotap::Received{arrival.power_w, noise_w, decoded};
    packet_.clear();
    append_radiotap(packet_, radiotap);
    append_frame(packet_, *arrival.transmission->frame, decoded);
    writer_.write(arrival.start, packet_);
}

}  // namespace netsim
