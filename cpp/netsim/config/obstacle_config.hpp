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

inline constexpr std::string_view dielectric_obstacle_loss = "DielectricObstacleLoss";
inline constexpr std::array<std::string_view, 3> obstacle_loss_names{"", "IdealObstacleLoss",
                                                                     dielectric_obstacle_loss};

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

}  // namespace netsim
