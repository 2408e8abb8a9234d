// The shadow maps of a bundle in the program's terms: depths and views in metres, y up, right-handed.
#pragma once

#include <filesystem>
#include <glm/glm.hpp>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "renderer/base/file_stamp.h"
#include "renderer/bundle/bundle.h"
#include "renderer/bundle/bundle_files.h"
#include "renderer/bundle/engine_bias.h"
#include "renderer/bundle/imported_maps.h"

namespace si {

/// Returns the transform from an engine's world to that of this program: metres, y up, right-handed.
glm::dmat4 world_from_engine(const BundleWorld& world);

/// Returns the view of an engine's shadow map (its light camera) in this program's world: metres, y up, right-handed.
/// @throws Error "the matrix: what is wrong" if view_of_matrix() refuses the matrix; most of these errors also say what
/// to do
LightView view_of_map(const BundleWorld& world, const BundleMap& map);

/// Depth-buffer values of one imported map, and how many of its texels are invalid.
struct MapDepths {
    FloatImage depths;              ///< top row first
    std::size_t not_a_number = 0;   ///< NaN texels, read as the far plane
    std::size_t outside_range = 0;  ///< texels beyond the near or far plane, clamped to it
};

/// Converts the image of an engine's shadow map to depth-buffer values, whichever form of depth it stores
/// (BundleStored).
/// @param view view of the map, see view_of_map()
/// @param image decoded image of BundleMap::image, rows in the order of the file
/// @throws Error "what is wrong; what to do" for a region or channel that the image lacks
MapDepths depths_of_map(const BundleMap& map, const LightView& view, const FloatImage& image);

/// Returns the rule by which a surface point chooses one of a light's views: by camera depth, cube face or place in the
/// maps.
/// @param bundle bundle with the camera from which camera depths are measured
/// @param views views of the light's maps, in the same order
/// @throws Error for an unusable camera matrix
ViewChooser chooser_of(const Bundle& bundle, const BundleLight& light, const std::vector<LightView>& views);

/// Content of a bundle (an engine's frame as files), as read: its description, and the imported maps of each light.
struct GivenMaps {
    Bundle bundle;
    std::vector<std::shared_ptr<const ImportedMaps>> lights;  ///< imported maps by light; null: the light has none
    std::vector<StampedFile> files;                           ///< files that were read
    std::vector<std::string> notes;                           ///< faults that do not prevent reading, one sentence each
};

/// Converts the normal offset of an engine's look-up to settings: pairs of a key of bias.* and a value. Empty where the
/// offset is unknown, or where its unit is depth instead of a length.
std::vector<std::pair<std::string_view, std::string>> normal_offset_settings(const BundleBias& bias);

/// Returns true when the settings in a bundle include kind, unit and all amounts of bias.*. These settings are then the
/// bias of every look-up of the bundle.
bool settings_state_bias(const Bundle& bundle);

/// Returns the bias of a light's look-up as settings bias.*, without polygon offset, if the bundle states it. Nothing
/// if a term is missing, or if bias.* cannot express the unit or amount of a term.
std::optional<BiasSettings> stated_bias(const Bundle& bundle, const BundleLight& light);

/// Returns whether the bias with which an engine reads the maps of a light is known, and from which source.
/// EngineBias::Own if the settings name no bundle, or let this program draw its maps (map.bundle_maps=drawn).
/// @param light index of the light in the settings light.*
/// @throws Error as read_given_maps()
EngineBias engine_bias_of_light(const Settings& settings, int light);

/// Parses the frame.json of an opened bundle, without reading its images. @throws Error
Bundle read_bundle(BundleFiles& files);

/// Reads an opened bundle: its frame.json and the shadow maps of all lights.
/// @throws Error "FILE: PLACE: what is wrong"; most of these errors also say what to do
GivenMaps read_given_maps(BundleFiles& files);

/// Returns the content of a bundle with its shadow maps. Keeps the last few bundles in memory, each until one of its
/// files changes. Usable from any thread.
/// @throws Error as read_given_maps()
std::shared_ptr<const GivenMaps> given_maps(const std::filesystem::path& path);

/// Returns imported maps with their views moved along with the scene, after the scene was moved, turned or scaled.
/// @param placement rotation, translation and uniform scale of the scene
std::shared_ptr<const ImportedMaps> placed_maps(const std::shared_ptr<const ImportedMaps>& maps,
                                                const glm::dmat4& placement);

}  // namespace si
