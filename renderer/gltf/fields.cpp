#include <fmt/format.h>

#include <cmath>

#include "renderer/gltf/rules.h"

namespace si::gltf {
namespace {

std::string shown(const Json& value) {
    if (value.is_array()) return fmt::format("an array of {}", value.size());
    if (value.is_object()) return "an object";
    if (value.is_string()) return fmt::format("\"{}\"", value.get_ref<const std::string&>().substr(0, 40));
    return value.dump();
}

}  // namespace

std::size_t checked_index(const Context& context, const Json& value, const Place& place, std::size_t size) {
    if (!value.is_number_unsigned()) {
        context.fail(place, fmt::format("{} is not an index", shown(value)));
    }
    const auto number = value.get<std::uint64_t>();
    if (number >= size) {
        context.fail(place, fmt::format("index {} is out of range, there are {}", number, size));
    }
    return std::size_t(number);
}

Fields::Fields(const Context& context, const Json& object, const Place& place)
    : context_(context), object_(object), place_(place) {
    if (!object.is_object()) context.fail(place, fmt::format("{} where an object is expected", shown(object)));
}

std::optional<std::uint64_t> Fields::whole(const char* key, std::uint64_t most) const {
    const auto it = object_.find(key);
    if (it == object_.end()) return std::nullopt;
    const Place here(place_, key);
    if (!it->is_number_unsigned()) {
        context_.fail(here, fmt::format("{} is not a whole number of at least 0", shown(*it)));
    }
    const auto number = it->get<std::uint64_t>();
    if (number > most) context_.fail(here, fmt::format("{} is more than the greatest possible value {}", number, most));
    return number;
}

std::optional<std::size_t> Fields::index(const char* key, std::size_t size) const {
    const auto it = object_.find(key);
    if (it == object_.end()) return std::nullopt;
    return checked_index(context_, *it, Place(place_, key), size);
}

void Fields::fail_missing(const char* key) const {
    context_.fail(Place(place_, key), "is missing");
}

std::optional<std::string> Fields::string(const char* key) const {
    const auto it = object_.find(key);
    if (it == object_.end()) return std::nullopt;
    if (!it->is_string()) context_.fail(Place(place_, key), fmt::format("{} is not a string", shown(*it)));
    return it->get<std::string>();
}

std::optional<std::vector<double>> Fields::numbers(const char* key, std::size_t n) const {
    const auto it = object_.find(key);
    if (it == object_.end()) return std::nullopt;
    const Place here(place_, key);
    if (!it->is_array() || it->size() != n) {
        context_.fail(here, fmt::format("{} where {} numbers are expected", shown(*it), n));
    }
    std::vector<double> out;
    out.reserve(n);
    for (const auto& value : *it) {
        if (!value.is_number() || !std::isfinite(value.get<double>())) {
            context_.fail(here, fmt::format("{} is not a number", shown(value)));
        }
        out.push_back(value.get<double>());
    }
    return out;
}

std::vector<std::size_t> Fields::indices(const char* key, std::size_t size) const {
    const auto it = object_.find(key);
    if (it == object_.end()) return {};
    if (!it->is_array()) context_.fail(Place(place_, key), fmt::format("{} where an array is expected", shown(*it)));
    std::vector<std::size_t> out;
    out.reserve(it->size());
    for (std::size_t i = 0; i < it->size(); ++i) {
        out.push_back(checked_index(context_, (*it)[i], Place(place_, key, i), size));
    }
    return out;
}

const Json& Fields::object(const char* key) const {
    const auto it = object_.find(key);
    if (it == object_.end()) fail_missing(key);
    if (!it->is_object()) context_.fail(Place(place_, key), fmt::format("{} where an object is expected", shown(*it)));
    return *it;
}

}  // namespace si::gltf
