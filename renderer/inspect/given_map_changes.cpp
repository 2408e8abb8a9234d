#include "renderer/inspect/given_map_changes.h"

#include <algorithm>
#include <array>

namespace si {
namespace {

/// Settings and groups of settings (a dot at the end) that act while maps are fitted or drawn.
constexpr std::array<std::string_view, 14> kWhileDrawing = {
    "map.resolution",     "map.format",       "map.samples",       "map.reversed_z",
    "map.origin",         "map.virtual",      "map.page_size",     "map.page_pool",
    "map.virtual_levels", "map.virtual_bias", "bias.raster_slope", "bias.raster_units",
    "bias.raster_clamp",  "caster."};
/// Settings of a light, without its prefix, that act in the look-up or while a surface is shaded.
constexpr std::array<std::string_view, 12> kLightLookups = {
    "size", "intensity", "red", "green", "blue", "cast", "contact", "source", "name", "on", "range", "cone_blend"};

}  // namespace

bool acts_while_drawing(std::string_view key) {
    const auto is = [&](std::string_view row) { return row.ends_with('.') ? key.starts_with(row) : key == row; };
    if (std::ranges::any_of(kWhileDrawing, is)) return true;
    if (key.starts_with("object.")) return key.ends_with(".cull") || key.ends_with(".cast");
    if (!key.starts_with("light.") || key == "light.count") return false;
    return std::ranges::find(kLightLookups, key.substr(key.rfind('.') + 1)) == kLightLookups.end();
}

}  // namespace si
