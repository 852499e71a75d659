// One radio: what `*.<node>.wlan[*].radio.…` sets in an .ini file. Used by the phy and the medium.
//
// Defaults are those of INET 4.5's Ieee80211ScalarRadio or, for the other interface, of its
// Ieee802154NarrowbandScalarRadio. All powers are linear, in watts.
#pragma once

#include <array>
#include <string>
#include <string_view>

#include "netsim/config/antenna_config.hpp"
#include "netsim/config/interface_type.hpp"

namespace netsim {

inline constexpr std::string_view ber_table_error_model = "Ieee80211BerTableErrorModel";
inline constexpr std::array<std::string_view, 3> error_model_names{
    "Ieee80211NistErrorModel", ber_table_error_model, "Ieee802154ErrorModel"};
inline constexpr std::string_view snir_by_chunks = "chunks";
inline constexpr std::array<std::string_view, 2> snir_mode_names{"min", snir_by_chunks};
inline constexpr std::array<std::string_view, 2> preamble_detection_names{"", "ThresholdPreambleDetection"};
inline constexpr std::array<std::string_view, 2> frame_capture_names{"", "SimpleFrameCapture"};

inline constexpr double largest_tx_power_w = 1e12;

struct RadioConfig {
    // Sets the defaults of the radio of that interface. Throws ConfigError if it is none of interface_type_names.
    explicit RadioConfig(std::string_view interface_type_name = ieee80211_interface);

    double carrier_hz = 2.412e9;  // centre frequency, 1e6 … 1e12; channel 1 of 2.4 GHz; 802.15.4: 2.45 GHz
    double bandwidth_hz = 22e6;   // 1e3 … 1e9, at most carrier_hz; 802.15.4: 2.8 MHz
    double tx_power_w = 0.02;     // 0 … largest_tx_power_w; 802.15.4: 2.24 mW
    double communication_range_m = 60;  // unit disk medium only, ≥ 0

    // The least power to lock on to; > 0; -85 dBm; 802.15.4: -100 dBm.
    double sensitivity_w = 3.1622776601683794e-12;
    // Noise and signals together that make the channel busy; > 0; -85 dBm; 802.15.4: -90 dBm.
    double energy_detection_w = 3.1622776601683794e-12;
    // Linear ratio at or below which every frame fails; ≥ 0; 4 dB; 802.15.4: -8 dB.
    double snir_threshold = 2.5118864315095801;

    std::string error_model = "Ieee80211NistErrorModel";  // of error_model_names; 802.15.4: its own
    AntennaConfig antenna;

    // What the receiver adds to thermal noise (MediumConfig::background_noise), a linear ratio; ≥ 1; 7 dB.
    double noise_figure = 5.0118723362727229;
    std::string snir_mode = "min";  // one of snir_mode_names: phy/reception.hpp
    std::string ber_table_file;     // of the error model of that name only: phy/ber_table.hpp

    std::string preamble_detection;                            // one of preamble_detection_names; "": none
    double preamble_threshold = 2.5118864315095801;            // linear ratio ≥ 0; 4 dB
    double preamble_minimum_power_w = 6.3095734448019329e-12;  // ≥ 0; -82 dBm
    double preamble_duration_s = 4e-6;                         // > 0, at most a second

    std::string frame_capture;                   // one of frame_capture_names; "": none
    double capture_margin = 3.1622776601683795;  // linear ratio ≥ 1; 5 dB
    double capture_window_s = 16e-6;             // ≥ 0, at most a second

    // Throws ConfigError for the first field out of its range: "radio.tx_power_w = -1 W: expected …".
    void validate() const;

    bool operator==(const RadioConfig&) const = default;
};

}  // namespace netsim
