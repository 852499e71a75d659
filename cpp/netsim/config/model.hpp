// Tables of models: one for each family, next to the field that chooses a model of it by name.
//
// A row says what the model reads. From the rows follow the names that .ini files accept and the models that read a
// field. The class of each model is in a table of factories next to its code, which the compiler compares with this one.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <string_view>

#include "netsim/error.hpp"

namespace netsim {

struct Model {
    // What besides the distance decides the gain of a path loss.
    enum class Effect { none, ground, shadowing, fading };

    std::string_view name;  // in .ini files; "" for no model
    // The fields that it reads: names of C++ and Python, "alpha". A field of another struct has the name of that struct
    // in front, "radio.noise_figure". The name of a struct alone, "radio", means all its fields that every model reads.
    std::array<std::string_view, 10> reads = {};
    Effect effect = Effect::none;

    constexpr bool does_read(std::string_view field) const {
        return std::ranges::find(reads, field) != reads.end();
    }
};

template <std::size_t Count>
constexpr std::array<std::string_view, Count> names_of(const Model (&models)[Count]) {
    std::array<std::string_view, Count> names;
    std::ranges::transform(models, names.begin(), &Model::name);
    return names;
}

// The row of a name that is in the table.
constexpr const Model& model_named(std::string_view name, std::span<const Model> models) {
    const auto found = std::ranges::find(models, name, &Model::name);
    NETSIM_ASSERT(found != models.end());
    return *found;
}

// How to make the model of that name.
template <typename Make>
struct Factory {
    std::string_view name;
    Make make;
};

// Whether there is a factory for each of these models, and for nothing else.
template <typename Make, std::size_t Count, typename Models>
constexpr bool makes_all(const Factory<Make> (&factories)[Count], Models&& models) {
    return std::ranges::is_permutation(factories, models, {}, &Factory<Make>::name, &Model::name);
}

// The factory of a name that is in the table.
template <typename Make, std::size_t Count>
constexpr Make factory_of(std::string_view name, const Factory<Make> (&factories)[Count]) {
    const auto* const found = std::ranges::find(factories, name, &Factory<Make>::name);
    NETSIM_ASSERT(found != std::end(factories));
    return found->make;
}

}  // namespace netsim
