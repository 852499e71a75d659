// One obstacle to radio waves: a body with vertical walls, of one material. What `*.environment.…` sets in an .ini file,
// or a feature of a GeoJSON file. Used by the medium.
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "netsim/config/field.hpp"
#include "netsim/geometry/prism.hpp"

namespace netsim {

// Those of ITU-R P.2040-3, table 3; see material.hpp.
inline constexpr std::array<std::string_view, 10> material_names{
    "concrete", "brick",        "plasterboard", "wood",    "glass",
    "marble",   "ceilingBoard", "chipboard",    "plywood", "metal"};

inline constexpr Model obstacle_losses[] = {
    {""},
    {"IdealObstacleLoss", {"obstacle"}},
    {"DielectricObstacleLoss",
     {"obstacle", "obstacle.material", "obstacle.relative_permittivity", "obstacle.conductivity_spm",
      "enable_dielectric_loss", "enable_reflection_loss"}},
};
inline constexpr auto obstacle_loss_names = names_of(obstacle_losses);
inline constexpr ReadBy by_obstacle_loss{"medium.obstacle_loss", obstacle_losses};

struct ObstacleConfig {
    std::string name = "obstacle";  // for people
    std::vector<Ring> rings;  // the footprint; courtyards are rings inside of others; m, within the scene
    double base_m = 0;        // z of the floor
    double top_m = 0;         // z of the roof, > base_m
    std::string material = "concrete";
    double relative_permittivity = -1;  // -1: the material's
    double conductivity_spm = -1;       // S/m; -1: the material's

    static const Schema schema;

    // Throws ConfigError for the first field out of its range: "obstacle.top_m = -1 m: expected …".
    void validate() const;
};

namespace obstacle_values {
inline constexpr ValueType height =
    quantity("m").at_least(-largest_coordinate_m).at_most(largest_coordinate_m);
}  // namespace obstacle_values

inline constexpr Field obstacle_fields[] = {
    // Scenario files have other keys for the body, which is made of them.
    {NETSIM_FIELD(ObstacleConfig, base_m), "", obstacle_values::height, ""},
    {NETSIM_FIELD(ObstacleConfig, top_m), "", obstacle_values::height, ""},
    {NETSIM_FIELD(ObstacleConfig, material), "material", one_of(material_names), "what it is made of",
     by_obstacle_loss},
    {NETSIM_FIELD(ObstacleConfig, relative_permittivity), "relativePermittivity",
     number().at_least(1).or_special(-1, "that of the material"),
     "relative permittivity; -1: that of the material", by_obstacle_loss},
    {NETSIM_FIELD(ObstacleConfig, conductivity_spm), "conductivity",
     number().at_least(0).or_special(-1, "that of the material"),
     "conductivity in S/m; -1: that of the material", by_obstacle_loss},
};

inline constexpr Schema ObstacleConfig::schema{"obstacle", "environment.obstacle[0]", false, obstacle_fields,
                                               by_obstacle_loss};

}  // namespace netsim
