#include "renderer/inspect/given_map_changes.h"

#include <algorithm>
#include <array>
#include <span>

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

/// Settings and groups of settings that act on a map whose view is given.
constexpr std::array<std::string_view, 7> kWhileRedrawing = {
    "map.resolution",    "map.format",        "map.origin", "bias.raster_slope",
    "bias.raster_units", "bias.raster_clamp", "caster."};

/// Returns true when a key is among rows, which are keys or groups (a dot at the end).
bool is_among(std::span<const std::string_view> rows, std::string_view key) {
    return std::ranges::any_of(
        rows, [&](std::string_view row) { return row.ends_with('.') ? key.starts_with(row) : key == row; });
}

}  // namespace

bool acts_while_drawing(std::string_view key) {
    if (is_among(kWhileDrawing, key)) return true;
    if (key.starts_with("object.")) return key.ends_with(".cull") || key.ends_with(".cast");
    if (!key.starts_with("light.") || key == "light.count") return false;
    return std::ranges::find(kLightLookups, key.substr(key.rfind('.') + 1)) == kLightLookups.end();
}

bool acts_on_redrawn_map(std::string_view key) {
    return is_among(kWhileRedrawing, key) || key.starts_with("object.");
}

}  // namespace si
