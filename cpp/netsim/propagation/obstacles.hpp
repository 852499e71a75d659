// What stands between radios, and what it leaves of a signal that goes straight through it.
//
// Two models, by INET's names: IdealObstacleLoss, through which nothing gets, and DielectricObstacleLoss, which weakens
// by the length inside and by the reflections at the faces it goes through, by each obstacle's material. Where obstacles
// overlap, both count. Waves neither bend around corners nor come by way of reflections.
//
// Used by the medium, for each pair of radios of which it wants to know the power. Both ways through are the same to
// the last digit. A tree of boxes finds those few obstacles that a link can meet.
#pragma once

#include <vector>

#include "netsim/config/medium_config.hpp"
#include "netsim/geometry/prism.hpp"
#include "netsim/propagation/material.hpp"

namespace netsim {

class Obstacles {
public:
    // Those of config.obstacles, if config.obstacle_loss names a model; otherwise none.
    explicit Obstacles(const MediumConfig& config);

    bool empty() const { return bodies_.empty(); }

    // Share of the power that is left between `a` and `b`, 0 … 1.
    double gain(const Position& a, const Position& b, double carrier_hz) const;

private:
    // A box that holds all of its part of the tree; its children follow it, the second one at `next`.
    struct Box {
        Position lowest;
        Position highest;
        std::size_t next = 0;   // the first box behind this part of the tree
        std::size_t first = 0;  // of the bodies
        std::size_t count = 0;  // of the bodies, if it has no children; otherwise 0
    };
    struct MaterialsAt {
        double carrier_hz;
        std::vector<Material> materials;  // of each body
    };

    void build(std::size_t first, std::size_t count);
    Box box_around(std::size_t first, std::size_t count) const;
    const std::vector<Material>& materials_at(double carrier_hz) const;
    double gain_through(std::size_t body, const std::vector<Material>& materials) const;

    bool blocks_all_ = false;
    bool enable_dielectric_loss_ = true;
    bool enable_reflection_loss_ = true;
    std::vector<ObstacleConfig> configs_;  // of each body
    std::vector<Prism> bodies_;
    std::vector<Box> boxes_;
    mutable std::vector<MaterialsAt> materials_;  // for each carrier so far
    mutable Crossing crossing_;                   // working memory
};

}  // namespace netsim
