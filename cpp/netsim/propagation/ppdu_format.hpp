// The format of a frame on the air, and the formats that a receiver can decode. A frame in another
// format is only energy and interference to it.
//
// Source: IEEE Std 802.11-2020, clauses 16 (HR/DSSS), 17 (OFDM) and 18 (ERP); IEEE Std
// 802.15.4-2006, 6.5.
#pragma once

#include <array>
#include <cstdint>
#include <initializer_list>

namespace netsim {

enum class PpduFormat : std::uint8_t { hr_dsss, ofdm, erp_ofdm, oqpsk };
constexpr std::array<const char*, 4> ppdu_format_names{"HR/DSSS", "OFDM", "ERP-OFDM", "O-QPSK"};

class PpduFormats {
public:
    constexpr PpduFormats(std::initializer_list<PpduFormat> formats) {
        for (const PpduFormat format : formats) {
            add(format);
        }
    }
    static constexpr PpduFormats all() {
        return {PpduFormat::hr_dsss, PpduFormat::ofdm, PpduFormat::erp_ofdm, PpduFormat::oqpsk};
    }

    constexpr void add(PpduFormat format) { bits_ = static_cast<std::uint8_t>(bits_ | bit(format)); }
    constexpr bool contains(PpduFormat format) const { return (bits_ & bit(format)) != 0; }
    bool operator==(const PpduFormats&) const = default;

private:
    static constexpr unsigned bit(PpduFormat format) { return 1U << static_cast<unsigned>(format); }

    std::uint8_t bits_ = 0;
};

}  // namespace netsim
