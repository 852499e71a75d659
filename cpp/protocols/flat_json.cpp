#include "protocols/flat_json.hpp"

#include <charconv>
#include <utility>

namespace netsim {

namespace {

class Reader {
public:
    explicit Reader(std::string_view text) : rest_(text) {}

    // Consumes white space, and `token` if it comes next. Returns whether it did.
    bool take(std::string_view token) {
        const std::size_t begin = rest_.find_first_not_of(" \t\n\r");
        rest_.remove_prefix(begin == std::string_view::npos ? rest_.size() : begin);
        if (!rest_.starts_with(token)) {
            return false;
        }
        rest_.remove_prefix(token.size());
        return true;
    }

    std::optional<std::string> take_text() {
        const std::size_t end = take("\"") ? rest_.find_first_of("\"\\") : std::string_view::npos;
        if (end == std::string_view::npos || rest_[end] == '\\') {
            return std::nullopt;
        }
        std::string text(rest_.substr(0, end));
        rest_.remove_prefix(end + 1);
        return text;
    }

    std::optional<FlatJsonValue> take_value() {
        if (take("true")) {
            return true;
        }
        if (take("false")) {
            return false;
        }
        if (rest_.starts_with('"')) {
            if (std::optional<std::string> text = take_text()) {
                return std::move(*text);
            }
            return std::nullopt;
        }
        std::int64_t number = 0;
        const auto [end, error] = std::from_chars(rest_.data(), rest_.data() + rest_.size(), number);
        if (error != std::errc()) {
            return std::nullopt;
        }
        rest_.remove_prefix(static_cast<std::size_t>(end - rest_.data()));
        return number;
    }

    bool is_at_end() const { return rest_.empty(); }

private:
    std::string_view rest_;
};

}  // namespace

std::optional<FlatJson> parse_flat_json(std::string_view text) {
    Reader reader(text);
    FlatJson object;
    if (!reader.take("{")) {
        return std::nullopt;
    }
    bool ended = reader.take("}");
    while (!ended) {
        std::optional<std::string> name = reader.take_text();
        if (!name || !reader.take(":")) {
            return std::nullopt;
        }
        std::optional<FlatJsonValue> value = reader.take_value();
        if (!value) {
            return std::nullopt;
        }
        object.insert_or_assign(std::move(*name), std::move(*value));
        ended = reader.take("}");
        if (!ended && !reader.take(",")) {
            return std::nullopt;
        }
    }
    // Only white space, which take("") consumes, may follow.
    return reader.take("") && reader.is_at_end() ? std::optional(std::move(object)) : std::nullopt;
}

}  // namespace netsim
