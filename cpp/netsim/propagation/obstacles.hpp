// Obstacles between radios, and the loss of a signal that passes straight through them.
//
// Two models, by INET's names. IdealObstacleLoss blocks everything. DielectricObstacleLoss
// attenuates by the length inside and by reflection at the faces, depending on each obstacle's
// material. Where obstacles overlap, both count. There is no diffraction around corners, and no
// reflected path.
//
// Used by the medium for pairs of radios. Both directions give the same result to the last digit. A
// bounding volume tree finds the few obstacles that a link can meet.
#pragma once

#include <vector>

#include "netsim/config/medium_config.hpp"
#include "netsim/geometry/prism.hpp"
#include "netsim/propagation/material.hpp"
#include "netsim/trace/power_budget.hpp"

namespace netsim {

class Obstacles {
public:
    // The obstacles of config.obstacles if config.obstacle_loss names a model; otherwise none.
    explicit Obstacles(const MediumConfig& config);

    bool empty() const { return bodies_.empty(); }

    // The ratio of the power that is left between `a` and `b`, 0 … 1.
    double gain(const Position& a, const Position& b, double carrier_hz) const;
    // The obstacles on that line, with the gain of each.
    std::vector<PowerBudget::Obstacle> crossed(const Position& a, const Position& b, double carrier_hz) const;

private:
    // The bounding box of a subtree. Its first child follows it; the subtree ends before `next`.
    struct Box {
        Position lowest;
        Position highest;
        std::size_t next = 0;   // the first box after this subtree
        std::size_t first = 0;  // of the bodies
        std::size_t count = 0;  // of the bodies of a leaf; 0 otherwise
    };
    struct MaterialsAt {
        double carrier_hz;
        std::vector<Material> materials;  // of each body
    };

    void build(std::size_t first, std::size_t count);
    Box box_around(std::size_t first, std::size_t count) const;
    const std::vector<Material>& materials_at(double carrier_hz) const;
    // Calls `visit` with the index and the gain of each body that the line may meet, until it returns false.
    template <typename Visit>
    void visit(const Position& a, const Position& b, double carrier_hz, Visit visit) const;
    double gain_through(std::size_t body, const std::vector<Material>& materials) const;

    // The gain through one body of that material, by the crossing that was found last.
    using Loss = double (Obstacles::*)(const Material&) const;
    double ideal_gain(const Material& material) const;
    double dielectric_gain(const Material& material) const;

    Loss loss_ = nullptr;
    bool enable_dielectric_loss_ = true;
    bool enable_reflection_loss_ = true;
    std::vector<ObstacleConfig> configs_;  // of each body
    std::vector<std::size_t> indices_;     // of each body, in MediumConfig::obstacles
    std::vector<Prism> bodies_;
    std::vector<Box> boxes_;
    mutable std::vector<MaterialsAt> materials_;  // for each carrier so far
    mutable Crossing crossing_;                   // working memory
};

}  // namespace netsim
