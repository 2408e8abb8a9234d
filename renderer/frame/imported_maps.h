// Shadow maps whose images are given instead of drawn.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "renderer/frame/frame.h"

namespace si {

/// Views that come with imported images, in place of those that a fit makes.
struct ImportedViews {
    std::vector<LightView> views;  ///< one an image
    ViewChooser chooser;           ///< choice of the view in which a point is looked up
};

/// Maps of one light that are given: an image a view, and what they were drawn with, where it is known.
struct ImportedMaps {
    std::vector<FloatImage> images;      ///< depths by view, top row first, as Renderer::read_shadow_map() returns them
    std::optional<ImportedViews> views;  ///< nullopt: the light's own views
    std::uint64_t key = 0;               ///< hash of images and views
    MapSize size() const { return {images.front().width, images.front().height}; }
};

/// Returns maps of these images and views, with their key.
/// @throws Error without an image, for images of more than one channel or different sizes, or where their number is not
/// that of the views
std::shared_ptr<const ImportedMaps> imported_maps(std::vector<FloatImage> images,
                                                  std::optional<ImportedViews> views = std::nullopt);

}  // namespace si
