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

inline constexpr std::array<std::string_view, 2> error_model_names{"Ieee80211NistErrorModel",
                                                                   "Ieee802154ErrorModel"};

struct RadioConfig {
    // Sets the defaults of the radio of that interface. Throws ConfigError if it is none of interface_type_names.
    explicit RadioConfig(std::string_view interface_type_name = ieee80211_interface);

    double carrier_hz = 2.412e9;        // centre frequency, > 0; channel 1 of 2.4 GHz; 802.15.4: 2.45 GHz
    double bandwidth_hz = 22e6;         // > 0; 802.15.4: 2.8 MHz
    double tx_power_w = 0.02;           // ≥ 0; 802.15.4: 2.24 mW
    double communication_range_m = 60;  // unit disk medium only, ≥ 0

    // The least power to lock on to; > 0; -85 dBm; 802.15.4: -100 dBm.
    double sensitivity_w = 3.1622776601683794e-12;
    // Noise and signals together that make the channel busy; > 0; -85 dBm; 802.15.4: -90 dBm.
    double energy_detection_w = 3.1622776601683794e-12;
    // Linear ratio at or below which every frame fails; ≥ 0; 4 dB; 802.15.4: -8 dB.
    double snir_threshold = 2.5118864315095801;

    std::string error_model = "Ieee80211NistErrorModel";  // one of error_model_names; 802.15.4: the other
    AntennaConfig antenna;

    // Throws ConfigError for the first field out of its range: "radio.tx_power_w = -1 W: expected …".
    void validate() const;
};

}  // namespace netsim
