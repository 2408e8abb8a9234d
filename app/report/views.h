// Views that `render` can draw: the picture, visibility, a depth image, or an overlay.
#pragma once

#include <string>
#include <vector>

#include "renderer/base/workers.h"
#include "renderer/frame/frame.h"
#include "renderer/frame/pane_grid.h"
#include "renderer/render/renderer.h"

namespace si {

/// Image that `render --view` can draw.
struct View {
    std::string key, label, help;
    bool scalar = false;  ///< one number per pixel: can be written as a float file
    int overlay = 0;      ///< value of view.overlay, 0 for none
};

/// Lists all views that `render --view` can draw. An overlay whose key (view.overlay) equals the key of another view is
/// listed once.
std::vector<View> views();
/// Finds a view of `render --view` by key. @throws UsageError naming the nearest key
View find_view(const std::string& key);

/// Returns the rectangles of the panes (view.panes) in a picture of this size.
PaneGrid picture_grid(const Settings& settings, int width, int height);

/// Draws a view into a PNG or PFM file, by extension. Several panes (view.panes) share the picture. @param workers for
/// rays that the view's overlays need Returns the facts of the frame. @throws Error when the light has no
/// map, or the file cannot be written
FrameResult write_view(Renderer& renderer, const Scene& scene, Settings settings, FrameRequest request,
                       const View& view, const std::string& path, const Workers& workers = {});

/// Checks the extension of a view's output file: .png, or .pfm if the view is scalar. @throws UsageError
void check_view_file(const View& view, const std::string& path);

}  // namespace si
