// What `render` can draw: the picture, visibility, the shadow map, or an overlay.
#pragma once

#include <string>
#include <vector>

#include "renderer/frame.h"
#include "renderer/renderer.h"

namespace si {

struct View {
    std::string key, label, help;
    bool scalar = false;  ///< one number a pixel: can be written as floats
    int overlay = 0;      ///< value of view.overlay, 0 for none
};

/// All views; where an overlay is named like a view the view stands for both.
std::vector<View> views();
/// @throws UsageError naming the nearest
View find_view(const std::string& key);

/// Draws `view` into the file, PNG or PFM by extension. `frame` gets the facts.
/// @throws Error when the light has no map, or the file cannot be written.
void write_view(Renderer& renderer, const Scene& scene, Settings settings, FrameRequest request, const View& view,
                const std::string& path, FrameResult* frame = nullptr);

/// @throws UsageError unless `path` ends in .png, or in .pfm and the view is scalar.
void check_view_file(const View& view, const std::string& path);

}  // namespace si
