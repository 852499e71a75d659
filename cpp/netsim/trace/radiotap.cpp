#include "netsim/trace/radiotap.hpp"

#include <algorithm>
#include <cmath>

#include "netsim/units.hpp"

namespace netsim {

namespace {

// Bits of the "present" bitmask, in the order of the fields.
constexpr std::uint32_t has_flags = 1U << 1;
constexpr std::uint32_t has_rate = 1U << 2;
constexpr std::uint32_t has_channel = 1U << 3;
constexpr std::uint32_t has_signal_dbm = 1U << 5;
constexpr std::uint32_t has_noise_dbm = 1U << 6;
constexpr std::uint32_t has_tx_power_dbm = 1U << 10;

constexpr unsigned fcs_at_end = 0x10;
constexpr unsigned bad_fcs = 0x40;

constexpr unsigned channel_cck = 0x0020;
constexpr unsigned channel_ofdm = 0x0040;
constexpr unsigned channel_2_ghz = 0x0080;
constexpr unsigned channel_5_ghz = 0x0100;

constexpr unsigned length_sent_bytes = 15;
constexpr unsigned length_received_bytes = 16;

unsigned rate_field(std::int64_t bitrate_bps) {
    constexpr std::int64_t unit_bps = 500'000;
    return static_cast<unsigned>(std::clamp<std::int64_t>(bitrate_bps / unit_bps, 0, 255));
}

unsigned frequency_field(double carrier_hz) {
    return static_cast<unsigned>(std::clamp(std::round(carrier_hz / 1e6), 0.0, 65535.0));
}

// Other bands, such as 868 MHz, have no flag.
unsigned channel_flags(const Radiotap& radiotap) {
    unsigned flags = radiotap.modulation == ChannelModulation::cck ? channel_cck : channel_ofdm;
    if (radiotap.carrier_hz >= 2e9 && radiotap.carrier_hz < 3e9) {
        flags |= channel_2_ghz;
    } else if (radiotap.carrier_hz >= 4.9e9 && radiotap.carrier_hz < 6e9) {
        flags |= channel_5_ghz;
    }
    return flags;
}

unsigned power_field(double power_w) {
    return static_cast<std::uint8_t>(
        static_cast<std::int8_t>(std::clamp(std::round(dbm_from_w(power_w)), -128.0, 127.0)));
}

}  // namespace

void append_radiotap(Octets& octets, const Radiotap& radiotap) {
    const auto& received = radiotap.received;
    append_u8(octets, 0);  // version
    append_u8(octets, 0);  // padding
    append_le16(octets, received ? length_received_bytes : length_sent_bytes);
    append_le32(octets, has_flags | has_rate | has_channel |
                            (received ? has_signal_dbm | has_noise_dbm : has_tx_power_dbm));
    append_u8(octets, received && !received->decoded ? fcs_at_end | bad_fcs : fcs_at_end);
    append_u8(octets, rate_field(radiotap.bitrate_bps));
    append_le16(octets, frequency_field(radiotap.carrier_hz));
    append_le16(octets, channel_flags(radiotap));
    if (received) {
        append_u8(octets, power_field(received->signal_w));
        append_u8(octets, power_field(received->noise_w));
    } else {
        append_u8(octets, power_field(radiotap.tx_power_w));
    }
}

}  // namespace netsim
