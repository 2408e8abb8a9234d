#include "app/session/claims.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "app/base/json_text.h"
#include "renderer/base/did_you_mean.h"
#include "renderer/base/error.h"
#include "renderer/base/printable.h"
#include "renderer/settings/param.h"

namespace si {
namespace {

constexpr std::array<std::string_view, 5> kOperators = {"<", "<=", "==", ">=", ">"};
constexpr int kMaxSide = 4096;

/// Reads a member of type T. @throws Error
template <class T>
void read(const Json& value, const std::string& place, T& out) {
    try {
        out = value.get<T>();
    } catch (const Json::exception&) {
        throw Error(place + ": has the wrong type");
    }
}

std::vector<int> read_size(const Json& value, const std::string& place) {
    const auto is_side = [](const Json& side) { return side.is_number_unsigned() && side >= 1 && side <= kMaxSide; };
    if (!value.is_array() || value.size() != 2 || !std::ranges::all_of(value, is_side))
        throw Error(fmt::format("{}: must be [width, height] of 1 to {} pixels", place, kMaxSide));
    return value.get<std::vector<int>>();
}

void read_object(const Json& object, const std::string& place, ClaimSubject& subject, PresetClaim* claim) {
    if (!object.is_object()) throw Error(place + ": must be an object {\"metric\": ...}");
    std::vector<std::string> known = {"metric", "preset", "set", "receivers", "casters", "size"};
    if (claim) known.insert(known.end(), {"op", "value", "times", "than", "why"});
    for (const auto& [key, value] : object.items()) {
        const std::string member = fmt::format("{}.{}", place, printable(key, 60));
        if (std::ranges::find(known, key) == known.end())
            throw Error(member + ": unknown member" + did_you_mean(nearest_name(key, known)));
        if (key == "metric") read(value, member, subject.metric);
        if (key == "preset") read(value, member, subject.preset);
        if (key == "set") read(value, member, subject.set);
        if (key == "receivers") read(value, member, subject.receivers);
        if (key == "casters") read(value, member, subject.casters);
        if (key == "size") subject.size = read_size(value, member);
        if (key == "op") read(value, member, claim->op);
        if (key == "value") read(value, member, claim->value);
        if (key == "times") read(value, member, claim->times);
        if (key == "why") read(value, member, claim->why);
    }
    if (subject.metric.empty()) throw Error(place + ": names no \"metric\"");
    if (!claim) return;
    if (std::ranges::find(kOperators, claim->op) == kOperators.end())
        throw Error(fmt::format("{}.op: must be one of {}", place, fmt::join(kOperators, ", ")));
    if (!object.contains("than")) return;
    claim->than = subject;
    read_object(object["than"], place + ".than", *claim->than, nullptr);
}

}  // namespace

std::vector<PresetClaim> read_claims(const Json& list) {
    if (!list.is_array()) throw Error("claims: must be an array of objects {\"metric\": ...}");
    std::vector<PresetClaim> claims;
    for (const Json& object : list) {
        PresetClaim claim;
        read_object(object, fmt::format("claims[{}]", claims.size()), claim.subject, &claim);
        claim.text = object.dump(-1, ' ', false, Json::error_handler_t::replace);
        claims.push_back(std::move(claim));
    }
    return claims;
}

}  // namespace si
