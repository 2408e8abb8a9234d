// What `render` can draw: the picture, visibility, a depth image, or an overlay.
#pragma once

#include <string>
#include <vector>

#include "renderer/base/workers.h"
#include "renderer/frame/frame.h"
#include "renderer/frame/pane_grid.h"
#include "renderer/render/renderer.h"

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

/// Where the panes of view.panes lie in a picture of this size.
PaneGrid picture_grid(const Settings& settings, int width, int height);

/// Draws `view` into the file, PNG or PFM by extension; the picture of several panes (view.panes) as one of the size
/// asked for. What its overlays need of the truth is traced by `workers`. `frame` gets the facts.
/// @throws Error when the light has no map, or the file cannot be written.
void write_view(Renderer& renderer, const Scene& scene, Settings settings, FrameRequest request, const View& view,
                const std::string& path, FrameResult* frame = nullptr, const Workers& workers = {});

/// @throws UsageError unless `path` ends in .png, or in .pfm and the view is scalar.
void check_view_file(const View& view, const std::string& path);

}  // namespace si
