// Draws the parameters of all models of path loss and fading, within and beyond their usual values.
#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>
#include <variant>

#include "netsim/config/medium_config.hpp"
#include "netsim/kernel/random.hpp"

namespace netsim::test {

// Where the default says too little about usual values.
struct UsualRange {
    std::string_view field;
    double low;
    double high;
};
inline constexpr UsualRange usual_ranges[] = {
    {"system_loss", 1, 100}, {"breakpoint_distance_m", 0.5, 500}, {"epsilon_r", 1, 20}, {"sigma_db", 0, 10},
    {"k_db", -20, 30},       {"shape_factor", 0.5, 50},
};

// A fifth of the numbers have their default. Those without a usual range are up to 10 dB, or a factor of 2, from it.
inline void draw_field(const Field& field, MediumConfig& config, RandomStream& draws) {
    static const MediumConfig defaults;
    const Member member = field.of(&config);
    if (auto* const* flag = std::get_if<bool*>(&member)) {
        **flag = draws.uniform() < 0.2;
    } else if (auto* const* name = std::get_if<std::string*>(&member)) {
        **name = field.type.names[draws.uniform_int(static_cast<std::uint32_t>(field.type.names.size()))];
    } else {
        const double value = *std::get<const double*>(field.of(static_cast<const void*>(&defaults)));
        const auto* const usual = std::ranges::find(usual_ranges, field.name, &UsualRange::field);
        const bool is_usual = usual != std::end(usual_ranges);
        const double spread = field.type.unit == "dB" ? 10 : value / 2;
        const double low = is_usual ? usual->low : std::max(value - spread, field.type.least);
        const double high = is_usual ? usual->high : std::min(value + 2 * spread, field.type.most);
        const double drawn = low > 0 && high > 10 * low ? low * std::pow(high / low, draws.uniform())
                                                        : low + draws.uniform() * (high - low);
        *std::get<double*>(member) = draws.uniform() < 0.2 ? value : drawn;
    }
}

// All except the name and the coherence times.
inline void draw_path_loss_parameters(MediumConfig& config, RandomStream& draws) {
    for (const Field& field : MediumConfig::schema.fields) {
        if (MediumConfig::schema.family(field).chosen_by == by_path_loss.chosen_by &&
            field.name != "coherence_time_s") {
            draw_field(field, config, draws);
        }
    }
    if (draws.uniform() < 0.3) {  // the two laws meet; otherwise there is a step up or down
        config.l02_db = config.l01_db + 10 * config.alpha1 * std::log10(config.breakpoint_distance_m);
    }
    config.shadowing_standard_deviation_db = draws.uniform() < 0.5 ? 0 : 10 * draws.uniform();
}

}  // namespace netsim::test
