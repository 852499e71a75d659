// One radio: what `*.<node>.wlan[*].radio.…` sets in an .ini file. Used by the phy and the medium. Each
// field has a row below the struct.
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
#include "netsim/config/medium_config.hpp"

namespace netsim {

// "": no errors. Names that begin with "Ieee80211" are for that interface only, as the others are for 802.15.4.
inline constexpr Model error_models[] = {
    {"Ieee80211DespreadingErrorModel"},
    {"Ieee80211NistErrorModel"},
    {"Ieee80211BerTableErrorModel", {"ber_table_file"}},
    {"Ieee802154ErrorModel"},
    {""},
};
inline constexpr auto error_model_names = names_of(error_models);
inline constexpr ReadBy by_error_model{"radio.error_model", error_models};

inline constexpr std::string_view snir_by_chunks = "chunks";
inline constexpr std::array<std::string_view, 2> snir_mode_names{"min", snir_by_chunks};
inline constexpr std::string_view collision_by_overlap = "overlap";
inline constexpr std::array<std::string_view, 2> collision_model_names{"snir", collision_by_overlap};

inline constexpr Model preamble_detections[] = {
    {""},
    {"ThresholdPreambleDetection",
     {"preamble_threshold", "preamble_minimum_power_w", "preamble_duration_s", "lost_header_frees_channel"}},
};
inline constexpr auto preamble_detection_names = names_of(preamble_detections);
inline constexpr ReadBy by_preamble_detection{"radio.preamble_detection", preamble_detections};

inline constexpr Model frame_captures[] = {{""},
                                           {"SimpleFrameCapture", {"capture_margin", "capture_window_s"}}};
inline constexpr auto frame_capture_names = names_of(frame_captures);
inline constexpr ReadBy by_frame_capture{"radio.frame_capture", frame_captures};

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

inline constexpr Field radio_fields[] = {
    {NETSIM_FIELD(RadioConfig, carrier_hz), "centerFrequency",
     quantity("Hz").shown_in("MHz").at_least(1e6).at_most(1e12), "Center of the channel"},
    {NETSIM_FIELD(RadioConfig, bandwidth_hz), "bandwidth",
     quantity("Hz").shown_in("MHz").at_least(1e3).at_most(1e9),
     "Width of the channel; 802.11: 20MHz to 22MHz"},
    {NETSIM_FIELD(RadioConfig, tx_power_w), "transmitter.power",
     quantity("W").shown_in("mW").at_least(0).at_most(largest_tx_power_w), "Transmit power"},
    {NETSIM_FIELD(RadioConfig, tx_power_by_bitrate_w), "transmitter.powerByBitrate",
     powers_by_bitrate().at_most(largest_tx_power_w),
     "Transmit power of frames with these bit rates, such as [[48Mbps, 20dBm], [54Mbps, 19dBm]]; all others "
     "have transmitter.power"},
    {NETSIM_FIELD(RadioConfig, communication_range_m), "transmitter.communicationRange",
     quantity("m").at_least(0),
     "UnitDiskRadioMedium: radius of the circle. Other media: sets the lowest power at which at least half "
     "of the"
     " broadcast messages of 50 B arrive at that distance; of it and transmitter.power, the first line "
     "counts",
     ReadBy{}},
    {NETSIM_FIELD(RadioConfig, sensitivity_w), "receiver.sensitivity", level().above(0),
     "Weakest frame that the radio can receive"},
    {NETSIM_FIELD(RadioConfig, energy_detection_w), "receiver.energyDetection", level().above(0),
     "Power (noise and signals together) from which on the channel counts as busy"},
    {NETSIM_FIELD(RadioConfig, snir_threshold), "receiver.snirThreshold", ratio(),
     "Signal to noise and interference ratio at or below which every frame is lost"},
    {NETSIM_FIELD(RadioConfig, error_model), "receiver.errorModel.typename", one_of(error_model_names),
     "How noise becomes lost frames; \"\": only snirThreshold counts"},
    {NETSIM_FIELD(RadioConfig, ber_table_file), "receiver.errorModel.berTableFile", file_name(),
     "CSV file of packet success over SNIR, relative to the .ini file; the format is this project's own"
     " (docs/how-to/choose-a-receiver.md)",
     by_error_model, true},
    {NETSIM_FIELD(RadioConfig, snir_mode), "receiver.errorModel.snirMode", one_of(snir_mode_names),
     "What decides about a frame: its lowest SNIR, or the SNIR of each stretch of time for its part of the "
     "frame,"
     " without the preamble (docs/how-to/choose-a-receiver.md)"},
    {NETSIM_FIELD(RadioConfig, collision_model), "receiver.collisionModel", one_of(collision_model_names),
     "When interference destroys a frame; snir: by its SNIR; overlap: always, if the interference reaches the"
     " sensitivity"},
    {NETSIM_FIELD(RadioConfig, noise_figure), "receiver.noiseFigure", ratio().at_least(1),
     "noise that the receiver adds", by_background_noise},
    {NETSIM_FIELD(RadioConfig, preamble_detection), "receiver.preambleDetection.typename",
     one_of(preamble_detection_names),
     "When a radio locks on to a frame; \"\": at once, otherwise when it has detected the preamble"},
    {NETSIM_FIELD(RadioConfig, preamble_threshold), "receiver.preambleDetection.threshold", ratio(),
     "lowest SNIR", by_preamble_detection},
    {NETSIM_FIELD(RadioConfig, preamble_minimum_power_w), "receiver.preambleDetection.minimumPower", level(),
     "lowest power of the frame", by_preamble_detection},
    {NETSIM_FIELD(RadioConfig, preamble_duration_s), "receiver.preambleDetection.duration",
     quantity("s").shown_in("us").at_least(1e-12).at_most(1), "how long a radio listens before it decides",
     by_preamble_detection},
    {NETSIM_FIELD(RadioConfig, lost_header_frees_channel),
     "receiver.preambleDetection.lostHeaderFreesChannel", boolean(),
     "whether the channel counts as free after a lost PHY header, despite the energy of frames in the air;"
     " needs snirMode \"chunks\"",
     by_preamble_detection},
    {NETSIM_FIELD(RadioConfig, frame_capture), "receiver.frameCapture.typename", one_of(frame_capture_names),
     "Whether a stronger frame can replace one whose reception has begun; \"\": never"},
    {NETSIM_FIELD(RadioConfig, capture_margin), "receiver.frameCapture.margin", ratio().at_least(1),
     "how much stronger the later frame must be", by_frame_capture},
    {NETSIM_FIELD(RadioConfig, capture_window_s), "receiver.frameCapture.window",
     quantity("s").shown_in("us").at_least(0).at_most(1), "how long after the start of the earlier frame",
     by_frame_capture},
};

inline constexpr Schema RadioConfig::schema{"radio", "wlan[0].radio", true, radio_fields, with_radios};

}  // namespace netsim
