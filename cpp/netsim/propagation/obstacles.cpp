#include "netsim/propagation/obstacles.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

namespace netsim {

namespace {

// Boxes are larger than their contents by this margin, for rounding.
constexpr double margin_m = 1e-6;

double coordinate(const Position& place, int axis) {
    return axis == 0 ? place.x : (axis == 1 ? place.y : place.z);
}

bool is_before(const Position& a, const Position& b) {
    return a.x != b.x ? a.x < b.x : (a.y != b.y ? a.y < b.y : a.z < b.z);
}

// A test of a segment, given by its middle and half its extent, against boxes by separating axes:
// the axes of the box, and their cross products with the segment's direction. C. Ericson,
// "Real-Time Collision Detection", 2005, 5.3.3.
class Probe {
public:
    Probe(const Position& a, const Position& b)
        : middle_((a + b) * 0.5),
          half_((b - a) * 0.5),
          reach_{std::abs(half_.x), std::abs(half_.y), std::abs(half_.z)} {}

    bool may_meet(const Position& lowest, const Position& highest) const {
        const Position extent = (highest - lowest) * 0.5 + Position{margin_m, margin_m, margin_m};
        const Position off = middle_ - (lowest + highest) * 0.5;
        if (std::abs(off.x) > extent.x + reach_.x || std::abs(off.y) > extent.y + reach_.y ||
            std::abs(off.z) > extent.z + reach_.z) {
            return false;
        }
        return std::abs(off.y * half_.z - off.z * half_.y) <= extent.y * reach_.z + extent.z * reach_.y &&
               std::abs(off.z * half_.x - off.x * half_.z) <= extent.x * reach_.z + extent.z * reach_.x &&
               std::abs(off.x * half_.y - off.y * half_.x) <= extent.x * reach_.y + extent.y * reach_.x;
    }

private:
    Position middle_;
    Position half_;
    Position reach_;
};

}  // namespace

Obstacles::Obstacles(const MediumConfig& config)
    : enable_dielectric_loss_(config.enable_dielectric_loss),
      enable_reflection_loss_(config.enable_reflection_loss) {
    if (config.obstacle_loss.empty() || config.obstacles.empty()) {
        return;
    }
    constexpr Factory<Loss> losses[] = {
        {"IdealObstacleLoss", &Obstacles::ideal_gain},
        {"DielectricObstacleLoss", &Obstacles::dielectric_gain},
    };
    static_assert(makes_all(losses, std::span(obstacle_losses).subspan<1>()));
    loss_ = factory_of(config.obstacle_loss, losses);
    configs_ = config.obstacles;
    for (const ObstacleConfig& obstacle : configs_) {
        indices_.push_back(bodies_.size());
        bodies_.emplace_back(obstacle.rings, obstacle.base_m, obstacle.top_m);
    }
    build(0, bodies_.size());
}

Obstacles::Box Obstacles::box_around(std::size_t first, std::size_t count) const {
    Box box{.lowest = bodies_[first].lowest(), .highest = bodies_[first].highest(), .first = first};
    for (std::size_t body = first + 1; body < first + count; ++body) {
        const Position lowest = bodies_[body].lowest();
        const Position highest = bodies_[body].highest();
        box.lowest = {std::min(box.lowest.x, lowest.x), std::min(box.lowest.y, lowest.y),
                      std::min(box.lowest.z, lowest.z)};
        box.highest = {std::max(box.highest.x, highest.x), std::max(box.highest.y, highest.y),
                       std::max(box.highest.z, highest.z)};
    }
    return box;
}

// Halves the bodies along the longer horizontal axis until few are left.
void Obstacles::build(std::size_t first, std::size_t count) {
    constexpr std::size_t few = 2;
    const std::size_t here = boxes_.size();
    boxes_.push_back(box_around(first, count));
    if (count <= few) {
        boxes_[here].count = count;
    } else {
        const Position size = boxes_[here].highest - boxes_[here].lowest;
        const int axis = size.x >= size.y ? 0 : 1;
        std::vector<std::size_t> order(count);
        for (std::size_t i = 0; i < count; ++i) {
            order[i] = first + i;
        }
        std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
            return coordinate(bodies_[a].lowest() + bodies_[a].highest(), axis) <
                   coordinate(bodies_[b].lowest() + bodies_[b].highest(), axis);
        });
        std::vector<Prism> bodies;
        std::vector<ObstacleConfig> configs;
        std::vector<std::size_t> indices;
        for (const std::size_t body : order) {
            bodies.push_back(std::move(bodies_[body]));
            configs.push_back(std::move(configs_[body]));
            indices.push_back(indices_[body]);
        }
        std::move(bodies.begin(), bodies.end(), bodies_.begin() + static_cast<std::ptrdiff_t>(first));
        std::move(configs.begin(), configs.end(), configs_.begin() + static_cast<std::ptrdiff_t>(first));
        std::ranges::copy(indices, indices_.begin() + static_cast<std::ptrdiff_t>(first));
        build(first, count / 2);
        build(first + count / 2, count - count / 2);
    }
    boxes_[here].next = boxes_.size();
}

