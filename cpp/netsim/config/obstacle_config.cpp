#include "netsim/config/obstacle_config.hpp"

#include "netsim/config/check.hpp"

namespace netsim {
namespace {

constexpr std::array dielectric{dielectric_obstacle_loss};
constexpr ReadBy with_dielectric{"medium.obstacle_loss", dielectric, dielectric[0]};
constexpr ValueType height = quantity("m").at_least(-largest_coordinate_m).at_most(largest_coordinate_m);

constexpr Field fields[] = {
    // Scenario files have other keys for the body, which is made of them.
    {NETSIM_FIELD(ObstacleConfig, base_m), "", height, ""},
    {NETSIM_FIELD(ObstacleConfig, top_m), "", height, ""},
    {NETSIM_FIELD(ObstacleConfig, material), "material", one_of(material_names), "what it is made of",
     with_dielectric},
    {NETSIM_FIELD(ObstacleConfig, relative_permittivity), "relativePermittivity",
     number().at_least(1).or_special(-1, "that of the material"),
     "relative permittivity; -1: that of the material", with_dielectric},
    {NETSIM_FIELD(ObstacleConfig, conductivity_spm), "conductivity",
     number().at_least(0).or_special(-1, "that of the material"),
     "conductivity in S/m; -1: that of the material", with_dielectric},
};
constexpr ReadBy with_obstacle_loss{"medium.obstacle_loss", std::span(obstacle_loss_names).last(2), ""};

}  // namespace

const Schema ObstacleConfig::schema{"obstacle", "environment.obstacle[0]", false, fields, with_obstacle_loss};

void ObstacleConfig::validate() const {
    if (rings.empty()) {
        throw ConfigError("obstacle.rings = []: expected the footprint, at least one ring of corners");
    }
    for (const Ring& ring : rings) {
        if (ring.size() < 3) {
            throw ConfigError("obstacle.rings: a ring of " + std::to_string(ring.size()) +
                              " corners: expected at least 3");
        }
        for (const Corner& corner : ring) {
            for (const double coordinate : corner) {
                check_between("obstacle.rings", coordinate, -largest_coordinate_m, largest_coordinate_m, "m");
            }
        }
    }
    check_fields(*this);
    check_greater("obstacle.top_m", top_m, base_m, "m");
}

}  // namespace netsim
