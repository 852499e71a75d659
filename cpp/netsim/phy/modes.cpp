#include "netsim/phy/modes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "netsim/config/check.hpp"
#include "netsim/config/mac_config.hpp"
#include "netsim/error.hpp"

namespace netsim {
namespace {

constexpr std::int64_t ceil_divide(std::int64_t dividend, std::int64_t divisor) {
    return (dividend + divisor - 1) / divisor;
}

constexpr SimTime us(std::int64_t microseconds) {
    return SimTime::from_us(microseconds);
}

constexpr SimTime ofdm_symbol = us(4);

constexpr Mode dsss(std::string_view name, ModeFamily family, std::int64_t bitrate_bps) {
    return {.name = name,
            .format = PpduFormat::hr_dsss,
            .family = family,
            .bitrate_bps = bitrate_bps,
            .mandatory = true,
            .signal_extension = us(0),
            .preamble = us(144),
            .header = us(48),
            .header_bits = 48,
            .header_bitrate_bps = 1'000'000,
            .phy_rx_start_delay = us(192)};
}

constexpr Mode ofdm(std::string_view name, int data_bits_per_symbol, bool mandatory,
                    Constellation constellation, CodeRate code_rate, SimTime signal_extension) {
    return {.name = name,
            .format = signal_extension > SimTime() ? PpduFormat::erp_ofdm : PpduFormat::ofdm,
            .family = ModeFamily::ofdm,
            .bitrate_bps = std::int64_t{data_bits_per_symbol} * 250'000,  // a symbol lasts 4 µs
            .mandatory = mandatory,
            .constellation = constellation,
            .code_rate = code_rate,
            .data_bits_per_symbol = data_bits_per_symbol,
            .signal_extension = signal_extension,
            .preamble = us(16),
            .header = us(4),
            .header_bits = 24,
            .header_bitrate_bps = 6'000'000,
            .phy_rx_start_delay = us(25)};
}

constexpr Mode dsss_1 = dsss("DSSS 1 Mbps", ModeFamily::dsss, 1'000'000);
constexpr Mode dsss_2 = dsss("DSSS 2 Mbps", ModeFamily::dsss, 2'000'000);
constexpr Mode cck_5_5 = dsss("CCK 5.5 Mbps", ModeFamily::cck, 5'500'000);
constexpr Mode cck_11 = dsss("CCK 11 Mbps", ModeFamily::cck, 11'000'000);

using enum Constellation;
using enum CodeRate;

// IEEE Std 802.11-2020, table 17-4.
constexpr std::array<Mode, 8> ofdm_modes{
    ofdm("OFDM 6 Mbps", 24, true, bpsk, one_half, us(0)),
    ofdm("OFDM 9 Mbps", 36, false, bpsk, three_quarters, us(0)),
    ofdm("OFDM 12 Mbps", 48, true, qpsk, one_half, us(0)),
    ofdm("OFDM 18 Mbps", 72, false, qpsk, three_quarters, us(0)),
    ofdm("OFDM 24 Mbps", 96, true, qam16, one_half, us(0)),
    ofdm("OFDM 36 Mbps", 144, false, qam16, three_quarters, us(0)),
    ofdm("OFDM 48 Mbps", 192, false, qam64, two_thirds, us(0)),
    ofdm("OFDM 54 Mbps", 216, false, qam64, three_quarters, us(0)),
};

// The same in the 2.4 GHz band (clause 18). The silent signal extension gives decoders the time that
// the longer SIFS gives them at 5 GHz.
constexpr std::array<Mode, 8> erp_modes{
    ofdm("ERP-OFDM 6 Mbps", 24, true, bpsk, one_half, us(6)),
    ofdm("ERP-OFDM 9 Mbps", 36, false, bpsk, three_quarters, us(6)),
    ofdm("ERP-OFDM 12 Mbps", 48, true, qpsk, one_half, us(6)),
    ofdm("ERP-OFDM 18 Mbps", 72, false, qpsk, three_quarters, us(6)),
    ofdm("ERP-OFDM 24 Mbps", 96, true, qam16, one_half, us(6)),
    ofdm("ERP-OFDM 36 Mbps", 144, false, qam16, three_quarters, us(6)),
    ofdm("ERP-OFDM 48 Mbps", 192, false, qam64, two_thirds, us(6)),
    ofdm("ERP-OFDM 54 Mbps", 216, false, qam64, three_quarters, us(6)),
};

constexpr std::array<Mode, 4> b_modes{dsss_1, dsss_2, cck_5_5, cck_11};

// In order of bitrate: 1, 2, 5.5, 6, 9, 11, 12, 18, … Mbps.
constexpr std::array<Mode, 12> mixed_modes{dsss_1,       dsss_2,       cck_5_5,      erp_modes[0],
                                           erp_modes[1], cck_11,       erp_modes[2], erp_modes[3],
                                           erp_modes[4], erp_modes[5], erp_modes[6], erp_modes[7]};

constexpr std::array mode_sets{
    ModeSet("b", b_modes, us(20), us(10), 31, 1023),
    ModeSet("g(erp)", erp_modes, us(9), us(10), 15, 1023),
    ModeSet("g(mixed)", mixed_modes, us(20), us(10), 31, 1023),
    ModeSet("a", ofdm_modes, us(9), us(16), 15, 1023),
};

std::string in_mbps(std::int64_t bitrate_bps) {
    return text_of(static_cast<double>(bitrate_bps) / 1e6);
}

}  // namespace

std::int64_t Mode::data_bits(int psdu_bytes) const {
    NETSIM_ASSERT(psdu_bytes >= 0);
    const std::int64_t bits = std::int64_t{8} * psdu_bytes;
    if (family != ModeFamily::ofdm) {
        return bits;
    }
    constexpr int service_bits = 16;
    constexpr int tail_bits = 6;
    return ceil_divide(service_bits + bits + tail_bits, data_bits_per_symbol) * data_bits_per_symbol;
}

SimTime Mode::duration(int psdu_bytes) const {
    const std::int64_t bits = data_bits(psdu_bytes);
    const SimTime data = family == ModeFamily::ofdm ? ofdm_symbol * (bits / data_bits_per_symbol)
                                                    : us(ceil_divide(bits * 1'000'000, bitrate_bps));
    return preamble + header + data + signal_extension;
}

PpduFormats ModeSet::formats() const {
    PpduFormats formats{};
    for (const Mode& mode : modes_) {
        formats.add(mode.format);
    }
    return formats;
}

const Mode& ModeSet::mode_for_bitrate(double bitrate_bps, std::string_view field) const {
    if (bitrate_bps == -1) {
        return fastest_mandatory();
    }
    const Mode* nearest = &modes_.front();
    std::string rates;
    for (const Mode& mode : modes_) {
        const auto off_by = [bitrate_bps](const Mode& candidate) {
            return std::abs(static_cast<double>(candidate.bitrate_bps) - bitrate_bps);
        };
        if (off_by(mode) == 0) {
            return mode;
        }
        if (off_by(mode) < off_by(*nearest)) {
            nearest = &mode;
        }
        rates.append(rates.empty() ? "" : ", ").append(in_mbps(mode.bitrate_bps));
    }
    throw ConfigError({.field = std::string(field),
                       .value = Quantity{bitrate_bps, "bps"},
                       .message = {"expected a bitrate of " + std::string(name_) + ", which has " + rates +
                                   " Mbps; the nearest is " + in_mbps(nearest->bitrate_bps) + " Mbps"},
                       .compared_with = {"mac.op_mode"}});
}

const Mode& ModeSet::fastest_mandatory() const {
    return *std::ranges::find_if(modes_.rbegin(), modes_.rend(), &Mode::mandatory);
}

const Mode& ModeSet::slowest_mandatory() const {
    return *std::ranges::find_if(modes_, &Mode::mandatory);
}

const Mode& ModeSet::response_mode(const Mode& received) const {
    const auto answer = std::ranges::find_if(modes_.rbegin(), modes_.rend(), [&received](const Mode& mode) {
        return mode.mandatory && mode.bitrate_bps <= received.bitrate_bps;
    });
    return answer == modes_.rend() ? slowest_mandatory() : *answer;
}

const ModeSet& mode_set(std::string_view op_mode) {
    check_name("mac.op_mode", op_mode, op_mode_names);
    const auto found = std::ranges::find(mode_sets, op_mode, &ModeSet::name);
    NETSIM_ASSERT(found != mode_sets.end());
    return *found;
}

}  // namespace netsim
