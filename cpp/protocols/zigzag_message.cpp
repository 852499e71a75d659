#include "protocols/zigzag_message.hpp"

#include <limits>
#include <memory>
#include <optional>
#include <string_view>

#include "netsim/error.hpp"
#include "protocols/flat_json.hpp"

namespace netsim::zigzag {

namespace {

// One visitor lists the fields of each message, for writing and reading.
template <typename Visitor>
void visit_fields(Visitor&& visitor, UavHeartbeat& message) {
    visitor("sender", message.sender);
    visitor("homeward", message.homeward);
    visitor("available", message.available);
}
template <typename Visitor>
void visit_fields(Visitor&& visitor, GroundHeartbeat& message) {
    visitor("sender", message.sender);
}
template <typename Visitor>
void visit_fields(Visitor&& visitor, SensorData& message) {
    visitor("sender", message.sender);
}
template <typename Visitor>
void visit_fields(Visitor&& visitor, PairRequest& message) {
    visitor("sender", message.sender);
    visitor("carrier", message.carrier);
    visitor("given", message.given);
}
template <typename Visitor>
void visit_fields(Visitor&& visitor, PairConfirmation& message) {
    visitor("sender", message.sender);
    visitor("carrier", message.carrier);
    visitor("given", message.given);
}

constexpr std::string_view type_names[] = {"UavHeartbeat", "GroundHeartbeat", "SensorData", "PairRequest",
                                           "PairConfirmation"};

struct Writer {
    std::string text;

    void operator()(std::string_view name, bool value) { add(name, value ? "true" : "false"); }
    void operator()(std::string_view name, NodeId value) { add(name, std::to_string(value)); }
    void operator()(std::string_view name, std::int64_t value) { add(name, std::to_string(value)); }
    void add(std::string_view name, std::string_view value) {
        text.append(",\"").append(name).append("\":").append(value);
    }
};

// Fills the fields of a message. `complete`: whether each was present with the right type.
struct FieldReader {
    const FlatJson& object;
    std::size_t fields = 0;
    bool complete = true;

    void operator()(std::string_view name, bool& value) { read(name, value); }
    void operator()(std::string_view name, std::int64_t& value) { read(name, value); }
    void operator()(std::string_view name, NodeId& value) {
        std::int64_t number = 0;
        read(name, number);
        complete = complete && number >= 0 && number <= std::numeric_limits<NodeId>::max();
        value = static_cast<NodeId>(number);
    }
    template <typename Value>
    void read(std::string_view name, Value& value) {
        ++fields;
        const auto found = object.find(name);
        const Value* given = found == object.end() ? nullptr : std::get_if<Value>(&found->second);
        complete = complete && given != nullptr;
        if (given != nullptr) {
            value = *given;
        }
    }
};

template <std::size_t Index = 0>
std::optional<Message> message_of(std::string_view type, const FlatJson& object) {
    if constexpr (Index < std::variant_size_v<Message>) {
        if (type != type_names[Index]) {
            return message_of<Index + 1>(type, object);
        }
        std::variant_alternative_t<Index, Message> message;
        FieldReader reader{object};
        visit_fields(reader, message);
        if (reader.complete && object.size() == reader.fields + 1) {
            return message;
        }
    }
    return std::nullopt;
}

}  // namespace

Payload encode(const Message& message) {
    Writer writer;
    writer.text.append(R"({"type":")").append(type_names[message.index()]).append("\"");
    Message copy = message;
    std::visit([&writer](auto& fields) { visit_fields(writer, fields); }, copy);
    writer.text += '}';
    return std::make_shared<const std::string>(std::move(writer.text));
}

Message decode(const std::string& text) {
    if (const std::optional<FlatJson> object = parse_flat_json(text)) {
        const auto type = object->find("type");
        const std::string* name = type == object->end() ? nullptr : std::get_if<std::string>(&type->second);
        const std::optional<Message> message = name == nullptr ? std::nullopt : message_of(*name, *object);
        if (message) {
            return *message;
        }
    }
    throw SimulationError("not a message of ZigZag: '" + text + "'");
}

}  // namespace netsim::zigzag
