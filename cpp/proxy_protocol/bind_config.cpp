// The config structs, field by field under their own names (C++'s type_name is Python's typename).
#include <array>
#include <set>
#include <string>
#include <vector>

#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include "netsim/config/antenna_config.hpp"
#include "netsim/config/csma_config.hpp"
#include "netsim/config/mac_config.hpp"
#include "netsim/config/medium_config.hpp"
#include "netsim/config/mobility_config.hpp"
#include "netsim/config/node_config.hpp"
#include "netsim/config/obstacle_config.hpp"
#include "netsim/config/radio_config.hpp"
#include "netsim/mac/frame_802154.hpp"
#include "netsim/node/known_formats.hpp"
#include "netsim/phy/oqpsk_mode.hpp"
#include "proxy_protocol/bindings.hpp"

namespace py = pybind11;
using namespace netsim;

namespace proxy_protocol {

namespace {

// One angle of an orientation, as a field of its own.
template <typename Config>
void bind_angle(py::class_<Config>& config, const char* name, EulerAngles Config::* angles,
                double EulerAngles::* angle) {
    config.def_property(
        name, [=](const Config& self) { return self.*angles.*angle; },
        [=](Config& self, double value) { self.*angles.*angle = value; });
}

}  // namespace

void bind_config(py::module_& module) {
    py::class_<ObstacleConfig>(module, "ObstacleConfig")
        .def(py::init<>())
        .def_readwrite("name", &ObstacleConfig::name)
        .def_readwrite("rings", &ObstacleConfig::rings)
        .def_readwrite("base_m", &ObstacleConfig::base_m)
        .def_readwrite("top_m", &ObstacleConfig::top_m)
        .def_readwrite("material", &ObstacleConfig::material)
        .def_readwrite("relative_permittivity", &ObstacleConfig::relative_permittivity)
        .def_readwrite("conductivity_spm", &ObstacleConfig::conductivity_spm)
        .def("validate", &ObstacleConfig::validate);

    py::class_<MediumConfig>(module, "MediumConfig")
        .def(py::init<std::string>(), py::arg("typename") = "Ieee80211ScalarRadioMedium")
        .def_readonly("typename", &MediumConfig::type_name)  // sets the other defaults, so only at the start
        .def_readwrite("path_loss", &MediumConfig::path_loss)
        .def_readwrite("alpha", &MediumConfig::alpha)
        .def_readwrite("breakpoint_distance_m", &MediumConfig::breakpoint_distance_m)
        .def_readwrite("l01_db", &MediumConfig::l01_db)
        .def_readwrite("l02_db", &MediumConfig::l02_db)
        .def_readwrite("alpha1", &MediumConfig::alpha1)
        .def_readwrite("alpha2", &MediumConfig::alpha2)
        .def_readwrite("epsilon_r", &MediumConfig::epsilon_r)
        .def_readwrite("polarization", &MediumConfig::polarization)
        .def_readwrite("sigma_db", &MediumConfig::sigma_db)
        .def_readwrite("k_db", &MediumConfig::k_db)
        .def_readwrite("shape_factor", &MediumConfig::shape_factor)
        .def_readwrite("coherence_time_s", &MediumConfig::coherence_time_s)
        .def_readwrite("background_noise", &MediumConfig::background_noise)
        .def_readwrite("temperature_k", &MediumConfig::temperature_k)
        .def_readwrite("background_noise_w", &MediumConfig::background_noise_w)
        .def_readwrite("propagation", &MediumConfig::propagation)
        .def_readwrite("obstacle_loss", &MediumConfig::obstacle_loss)
        .def_readwrite("enable_dielectric_loss", &MediumConfig::enable_dielectric_loss)
        .def_readwrite("enable_reflection_loss", &MediumConfig::enable_reflection_loss)
        .def_readwrite("obstacles", &MediumConfig::obstacles)
        .def("validate", &MediumConfig::validate);

    py::class_<AntennaConfig> antenna(module, "AntennaConfig");
    antenna.def(py::init<>())
        .def_readwrite("typename", &AntennaConfig::type_name)
        .def_readwrite("gain", &AntennaConfig::gain)
        .def_readwrite("max_gain", &AntennaConfig::max_gain)
        .def_readwrite("min_gain", &AntennaConfig::min_gain)
        .def_readwrite("beam_width_rad", &AntennaConfig::beam_width_rad)
        .def_readwrite("wire_axis", &AntennaConfig::wire_axis)
        .def_readwrite("length_m", &AntennaConfig::length_m)
        .def("validate", &AntennaConfig::validate, py::arg("carrier_hz"));
    bind_angle(antenna, "offset_heading_rad", &AntennaConfig::offset, &EulerAngles::heading_rad);
    bind_angle(antenna, "offset_elevation_rad", &AntennaConfig::offset, &EulerAngles::elevation_rad);
    bind_angle(antenna, "offset_bank_rad", &AntennaConfig::offset, &EulerAngles::bank_rad);

    py::class_<RadioConfig>(module, "RadioConfig")
        .def(py::init<std::string_view>(), py::arg("interface") = ieee80211_interface)
        .def_readwrite("carrier_hz", &RadioConfig::carrier_hz)
        .def_readwrite("bandwidth_hz", &RadioConfig::bandwidth_hz)
        .def_readwrite("tx_power_w", &RadioConfig::tx_power_w)
        .def_readwrite("communication_range_m", &RadioConfig::communication_range_m)
        .def_readwrite("sensitivity_w", &RadioConfig::sensitivity_w)
        .def_readwrite("energy_detection_w", &RadioConfig::energy_detection_w)
        .def_readwrite("snir_threshold", &RadioConfig::snir_threshold)
        .def_readwrite("error_model", &RadioConfig::error_model)
        .def_readwrite("antenna", &RadioConfig::antenna)
        .def_readwrite("noise_figure", &RadioConfig::noise_figure)
        .def_readwrite("snir_mode", &RadioConfig::snir_mode)
        .def_readwrite("ber_table_file", &RadioConfig::ber_table_file)
        .def_readwrite("preamble_detection", &RadioConfig::preamble_detection)
        .def_readwrite("preamble_threshold", &RadioConfig::preamble_threshold)
        .def_readwrite("preamble_minimum_power_w", &RadioConfig::preamble_minimum_power_w)
        .def_readwrite("preamble_duration_s", &RadioConfig::preamble_duration_s)
        .def_readwrite("frame_capture", &RadioConfig::frame_capture)
        .def_readwrite("capture_margin", &RadioConfig::capture_margin)
        .def_readwrite("capture_window_s", &RadioConfig::capture_window_s)
        .def("validate", &RadioConfig::validate);

    py::class_<MacConfig>(module, "MacConfig")
        .def(py::init<>())
        .def_readwrite("op_mode", &MacConfig::op_mode)
        .def_readwrite("bitrate_bps", &MacConfig::bitrate_bps)
        .def_readwrite("multicast_bitrate_bps", &MacConfig::multicast_bitrate_bps)
        .def_readwrite("control_bitrate_bps", &MacConfig::control_bitrate_bps)
        .def_readwrite("rts_threshold_bytes", &MacConfig::rts_threshold_bytes)
        .def_readwrite("short_retry_limit", &MacConfig::short_retry_limit)
        .def_readwrite("long_retry_limit", &MacConfig::long_retry_limit)
        .def_readwrite("inet_station_retry_counters", &MacConfig::inet_station_retry_counters)
        .def_readwrite("cw_min", &MacConfig::cw_min)
        .def_readwrite("cw_max", &MacConfig::cw_max)
        .def_readwrite("queue_capacity", &MacConfig::queue_capacity)
        .def_readwrite("mtu_bytes", &MacConfig::mtu_bytes)
        .def_readwrite("backoff_optimization", &MacConfig::backoff_optimization)
        .def_readwrite("initial_channel_busy", &MacConfig::initial_channel_busy)
        .def_readwrite("skip_backoff_if_idle", &MacConfig::skip_backoff_if_idle)
        .def_readwrite("own_frames_set_nav", &MacConfig::own_frames_set_nav)
        .def_readwrite("inet_eifs", &MacConfig::inet_eifs)
        .def_readwrite("rate_control", &MacConfig::rate_control)
        .def_readwrite("initial_rate_bps", &MacConfig::initial_rate_bps)
        .def_readwrite("rate_interval_s", &MacConfig::rate_interval_s)
        .def_readwrite("increase_threshold", &MacConfig::increase_threshold)
        .def_readwrite("decrease_threshold", &MacConfig::decrease_threshold)
        .def_readwrite("increase_threshold_factor", &MacConfig::increase_threshold_factor)
        .def_readwrite("max_increase_threshold", &MacConfig::max_increase_threshold)
        .def_readwrite("rate_update_interval_s", &MacConfig::rate_update_interval_s)
        .def_readwrite("look_around_share", &MacConfig::look_around_share)
        .def_readwrite("ewma_weight", &MacConfig::ewma_weight)
        .def("validate", &MacConfig::validate);

    py::class_<CsmaConfig>(module, "CsmaConfig")
        .def(py::init<>())
        .def_readwrite("use_acks", &CsmaConfig::use_acks)
        .def_readwrite("max_frame_retries", &CsmaConfig::max_frame_retries)
        .def_readwrite("ack_wait_s", &CsmaConfig::ack_wait_s)
        .def_property_readonly("ack_end_s",
                               [](const CsmaConfig& config) {
                                   return config.sifs_s +
                                          oqpsk_250_kbps.duration(narrowband_ack_bytes).seconds();
                               })
        .def_readwrite("sifs_s", &CsmaConfig::sifs_s)
        .def_readwrite("lifs_s", &CsmaConfig::lifs_s)
        .def_readwrite("backoff_method", &CsmaConfig::backoff_method)
        .def_readwrite("max_backoffs", &CsmaConfig::max_backoffs)
        .def_readwrite("min_be", &CsmaConfig::min_be)
        .def_readwrite("max_be", &CsmaConfig::max_be)
        .def_readwrite("contention_window", &CsmaConfig::contention_window)
        .def_readwrite("unit_backoff_s", &CsmaConfig::unit_backoff_s)
        .def_readwrite("cca_s", &CsmaConfig::cca_s)
        .def_readwrite("cca_whole_window", &CsmaConfig::cca_whole_window)
        .def_readwrite("turnaround_s", &CsmaConfig::turnaround_s)
        .def_readwrite("queue_capacity", &CsmaConfig::queue_capacity)
        .def("validate", &CsmaConfig::validate);

    py::class_<MobilityConfig> mobility(module, "MobilityConfig");
    mobility.def(py::init<>())
        .def_readwrite("typename", &MobilityConfig::type_name)
        .def_readwrite("speed_mps", &MobilityConfig::speed_mps)
        .def_readwrite("telemetry_interval_s", &MobilityConfig::telemetry_interval_s)
        .def_readwrite("face_forward", &MobilityConfig::face_forward)
        .def("validate", &MobilityConfig::validate);
    bind_angle(mobility, "initial_heading_rad", &MobilityConfig::initial_orientation,
               &EulerAngles::heading_rad);
    bind_angle(mobility, "initial_elevation_rad", &MobilityConfig::initial_orientation,
               &EulerAngles::elevation_rad);
    bind_angle(mobility, "initial_bank_rad", &MobilityConfig::initial_orientation, &EulerAngles::bank_rad);

    py::class_<InterfaceConfig>(module, "InterfaceConfig")
        .def_readonly("typename", &InterfaceConfig::type_name)  // sets defaults, so only at the start
        .def_readwrite("radio", &InterfaceConfig::radio)
        .def_readwrite("mac", &InterfaceConfig::mac)
        .def_readwrite("csma", &InterfaceConfig::csma)
        .def_property_readonly("known_formats",
                               [](const InterfaceConfig& config) {
                                   std::set<std::string> names;
                                   for (std::size_t format = 0; format < ppdu_format_names.size(); ++format) {
                                       if (known_formats(config).contains(static_cast<PpduFormat>(format))) {
                                           names.insert(ppdu_format_names[format]);
                                       }
                                   }
                                   return names;
                               })
        .def("validate", &InterfaceConfig::validate);

    py::class_<NodeConfig>(module, "NodeConfig")
        .def(py::init<std::string, const std::vector<std::string>&>(), py::arg("name"),
             py::arg("interfaces") = std::vector<std::string>{std::string(ieee80211_interface)})
        .def_readwrite("name", &NodeConfig::name)
        .def_property_readonly(
            "wlan",  // their number is that of the start, so that references to them stay valid
            [](const py::object& self) {
                py::tuple interfaces(self.cast<NodeConfig&>().wlan.size());
                for (std::size_t index = 0; index < interfaces.size(); ++index) {
                    interfaces[index] = py::cast(self.cast<NodeConfig&>().wlan[index],
                                                 py::return_value_policy::reference_internal, self);
                }
                return interfaces;
            })
        .def_readwrite("mobility", &NodeConfig::mobility)
        .def_property(
            "initial_position",
            [](const NodeConfig& config) {
                const Position& position = config.initial_position;
                return py::make_tuple(position.x, position.y, position.z);
            },
            [](NodeConfig& config, const std::array<double, 3>& position) {
                config.initial_position = Position{position[0], position[1], position[2]};
            })
        .def("validate", &NodeConfig::validate);
}

}  // namespace proxy_protocol
