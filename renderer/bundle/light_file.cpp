#include "renderer/bundle/light_file.h"

#include <fmt/format.h>

#include <array>
#include <nlohmann/json.hpp>
#include <string>

#include "renderer/base/error.h"
#include "renderer/base/json_shape.h"
#include "renderer/base/printable.h"
#include "renderer/bundle/bundle_json.h"

namespace si {
namespace {

using LightJson = nlohmann::json;

[[noreturn]] void refuse_light(std::string_view file, std::string_view what, std::string_view fix) {
    throw Error(fmt::format("{}: {}; {}", printable(file, 300), what, fix));
}

LightJson parse_light_json(std::string_view text, std::string_view file) {
    constexpr int kDeepest = 32;
    if (text.size() > kMaxFrameJsonBytes)
        refuse_light(file, fmt::format("the file has {} bytes", text.size()), "give one light");
    if (json_shape(text).depth > kDeepest) refuse_light(file, "the JSON nests too deep", "give one light");
    if (text.starts_with("\xef\xbb\xbf")) text.remove_prefix(3);
    try {
        return LightJson::parse(text.begin(), text.end());
    } catch (const LightJson::exception& error) {
        std::string_view what = error.what();
        if (const auto bracket = what.find("] "); bracket != std::string_view::npos) what.remove_prefix(bracket + 2);
        refuse_light(file, printable(what, 200), "repair the JSON");
    }
}

/// Returns a member that is an object, made where it is missing; null for another value, which the parser refuses.
LightJson* object_member(LightJson& parent, const char* name) {
    LightJson& member = parent[name];
    if (member.is_null()) member = LightJson::object();
    return member.is_object() ? &member : nullptr;
}

/// Adds what frame.json requires of a map, and marks what the file states.
void complete_map(LightJson& map, std::string_view image_file, bool first, KnownConvention& known) {
    if (!map.is_object()) return;
    bool states_range = false, states_reversed = false, states_stored = false, states_row = false;
    if (LightJson* const image = object_member(map, "image")) {
        states_row = image->contains("first_row");
        (*image)["file"] = image_file;
    }
    if (LightJson* const depth = object_member(map, "depth")) {
        states_range = depth->contains("range");
        states_reversed = depth->contains("reversed");
        states_stored = depth->contains("stored");
        if (!states_range) (*depth)["range"] = "0..1";
    }
    // The maps of one light have one convention, and the first states it.
    if (!first) return;
    if (states_range) known.zero_to_one.emplace();
    if (states_reversed) known.reversed.emplace();
    if (states_stored) known.stored.emplace();
    if (states_row) known.first_row.emplace();
}

}  // namespace

LightFile parse_light_file(std::string_view text, std::string_view file, std::string_view image_file) {
    LightJson light = parse_light_json(text, file);
    if (!light.is_object()) refuse_light(file, "the file holds no object", "give a light as in lights of frame.json");
    if (light.contains("lights"))
        refuse_light(file, "the file holds lights, as a frame.json does", "give one light, or open it as a bundle");
    LightJson frame = {{"bundle", 1}};
    if (light.contains("world")) {
        frame["world"] = light["world"];
        light.erase("world");
    }
    LightFile out;
    out.type_known = light.contains("type");
    if (!out.type_known)
        light["type"] = light.contains("position") || light.contains("cone_deg") ? "spot" : "directional";
    constexpr std::array kOfMap = {"image",      "region", "clip_from_world", "view",     "world_from_view",
                                   "projection", "depth",  "raster",          "interval", "drawn"};
    if (!light.contains("maps")) {
        LightJson map = LightJson::object();
        for (const char* name : kOfMap)
            if (light.contains(name)) {
                map[name] = light[name];
                light.erase(name);
            }
        light["maps"] = LightJson::array({map});
    }
    if (light["maps"].is_array()) {
        if (light["maps"].empty()) refuse_light(file, "the light has no map", "give its matrix");
        bool first = true;
        for (LightJson& map : light["maps"]) {
            complete_map(map, image_file, first, out.known);
            first = false;
        }
    }
    frame["lights"] = LightJson::array({light});
    out.bundle = parse_bundle(frame.dump(), file);
    const BundleMap& map = out.bundle.lights.front().maps.front();
    if (out.known.zero_to_one) out.known.zero_to_one = map.depth.convention.zero_to_one;
    if (out.known.reversed) out.known.reversed = map.depth.convention.reversed;
    if (out.known.stored) out.known.stored = map.depth.stored;
    if (out.known.first_row) out.known.first_row = map.image.first_row;
    return out;
}

}  // namespace si
