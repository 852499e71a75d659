// Configurations read from any bytes: every model that a name chooses, and numbers of every size.
//
// Zeros give the defaults, and parts that scenarios seldom change are left alone by half of the
// bytes; else hardly any configuration would be accepted. What is refused by a check is no
// scenario, which is up to the caller.
#pragma once

#include <string>

#include "netsim/config/medium_config.hpp"
#include "netsim/config/node_config.hpp"
#include "netsim/phy/modes.hpp"
#include "support/byte_reader.hpp"

namespace netsim::test {

class FuzzedConfig {
public:
    explicit FuzzedConfig(ByteReader& bytes) : bytes_(bytes) {}

    MediumConfig medium() {
        MediumConfig config(bytes_.name(medium_type_names));
        if (bytes_.flag()) {
            config.path_loss = bytes_.name(path_loss_names);
        }
        config.alpha = bytes_.number(config.alpha);
        config.background_noise_w = bytes_.number(config.background_noise_w);
        if (bytes_.flag()) {
            path_loss_parameters(config);
        }
        if (bytes_.flag()) {
            config.background_noise = bytes_.name(background_noise_names);
            config.temperature_k = bytes_.number(config.temperature_k);
        }
        if (bytes_.flag()) {
            obstacles(config);
        }
        return config;
    }

    NodeConfig node() {
        NodeConfig config("node", {});
        config.initial_position = position();
        do {
            InterfaceConfig& added = config.wlan.emplace_back(interface());
            added.radio.carrier_hz += 5e6 * bytes_.below(6);
        } while (config.wlan.size() <= most_interfaces && bytes_.below(4) == 1);
        MobilityConfig& mobility = config.mobility;
        mobility.speed_mps = bytes_.number(mobility.speed_mps);
        mobility.telemetry_interval_s = bytes_.flag() ? bytes_.number(1) : 0;
        if (bytes_.flag()) {
            mobility.type_name = bytes_.name(mobility_type_names);
            mobility.initial_orientation = angles();
            mobility.face_forward = bytes_.flag();
        }
        return config;
    }

    Position position() {
        const double x = bytes_.number(10.0 * bytes_.byte());
        const double y = bytes_.number(10.0 * bytes_.byte());
        return {x, y, bytes_.number(0)};
    }

private:
    // What is over the bound of a field, else a whole scenario is refused for it. NaN stays.
    static double up_to(double most, double value) { return value > most ? most : value; }

    void path_loss_parameters(MediumConfig& config) {
        config.breakpoint_distance_m = bytes_.number(config.breakpoint_distance_m);
        config.l01_db = bytes_.number(config.l01_db);
        config.l02_db = bytes_.number(config.l02_db);
        config.alpha1 = bytes_.number(config.alpha1);
        config.alpha2 = bytes_.number(config.alpha2);
        config.epsilon_r = bytes_.number(config.epsilon_r);
        config.polarization = bytes_.name(polarization_names);
        config.sigma_db = bytes_.between(0, 40);
        config.k_db = bytes_.between(-100, 100);
        config.shape_factor = bytes_.flag() ? bytes_.number(config.shape_factor) : bytes_.between(0.5, 20);
        config.coherence_time_s = bytes_.flag() ? bytes_.number(1e-3) : -bytes_.flag();
    }

    void obstacles(MediumConfig& config) {
        config.obstacle_loss = bytes_.name(obstacle_loss_names);
        config.enable_dielectric_loss = !bytes_.flag();
        config.enable_reflection_loss = !bytes_.flag();
        for (std::uint32_t count = bytes_.below(6); count > 0; --count) {
            ObstacleConfig& obstacle = config.obstacles.emplace_back();
            for (std::uint32_t rings = 1 + bytes_.below(2); rings > 0; --rings) {
                obstacle.rings.push_back(ring());
            }
            obstacle.base_m = bytes_.number(-1.0 * (bytes_.byte() % 4));
            obstacle.top_m = bytes_.number(1.0 + bytes_.byte());
            obstacle.material = bytes_.name(material_names);
            obstacle.relative_permittivity = bytes_.flag() ? bytes_.number(3) : -1;
            obstacle.conductivity_spm = bytes_.flag() ? bytes_.number(1e-3) : -1;
        }
    }

    // Corners have the lattice of the nodes' usual positions, so that nodes lie on walls and
    // corners.
    Ring ring() {
        const double x = 10.0 * bytes_.byte();
        const double y = 10.0 * bytes_.byte();
        const double size_m = bytes_.number(10.0 * (1 + bytes_.byte() % 32));
        Ring corners{{x, y}, {x + size_m, y}, {x + size_m, y + size_m}, {x, y + size_m}};
        for (std::uint32_t count = bytes_.below(5); count > 0; --count) {
            corners.push_back({bytes_.number(10.0 * bytes_.byte()), bytes_.number(10.0 * bytes_.byte())});
        }
        return corners;
    }

    InterfaceConfig interface() {
        InterfaceConfig config(bytes_.name(interface_type_names));
        RadioConfig& radio = config.radio;
        radio.bandwidth_hz = up_to(1e9, bytes_.number(radio.bandwidth_hz));
        radio.tx_power_w = up_to(1e12, bytes_.number(radio.tx_power_w));
        radio.sensitivity_w = bytes_.number(radio.sensitivity_w);
        radio.energy_detection_w = bytes_.number(radio.energy_detection_w);
        radio.snir_threshold = bytes_.number(radio.snir_threshold);
        radio.communication_range_m = bytes_.number(radio.communication_range_m);
        if (bytes_.flag()) {
            receiver(radio);
        }
        if (bytes_.flag()) {
            antenna(radio.antenna);
        }
        if (config.type_name == ieee802154_interface) {
            csma(config.csma);
        } else {
            mac(config.mac);
        }
        return config;
    }

