// The panel Imported: an engine's shadow map beside the map that this program draws from the same light.
#pragma once

#include <optional>
#include <string>

#include "renderer/bundle/engine_bias.h"
#include "renderer/frame/frame.h"

namespace si {

struct ComparedMap;

/// Picture that the panel Imported shows: the engine's imported shadow map, the map that this program draws with the
/// same view, or their difference.
enum class ImportedPicture { Imported, Drawn, Difference };

/// Kinds of texels that the comparison of an engine's imported shadow map with the drawn map leaves out.
struct ImportedLeftOut {
    bool masked = false;  ///< those that masked casters may cover
    bool border = false;  ///< extra texels next to covered ones, as of blurred maps of moments
    bool operator==(const ImportedLeftOut&) const = default;
};

/// Data that the panel Imported shows: the comparison of an engine's imported shadow map with the map that this program
/// draws.
struct ImportedFacts {
    const ComparedMap* compared_map = nullptr;  ///< comparison of the shown light and view; null: not known
    Image compared_picture;                     ///< picture of the comparison that PictureState::imported_picture names
    double compared_scale_m = 0;                ///< metres at which the colours of the difference end
    std::string comparison_problem;             ///< why the maps were not compared; empty: they were, or will be
};

/// Requests of the panel Imported to the application: compare the maps, and select an object.
struct ImportedRequests {
    bool want_map_comparison = false;          ///< the shown map is imported, and the panel is shown
    std::optional<std::string> select_object;  ///< select this object alone, by node path
};

/// Draws the panel Imported, which compares an engine's shadow map with the map that this program draws. It shows the
/// engine's bias, the differences, their limits (the gate), and the casters that the engine's map lacks. A picture
/// beside these shows the engine's map, the program's map, or the difference.
/// @param picture choice of the picture, which the switch changes
/// @param left_out texels that the comparison leaves out, which two switches change
/// @param settings the settings, changed by the widgets of map.bundle_maps, map.bundle_bias and bias.*
/// @param light the shown light as fitted in the last frame; null: no frame, or no light
/// @param bias state of knowledge about the bias with which the engine reads the shown light's maps
/// @param selected node path of a selected object, which is highlighted in the list
void draw_imported(ImportedPicture& picture, ImportedLeftOut& left_out, Settings& settings, const FittedLight* light,
                   EngineBias bias, const std::string& selected, const ImportedFacts& facts,
                   ImportedRequests& requests);

}  // namespace si
