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

/// Returns the transform from the engine's world to metres, y up, right-handed.
glm::dmat4 world_from_engine(const BundleWorld& world);

/// Returns the view of a map, in metres, y up, right-handed.
/// @throws Error "the matrix: what; what to do" for matrices that view_of_matrix() refuses
LightView view_of_map(const BundleWorld& world, const BundleMap& map);

/// Depth-buffer values of one map, and what was wrong with its texels.
struct MapDepths {
    FloatImage depths;              ///< top row first
    std::size_t not_a_number = 0;   ///< texels that are no number, read as the far plane
    std::size_t outside_range = 0;  ///< texels beyond near or far plane, read as on it
};

/// Returns the depth-buffer values of a map.
/// @param image decoded image of BundleMap::image, rows in the order of the file
/// @throws Error "what; what to do" for a region or channel that the image lacks
MapDepths depths_of_map(const BundleMap& map, const LightView& view, const FloatImage& image);

/// Returns the choice of a light's views. @param views views of its maps @throws Error
ViewChooser chooser_of(const Bundle& bundle, const BundleLight& light, const std::vector<LightView>& views);

/// Maps of a bundle, by light.
struct GivenMaps {
    Bundle bundle;
    std::vector<std::shared_ptr<const ImportedMaps>> lights;  ///< as Bundle::lights; null: no map
    std::vector<StampedFile> files;                           ///< files that were read
    std::vector<std::string> notes;                           ///< faults that do not hinder reading, one sentence each
};

/// Returns a setting of bias.* and its value for each part of a look-up's normal offset; nothing where the offset is
/// unknown or counts in depth, which is no length.
std::vector<std::pair<std::string_view, std::string>> normal_offset_settings(const BundleBias& bias);

/// Returns true when the settings that a bundle holds state the bias of every look-up, as those of this program do.
bool settings_state_bias(const Bundle& bundle);

/// Returns bias.* of a light's look-up, without polygon offset, if the bundle states all its terms in units and amounts
/// that bias.* can hold; else nothing.
std::optional<BiasSettings> stated_bias(const Bundle& bundle, const BundleLight& light);

/// Returns which bias a light's look-ups have: that of the settings, one that its bundle states, or an unknown one of
/// the engine that drew its maps. @throws Error as read_given_maps()
/// @param light index of light.*
EngineBias engine_bias_of_light(const Settings& settings, int light);

/// Parses the frame.json of a bundle. @throws Error
Bundle read_bundle(BundleFiles& files);

/// Reads the maps of a bundle. @throws Error "FILE: place: what; what to do"
GivenMaps read_given_maps(BundleFiles& files);

/// Returns the maps of a bundle. The last few bundles are kept until one of their files changes. Usable from any
/// thread.
/// @throws Error as read_given_maps()
std::shared_ptr<const GivenMaps> given_maps(const std::filesystem::path& path);

/// Returns maps whose views are moved with a scene that is placed elsewhere. @param placement rotation, translation and
/// uniform scale
std::shared_ptr<const ImportedMaps> placed_maps(const std::shared_ptr<const ImportedMaps>& maps,
                                                const glm::dmat4& placement);

}  // namespace si
