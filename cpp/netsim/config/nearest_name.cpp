#include "netsim/config/nearest_name.hpp"

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <vector>

#include "netsim/error.hpp"

namespace netsim {
namespace {

char lower(char letter) {
    return letter >= 'A' && letter <= 'Z' ? static_cast<char>(letter - 'A' + 'a') : letter;
}

std::size_t edit_distance(std::string_view from, std::string_view to) {
    // distances[j]: from the letters of `from` seen so far to the first j letters of `to`.
    std::vector<std::size_t> distances(to.size() + 1);
    std::iota(distances.begin(), distances.end(), std::size_t{0});
    for (const char letter : from) {
        std::size_t diagonal = distances[0]++;
        for (std::size_t j = 0; j < to.size(); ++j) {
            const std::size_t replaced = diagonal + (lower(letter) == lower(to[j]) ? 0 : 1);
            diagonal = distances[j + 1];
            distances[j + 1] = std::min({replaced, diagonal + 1, distances[j] + 1});
        }
    }
    return distances.back();
}

}  // namespace

std::string_view nearest_name(std::string_view name, std::span<const std::string_view> names) {
    NETSIM_ASSERT(!names.empty());
    return *std::ranges::min_element(names, [name](std::string_view a, std::string_view b) {
        return edit_distance(name, a) < edit_distance(name, b);
    });
}

}  // namespace netsim