    void receiver(RadioConfig& radio) {
        radio.noise_figure = bytes_.number(radio.noise_figure);
        radio.snir_mode = bytes_.name(snir_mode_names);
        radio.preamble_detection = bytes_.name(preamble_detection_names);
        radio.preamble_threshold = bytes_.number(radio.preamble_threshold);
        radio.preamble_minimum_power_w = bytes_.number(radio.preamble_minimum_power_w);
        radio.preamble_duration_s = bytes_.number(radio.preamble_duration_s);
        radio.frame_capture = bytes_.name(frame_capture_names);
        radio.capture_margin = bytes_.number(radio.capture_margin);
        radio.capture_window_s = bytes_.number(radio.capture_window_s);
    }

    void antenna(AntennaConfig& antenna) {
        antenna.type_name = bytes_.name(antenna_type_names);
        antenna.gain = bytes_.number(antenna.gain);
        antenna.max_gain = bytes_.number(10);
        antenna.min_gain = bytes_.number(antenna.min_gain);
        antenna.beam_width_rad = bytes_.between(0.01, 6.2);
        antenna.wire_axis = bytes_.name(wire_axis_names);
        antenna.length_m = bytes_.flag() ? bytes_.between(0, 0.12) : 0;
        antenna.offset = angles();
    }

    EulerAngles angles() {
        const double heading_rad = bytes_.between(-4, 4);
        const double elevation_rad = bytes_.between(-2, 2);
        return {heading_rad, elevation_rad, bytes_.between(-4, 4)};
    }

    void mac(MacConfig& mac) {
        mac.op_mode = bytes_.name(op_mode_names);
        mac.bitrate_bps = bitrate_bps(mac.op_mode);
        mac.multicast_bitrate_bps = bitrate_bps(mac.op_mode);
        mac.control_bitrate_bps = bitrate_bps(mac.op_mode);
        const bool has_rts = bytes_.flag();
        mac.rts_threshold_bytes = bytes_.integer(has_rts ? 10 * bytes_.byte() : mac.rts_threshold_bytes);
        mac.short_retry_limit = bytes_.integer(mac.short_retry_limit);
        mac.long_retry_limit = bytes_.integer(mac.long_retry_limit);
        mac.cw_min = bytes_.integer(bytes_.flag() ? bytes_.byte() : mac.cw_min);
        mac.cw_max = bytes_.integer(bytes_.flag() ? 4 * bytes_.byte() : mac.cw_max);
        mac.queue_capacity = bytes_.integer(bytes_.flag() ? 1 + bytes_.byte() % 4 : mac.queue_capacity);
        mac.mtu_bytes = bytes_.integer(bytes_.flag() ? 29 + 8 * bytes_.byte() : mac.mtu_bytes);
        mac.backoff_optimization = bytes_.flag();
        mac.initial_channel_busy = bytes_.flag();
        mac.skip_backoff_if_idle = bytes_.flag();
        mac.own_frames_set_nav = bytes_.flag();
        mac.inet_eifs = bytes_.flag();
        mac.inet_station_retry_counters = bytes_.flag();
        if (bytes_.flag()) {
            rate_control(mac);
        }
    }

    // -1, one of the operation mode's, or any.
    double bitrate_bps(const std::string& op_mode) {
        const auto modes = mode_set(op_mode).modes();
        const std::uint32_t index = bytes_.below(static_cast<std::uint32_t>(modes.size()));
        return bytes_.number(bytes_.flag() ? static_cast<double>(modes[index].bitrate_bps) : -1);
    }

    void rate_control(MacConfig& mac) {
        mac.rate_control = bytes_.name(rate_control_names);
        mac.initial_rate_bps = bitrate_bps(mac.op_mode);
        mac.rate_interval_s = bytes_.number(mac.rate_interval_s);
        mac.increase_threshold = bytes_.integer(1 + bytes_.byte() % 16);
        mac.decrease_threshold = bytes_.integer(1 + bytes_.byte() % 4);
        mac.increase_threshold_factor = bytes_.number(mac.increase_threshold_factor);
        mac.max_increase_threshold = bytes_.integer(mac.max_increase_threshold);
        mac.rate_update_interval_s = bytes_.number(mac.rate_update_interval_s);
        mac.look_around_share = bytes_.between(0, 1);
        mac.ewma_weight = bytes_.between(0, 1);
    }

    void csma(CsmaConfig& csma) {
        csma.use_acks = !bytes_.flag();
        csma.max_frame_retries = bytes_.integer(csma.max_frame_retries);
        csma.ack_wait_s = bytes_.number(csma.ack_wait_s);
        csma.sifs_s = bytes_.number(csma.sifs_s);
        csma.lifs_s = bytes_.flag() ? bytes_.number(640e-6) : 0;
        csma.backoff_method = bytes_.name(backoff_method_names);
        csma.max_backoffs = bytes_.integer(csma.max_backoffs);
        csma.min_be = bytes_.integer(bytes_.byte() % 8);
        csma.max_be = bytes_.integer(bytes_.flag() ? bytes_.byte() % 21 : 7);
        csma.contention_window = bytes_.integer(csma.contention_window);
        csma.unit_backoff_s = bytes_.number(csma.unit_backoff_s);
        csma.cca_s = bytes_.number(bytes_.flag() ? 0 : csma.cca_s);
        csma.cca_whole_window = bytes_.flag();
        csma.turnaround_s = bytes_.number(bytes_.flag() ? 0 : csma.turnaround_s);
        csma.queue_capacity = bytes_.integer(bytes_.flag() ? 1 + bytes_.byte() % 4 : csma.queue_capacity);
    }

    ByteReader& bytes_;
};

}  // namespace netsim::test
