// One radio: what `*.<node>.wlan[*].radio.…` sets in an .ini file. Used by the phy and the medium. What each field means,
// and its range, is in radio_config.cpp.
//
// Defaults are those of INET 4.5's Ieee80211ScalarRadio or, for the other interface, of its
// Ieee802154NarrowbandScalarRadio. Powers are in watts, ratios are linear.
#pragma once

#include <array>
#include <string>
#include <string_view>

#include "netsim/config/antenna_config.hpp"
#include "netsim/config/field.hpp"
#include "netsim/config/interface_type.hpp"

namespace netsim {

inline constexpr std::string_view ber_table_error_model = "Ieee80211BerTableErrorModel";
inline constexpr std::array<std::string_view, 5> error_model_names{
    "Ieee80211DespreadingErrorModel", "Ieee80211NistErrorModel", ber_table_error_model,
    "Ieee802154ErrorModel", ""};
inline constexpr std::string_view snir_by_chunks = "chunks";
inline constexpr std::array<std::string_view, 2> snir_mode_names{"min", snir_by_chunks};
inline constexpr std::string_view collision_by_overlap = "overlap";
inline constexpr std::array<std::string_view, 2> collision_model_names{"snir", collision_by_overlap};
inline constexpr std::array<std::string_view, 2> preamble_detection_names{"", "ThresholdPreambleDetection"};
inline constexpr std::array<std::string_view, 2> frame_capture_names{"", "SimpleFrameCapture"};

inline constexpr double largest_tx_power_w = 1e12;

struct RadioConfig {
    // Sets the defaults of the radio of that interface. Throws ConfigError if it is none of interface_type_names.
    explicit RadioConfig(std::string_view interface_type_name = ieee80211_interface);

    double carrier_hz = 2.412e9;  // channel 1 of the 2.4 GHz band
    double bandwidth_hz = 22e6;
    double tx_power_w = 0.02;
    PowersByBitrate tx_power_by_bitrate_w;  // of bitrates with another power
    double communication_range_m = 60;
    double sensitivity_w = 3.1622776601683794e-12;       // -85 dBm
    double energy_detection_w = 3.1622776601683794e-12;  // -85 dBm
    double snir_threshold = 1.2589254117941673;          // 1 dB
    std::string error_model = "Ieee80211DespreadingErrorModel";
    AntennaConfig antenna;

    double noise_figure = 5.0118723362727229;  // 7 dB
    std::string snir_mode = "min";             // phy/reception.hpp
    std::string ber_table_file;                // phy/ber_table.hpp

    std::string collision_model = "snir";  // phy/reception.hpp

    std::string preamble_detection;                            // "": none
    double preamble_threshold = 2.5118864315095801;            // 4 dB
    double preamble_minimum_power_w = 6.3095734448019329e-12;  // -82 dBm
    double preamble_duration_s = 4e-6;
    bool lost_header_frees_channel = false;  // as in ns-3

    std::string frame_capture;                   // "": none
    double capture_margin = 3.1622776601683795;  // 5 dB
    double capture_window_s = 16e-6;

    static const Schema schema;

    // Throws ConfigError for the first field out of its range, a bandwidth above the center frequency, and a bitrate
    // with two powers.
    void validate() const;

    bool operator==(const RadioConfig&) const = default;
};

// The power in W of frames with that bitrate in bps: `usual_w`, unless the list has another.
double tx_power_w(double bitrate_bps, double usual_w, const PowersByBitrate& by_bitrate_w);

}  // namespace netsim