const std::vector<Material>& Obstacles::materials_at(double carrier_hz) const {
    for (const MaterialsAt& known : materials_) {
        if (known.carrier_hz == carrier_hz) {
            return known.materials;
        }
    }
    MaterialsAt& added = materials_.emplace_back(MaterialsAt{carrier_hz, {}});
    for (const ObstacleConfig& config : configs_) {
        added.materials.push_back(make_material(config, carrier_hz));
    }
    return added.materials;
}

template <typename Visit>
void Obstacles::visit(const Position& a, const Position& b, double carrier_hz, Visit visit) const {
    if (bodies_.empty()) {
        return;
    }
    const bool forward = is_before(a, b);
    const Position& from = forward ? a : b;
    const Position& to = forward ? b : a;
    const std::vector<Material>& materials = materials_at(carrier_hz);
    const Probe probe(from, to);
    for (std::size_t i = 0; i < boxes_.size();) {
        const Box& box = boxes_[i];
        if (!probe.may_meet(box.lowest, box.highest)) {
            i = box.next;
            continue;
        }
        for (std::size_t body = box.first; body < box.first + box.count; ++body) {
            bodies_[body].cross(from, to, crossing_);
            if (!visit(body, gain_through(body, materials))) {
                return;
            }
        }
        ++i;
    }
}

double Obstacles::gain(const Position& a, const Position& b, double carrier_hz) const {
    double gain = 1;
    visit(a, b, carrier_hz, [&gain](std::size_t /*body*/, double of_body) {
        gain *= of_body;
        return gain > 0;
    });
    return gain;
}

std::vector<PowerBudget::Obstacle> Obstacles::crossed(const Position& a, const Position& b,
                                                      double carrier_hz) const {
    std::vector<PowerBudget::Obstacle> crossed;
    visit(a, b, carrier_hz, [&](std::size_t body, double gain) {
        if (!crossing_.stretches().empty()) {
            crossed.push_back({indices_[body], gain});
        }
        return true;
    });
    return crossed;
}

double Obstacles::gain_through(std::size_t body, const std::vector<Material>& materials) const {
    return crossing_.stretches().empty() ? 1 : (this->*loss_)(materials[body]);
}

double Obstacles::ideal_gain(const Material& /*material*/) const {
    return 0;
}

double Obstacles::dielectric_gain(const Material& material) const {
    double gain = 1;
    for (const Stretch& stretch : crossing_.stretches()) {
        if (enable_dielectric_loss_) {
            gain *= material.gain_through(stretch.length_m);
        }
        if (enable_reflection_loss_) {
            for (const double cosine : {stretch.entry_cosine, stretch.exit_cosine}) {
                if (cosine != Stretch::no_face) {
                    gain *= material.gain_at_face(std::min(cosine, 1.0));
                }
            }
        }
    }
    return gain;
}

}  // namespace netsim
