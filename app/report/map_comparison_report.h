// Comparison of imported maps with drawn ones as text, JSON and picture.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "app/base/json_text.h"
#include "renderer/advise/least_bias.h"
#include "renderer/bundle/engine_bias.h"
#include "renderer/inspect/map_comparison.h"

namespace si {

/// Returns true when every imported map passes the gate (MapGate).
bool all_pass_gate(std::span<const ComparedMap> maps);

/// Formats the comparison of a light's maps: a table with a line a map, the gate of each, and the casters that they
/// lack.
std::string map_comparison_text(std::span<const ComparedMap> maps);

/// Converts the comparison of a light's maps to JSON, an array with a member a map.
nlohmann::ordered_json map_comparison_json(std::span<const ComparedMap> maps);

/// Bias of a light's imported maps: what the engine has, where it is known, and what the maps need.
struct MapBias {
    int light = 0;
    EngineBias knowledge = EngineBias::Unknown;
    BiasSettings engine;            ///< the engine's bias, unless unknown
    TexelSize texel_m;              ///< smallest and largest texel of the light's maps, metres
    double depth_per_m = 0;         ///< depth-buffer units per metre along the axis at the middle of the depth range
    std::vector<BiasStart> enough;  ///< least bias by theory for what the camera sees; empty: no pixel is lit
};

/// Finds the bias that a light's imported maps need, over the pixels that the camera sees.
/// @param pixels size of the picture
/// @throws Cancelled, Error
MapBias map_bias(Renderer& renderer, const Scene& scene, const Settings& settings,
                 const std::vector<std::shared_ptr<const ImportedMaps>>& maps, int light, glm::ivec2 pixels,
                 const Workers& workers = {});
/// Formats the bias of a light's maps in texels, metres and depth, a line a kind of bias.
std::string map_bias_text(const MapBias& bias);
/// Converts the bias of a light's maps to JSON.
nlohmann::ordered_json map_bias_json(const MapBias& bias);

/// Draws a row a map: the imported map, the drawn one, and their difference, with a scale of colours in metres.
/// @param side longest side of each picture, pixels; larger maps are shrunk
ByteImage map_comparison_sheet(std::span<const ComparedMap> maps, int side = 512);

}  // namespace si
