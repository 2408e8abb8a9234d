// Views that `render` can draw: the picture, visibility, a depth image, or an overlay.
#pragma once

#include <string>
#include <vector>

#include "renderer/base/workers.h"
#include "renderer/frame/frame.h"
#include "renderer/frame/pane_grid.h"
#include "renderer/render/renderer.h"

namespace si {

/// View of a frame that `render --view` can draw into a file: the picture, visibility, a depth map or an overlay.
struct View {
    std::string key, label, help;
    bool scalar = false;  ///< one number per pixel: can be written as a float file
    int overlay = 0;      ///< value of view.overlay, 0 for none
};

/// Lists all views of a frame that `render --view` can draw. An overlay (view.overlay) that has the key of another view
/// is listed once.
std::vector<View> views();
/// Finds a view (an image that a frame can show) by the key that `render --view` takes. @throws UsageError naming the
/// nearest key
View find_view(const std::string& key);

/// Returns the rectangles of the panes into which the setting view.panes divides a picture. @param width, height size
/// of the picture, pixels
PaneGrid picture_grid(const Settings& settings, int width, int height);

/// Draws a view of a frame into a file: PNG, PFM or OpenEXR, by the extension of `path`. Several panes (view.panes)
/// share the picture. Returns the facts of the frame.
/// @param workers threads for rays that the view's overlays need
/// @throws Error when the light has no map, or the file cannot be written
FrameResult write_view(Renderer& renderer, const Scene& scene, Settings settings, FrameRequest request,
                       const View& view, const std::string& path, const Workers& workers = {});

/// Checks the extension of the file into which a view is written: .png; also .pfm or .exr if the view has one number
/// per pixel. @throws UsageError
void check_view_file(const View& view, const std::string& path);

}  // namespace si
