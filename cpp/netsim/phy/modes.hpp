// The modes of IEEE 802.11 b, g and a: bitrates, modulations and durations of frames, and the slot,
// SIFS and contention windows of each operation mode.
//
// A mode is one way to send a frame; a mode set has the modes of one operation mode. Both are
// constant tables: references and pointers into them stay valid. Used by the radio (durations), the
// error model (modulation) and the MAC (bitrates, intervals).
//
// Durations (IEEE Std 802.11-2020), with n the bytes of the PSDU (= MPDU, with headers and FCS):
//   OFDM (clauses 17.4.3, 18.5.3): 16 µs preamble + 4 µs SIGNAL + ⌈(16 + 8n + 6) / N_DBPS⌉ symbols of 4 µs,
//     and for g 6 µs of signal extension.
//   DSSS, CCK (clauses 15.2, 16.2.3.5): 144 µs long preamble + 48 µs header + ⌈8n / bitrate⌉ whole µs.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

#include "netsim/kernel/sim_time.hpp"
#include "netsim/propagation/ppdu_format.hpp"

namespace netsim {

// dsss: 1 and 2 Mbps; cck: 5.5 and 11 Mbps; ofdm: 6 to 54 Mbps; oqpsk: the 250 kbps of 802.15.4
// (phy/oqpsk_mode.hpp).
enum class ModeFamily { dsss, cck, ofdm, oqpsk };
enum class Constellation { bpsk, qpsk, qam16, qam64 };
enum class CodeRate { none, one_half, two_thirds, three_quarters };

struct Mode {
    std::string_view name;  // "ERP-OFDM 24 Mbps"
    PpduFormat format = PpduFormat::erp_ofdm;
    ModeFamily family = ModeFamily::ofdm;
    std::int64_t bitrate_bps = 0;
    bool mandatory = false;

    // OFDM only.
    Constellation constellation = Constellation::bpsk;
    CodeRate code_rate = CodeRate::none;
    int data_bits_per_symbol = 0;  // N_DBPS
    SimTime signal_extension;

    SimTime preamble;     // duration until the PHY header
    SimTime header;       // duration of the SIGNAL field or PLCP header
    int header_bits = 0;  // number of its bits
    std::int64_t header_bitrate_bps = 0;
    SimTime phy_rx_start_delay;  // aRxPHYStartDelay: from the start of a frame until the PHY reports it

    // Bits of the data part on the air. For OFDM, including service field, tail and padding.
    std::int64_t data_bits(int psdu_bytes) const;
    // Time on the air of a whole frame. `psdu_bytes` ≥ 0.
    SimTime duration(int psdu_bytes) const;
};

class ModeSet {
public:
    // `modes` in rising order of bitrate, at least one of them mandatory.
    constexpr ModeSet(std::string_view name, std::span<const Mode> modes, SimTime slot, SimTime sifs,
                      int cw_min, int cw_max)
        : name_(name), modes_(modes), slot_(slot), sifs_(sifs), cw_min_(cw_min), cw_max_(cw_max) {}

    std::string_view name() const { return name_; }
    std::span<const Mode> modes() const { return modes_; }
    // The formats of its modes. A station of the set can decode all frames of these formats: for each
    // of them, the set has all modes that any set has.
    PpduFormats formats() const;
    std::size_t index_of(const Mode& mode) const { return static_cast<std::size_t>(&mode - modes_.data()); }

    // Slot time and SIFS of the slowest mode in the set. Derived intervals are in mac/timing.hpp.
    SimTime slot() const { return slot_; }
    SimTime sifs() const { return sifs_; }
    // Contention windows in slots: a backoff is drawn from 0 … cw.
    int cw_min() const { return cw_min_; }
    int cw_max() const { return cw_max_; }

    // For a bitrate of -1, the fastest mandatory mode. Throws ConfigError, with the valid bitrates,
    // for a bitrate that is not in the set. `field`: the field that the user set.
    const Mode& mode_for_bitrate(double bitrate_bps, std::string_view field = "mac.bitrate_bps") const;
    const Mode& fastest_mandatory() const;
    const Mode& slowest_mandatory() const;
    // The mode of the ACK or CTS for a frame in mode `received`: that mode if it is mandatory, else
    // the next slower mandatory one, or the slowest mandatory one if there is none.
    const Mode& response_mode(const Mode& received) const;

private:
    std::string_view name_;
    std::span<const Mode> modes_;
    SimTime slot_;
    SimTime sifs_;
    int cw_min_;
    int cw_max_;
};

// The mode set of an operation mode: "b", "g(erp)", "g(mixed)" or "a" (MacConfig::op_mode). Throws
// ConfigError for other names.
const ModeSet& mode_set(std::string_view op_mode);

}  // namespace netsim
