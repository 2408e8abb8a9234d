// Shadow maps whose images are given instead of drawn.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "renderer/base/float_image.h"
#include "renderer/projection/light_view.h"
#include "renderer/projection/map_size.h"
#include "renderer/projection/view_choice.h"
#include "renderer/settings/settings.h"

namespace si {

/// Views with which imported shadow maps were drawn. They replace the views that light.fit would give.
struct ImportedViews {
    std::vector<LightView> views;  ///< one per image
    ViewChooser chooser;           ///< rule that chooses the view in which a point is looked up
    bool closed = false;           ///< true: no surface within the light's range and cone is in shadow outside the maps
};

/// Raster state (polygon offset and culling) in which casters are drawn into one shadow map. Replaces the settings
/// bias.raster_* and caster.cull.
struct CasterRaster {
    /// Values for glPolygonOffset(). With reversed depth, values below 0 move casters away from the light.
    double offset_factor = 0, offset_units = 0;
    double offset_clamp = 0;  ///< as glPolygonOffsetClampEXT() takes it; 0: no clamp
    /// Culled faces, by the winding of glTF as seen from the light (culled_faces()); nullopt: the setting caster.cull
    /// counts.
    std::optional<Cull> cull;
    bool operator==(const CasterRaster&) const = default;
};

/// Shadow maps of one light that an engine has drawn: one image for each view, and the raster state and bias if they
/// are known. Without images, this program draws maps with the given views.
struct ImportedMaps {
    std::vector<FloatImage> images;      ///< depths by view, top row first, as Renderer::read_shadow_map() returns them
    std::optional<ImportedViews> views;  ///< nullopt: views of the light's own fit
    std::vector<CasterRaster> raster;    ///< by view; empty: unknown, maps are drawn as the settings say
    /// Node paths that were drawn into each map, by view; nullopt: unknown. An empty vector: unknown for all maps.
    std::vector<std::optional<std::vector<std::string>>> drawn;
    MapSize drawn_size;  ///< size of maps that this program draws, if there are no images
    /// True: the bias with which the engine reads the maps is known. See engine_bias().
    bool bias_known = true;
    /// Known bias of the engine, as settings bias.* without polygon offset; nullopt: any settings bias.* count as the
    /// engine's.
    std::optional<BiasSettings> bias;
    std::uint64_t key = 0;  ///< hash of images, views and raster state
    /// Returns true when the maps are images that are given, false when they are drawn with the given views.
    bool has_images() const { return !images.empty(); }
    MapSize size() const { return has_images() ? MapSize(images.front().width, images.front().height) : drawn_size; }
};

/// Makes the imported maps of one light from images and views, and computes their cache key.
/// @throws Error without an image, for images of more than one channel or different sizes, or where their number is not
/// that of the views
/// @param raster raster state by view; empty: unknown @param bias_known ImportedMaps::bias_known
std::shared_ptr<const ImportedMaps> imported_maps(std::vector<FloatImage> images,
                                                  std::optional<ImportedViews> views = std::nullopt,
                                                  std::vector<CasterRaster> raster = {}, bool bias_known = true);

/// Makes maps of one light without images: this program draws them from the scene's casters, with these views instead
/// of those that light.fit would give.
/// @param raster raster state by view; empty: as the settings say
/// @throws Error without a view, for a size below 1, or where the number of raster states is not that of the views
std::shared_ptr<const ImportedMaps> drawn_maps(ImportedViews views, MapSize size,
                                               std::vector<CasterRaster> raster = {});

/// Returns the faces that an engine culls from a shadow map, as this program names them. In this program, front faces
/// wind counter-clockwise as seen from the light (glTF).
/// @param culled GL_CULL_FACE_MODE of the engine
/// @param front_is_clockwise true: the engine's front faces wind clockwise (GL_CW) in clip space with y up
/// @param view view of the map
Cull culled_faces(Cull culled, bool front_is_clockwise, const LightView& view);

}  // namespace si
