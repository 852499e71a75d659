#include "netsim/config/radio_config.hpp"

#include <algorithm>

#include "netsim/config/check.hpp"
#include "netsim/config/medium_config.hpp"

namespace netsim {
namespace {

constexpr std::array ber_table{ber_table_error_model};
constexpr std::array threshold{preamble_detection_names[1]};
constexpr std::array simple_capture{frame_capture_names[1]};
constexpr std::array thermal{thermal_noise};

constexpr ReadBy with_ber_table{"radio.error_model", ber_table, ber_table_error_model};
constexpr ReadBy with_thermal_noise{"medium.background_noise", thermal, thermal_noise};
constexpr ReadBy with_preamble_detection{"radio.preamble_detection", threshold, threshold[0]};
constexpr ReadBy with_capture{"radio.frame_capture", simple_capture, simple_capture[0]};

constexpr Field fields[] = {
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
     with_ber_table, true},
    {NETSIM_FIELD(RadioConfig, snir_mode), "receiver.errorModel.snirMode", one_of(snir_mode_names),
     "What decides about a frame: its lowest SNIR, or the SNIR of each stretch of time for its part of the "
     "frame,"
     " without the preamble (docs/how-to/choose-a-receiver.md)"},
    {NETSIM_FIELD(RadioConfig, collision_model), "receiver.collisionModel", one_of(collision_model_names),
     "When interference destroys a frame; snir: by its SNIR; overlap: always, if the interference reaches the"
     " sensitivity"},
    {NETSIM_FIELD(RadioConfig, noise_figure), "receiver.noiseFigure", ratio().at_least(1),
     "noise that the receiver adds", with_thermal_noise},
    {NETSIM_FIELD(RadioConfig, preamble_detection), "receiver.preambleDetection.typename",
     one_of(preamble_detection_names),
     "When a radio locks on to a frame; \"\": at once, otherwise when it has detected the preamble"},
    {NETSIM_FIELD(RadioConfig, preamble_threshold), "receiver.preambleDetection.threshold", ratio(),
     "lowest SNIR", with_preamble_detection},
    {NETSIM_FIELD(RadioConfig, preamble_minimum_power_w), "receiver.preambleDetection.minimumPower", level(),
     "lowest power of the frame", with_preamble_detection},
    {NETSIM_FIELD(RadioConfig, preamble_duration_s), "receiver.preambleDetection.duration",
     quantity("s").shown_in("us").at_least(1e-12).at_most(1), "how long a radio listens before it decides",
     with_preamble_detection},
    {NETSIM_FIELD(RadioConfig, lost_header_frees_channel),
     "receiver.preambleDetection.lostHeaderFreesChannel", boolean(),
     "whether the channel counts as free after a lost PHY header, despite the energy of frames in the air;"
     " needs snirMode \"chunks\"",
     with_preamble_detection},
    {NETSIM_FIELD(RadioConfig, frame_capture), "receiver.frameCapture.typename", one_of(frame_capture_names),
     "Whether a stronger frame can replace one whose reception has begun; \"\": never"},
    {NETSIM_FIELD(RadioConfig, capture_margin), "receiver.frameCapture.margin", ratio().at_least(1),
     "how much stronger the later frame must be", with_capture},
    {NETSIM_FIELD(RadioConfig, capture_window_s), "receiver.frameCapture.window",
     quantity("s").shown_in("us").at_least(0).at_most(1), "how long after the start of the earlier frame",
     with_capture},
};

}  // namespace

const Schema RadioConfig::schema{"radio", "wlan[0].radio", true, fields, with_radios};

RadioConfig::RadioConfig(std::string_view interface_type_name) {
    check_name("interface", interface_type_name, interface_type_names);
    if (interface_type_name == ieee802154_interface) {
        carrier_hz = 2.45e9;
        bandwidth_hz = 2.8e6;
        tx_power_w = 0.00224;
        sensitivity_w = 1e-13;                 // -100 dBm
        energy_detection_w = 1e-12;            // -90 dBm
        snir_threshold = 0.15848931924611134;  // -8 dB
        error_model = "Ieee802154ErrorModel";
    }
}

void RadioConfig::validate() const {
    check_fields(*this);
    for (auto entry = tx_power_by_bitrate_w.begin(); entry != tx_power_by_bitrate_w.end(); ++entry) {
        if (std::ranges::find(tx_power_by_bitrate_w.begin(), entry, entry->first,
                              &PowersByBitrate::value_type::first) != entry) {
            throw ConfigError({"radio.tx_power_by_bitrate_w",
                               Quantity{entry->first, "bps"},
                               {"expected one power for this bit rate"}});
        }
    }
    check_at_most("radio.bandwidth_hz", bandwidth_hz, "radio.carrier_hz", carrier_hz, "Hz");
    antenna.validate(carrier_hz);
}

double tx_power_w(double bitrate_bps, double usual_w, const PowersByBitrate& by_bitrate_w) {
    const auto found = std::ranges::find(by_bitrate_w, bitrate_bps, &PowersByBitrate::value_type::first);
    return found == by_bitrate_w.end() ? usual_w : found->second;
}

}  // namespace netsim
