#include "netsim/node/radio_capture.hpp"

#include <utility>

#include "netsim/mac/frame_octets.hpp"
#include "netsim/mac/frame_octets_802154.hpp"
#include "netsim/phy/modes.hpp"

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

RadioCapture::RadioCapture(std::string path, LinkType link_type)
    : link_type_(link_type), writer_(std::move(path), link_type) {}

void RadioCapture::append(const Transmission& transmission, const Radiotap& radiotap, bool intact) {
    packet_.clear();
    if (link_type_ == LinkType::ieee802154_with_fcs) {
        append_narrowband_frame(packet_, *transmission.frame, intact);
    } else {
        append_radiotap(packet_, radiotap);
        append_frame(packet_, *transmission.frame, intact);
    }
}

void RadioCapture::transmitted(const Transmission& transmission) {
    Radiotap radiotap = radiotap_of(transmission);
    radiotap.tx_power_w = transmission.power_w;
    append(transmission, radiotap, true);
    writer_.write(transmission.start, packet_);
}

void RadioCapture::received(const Arrival& arrival, double noise_w, bool decoded) {
    Radiotap radiotap = radiotap_of(*arrival.transmission);
    radiotap.received = Radiotap::Received{arrival.power_w, noise_w, decoded};
    append(*arrival.transmission, radiotap, decoded);
    writer_.write(arrival.start, packet_);
}

}  // namespace netsim
