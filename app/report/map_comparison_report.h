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

/// Returns true when every imported map passes the gate (MapGate): the limits within which the program's own map
/// reproduces the imported one.
bool all_pass_gate(std::span<const ComparedMap> maps);

/// Formats the comparison of a light's imported shadow maps with maps that the program drew. The text has a table with
/// one line per map, the verdict on each map, and the casters that a map lacks.
std::string map_comparison_text(std::span<const ComparedMap> maps);

/// Converts the comparison of a light's imported shadow maps with maps that the program drew to a JSON array, one
/// object per map.
nlohmann::ordered_json map_comparison_json(std::span<const ComparedMap> maps);

/// Bias of a light's imported shadow maps: the engine's own bias, if it is known, and the least bias that the maps
/// need.
struct MapBias {
    int light = 0;
    EngineBias knowledge = EngineBias::Unknown;
    BiasSettings engine;            ///< the engine's bias, unless unknown
    TexelSize texel_m;              ///< smallest and largest texel of the light's maps, metres
    double depth_per_m = 0;         ///< depth-buffer units per metre along the axis at the middle of the depth range
    std::vector<BiasStart> enough;  ///< least bias by theory for what the camera sees; empty: no pixel is lit
};

/// Finds the bias that a light's imported shadow maps need, over the pixels that the camera sees.
/// @param maps imported maps by light @param light index of the light @param pixels size of the picture
/// @throws Cancelled, Error
MapBias map_bias(Renderer& renderer, const Scene& scene, const Settings& settings,
                 const std::vector<std::shared_ptr<const ImportedMaps>>& maps, int light, glm::ivec2 pixels,
                 const Workers& workers = {});
/// Formats the bias of a light's imported shadow maps in texels, metres and depth, with one line per kind of bias.
std::string map_bias_text(const MapBias& bias);
/// Converts the bias of a light's imported shadow maps (MapBias) to JSON.
nlohmann::ordered_json map_bias_json(const MapBias& bias);

/// Draws one row of pictures per map: the imported shadow map, the map that the program drew, and their difference with
/// a colour scale in metres.
/// @param side longest side of each picture, pixels; larger maps are shrunk
ByteImage map_comparison_sheet(std::span<const ComparedMap> maps, int side = 512);

}  // namespace si
