#include "app/report/views.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "app/base/output.h"
#include "app/report/picture_comparison.h"
#include "renderer/base/did_you_mean.h"
#include "renderer/base/error.h"
#include "renderer/base/lower_case.h"
#include "renderer/frame/depth_histogram.h"
#include "renderer/render/reference_frames.h"
#include "renderer/settings/overlays.h"
#include "renderer/settings/param.h"

namespace si {
namespace {

constexpr int kPaneGap = 2;  ///< pixels between two panes

void require_map(const Settings& settings, const FrameResult& frame) {
    const std::size_t light = std::size_t(settings.view.light);
    if (light >= frame.lights.size())
        throw Error(fmt::format("view.light is {}, but light.count is {}", light, frame.lights.size()));
    if (!frame.lights[light].casts)
        throw Error(fmt::format("light {} has no shadow map: {}", light, frame.lights[light].reason));
}

void write_depth(Renderer& renderer, const Settings& settings, const FrameResult& frame, const std::string& path) {
    if (lower_extension(path) == ".png") return write_png(path, renderer.read_colour(frame.map_view));
    FloatImage depth = renderer.read_map_view_depth(frame);
    if (frame.shown_map.channel == 0 && settings.view.map == MapView::Linear) {
        for (std::size_t i = 0; i < depth.data.size(); ++i) {
            const double row = map_v_of_row(depth, int(i / std::size_t(depth.width)));
            depth.data[i] = float(frame.map_view_curve.curve_at_row(row).distance(depth.data[i]));
        }
    }
    write_floats(path, depth);
}

/// Composes the panes into one picture, with dark gaps between them.
ByteImage joined(Renderer& renderer, const FrameResult& frame, const PaneGrid& grid, int width, int height) {
    ByteImage out = plain_image(width, height, 22);
    for (int pane = 0; pane < grid.count(); ++pane)
        paste_image(out, renderer.read_colour(frame.panes[std::size_t(pane)].picture), grid.corner(pane));
    return out;
}

FloatImage overlay_values(Renderer& renderer, const FrameResult& frame) {
    const FloatImage rgba = renderer.read_float(frame.overlay, 4);
    FloatImage values{rgba.width, rgba.height, 1, {}};
    values.data.resize(rgba.data.size() / 4);
    for (std::size_t i = 0; i < values.data.size(); ++i) {
        const bool drawn = rgba.data[4 * i + 3] != 0;
        values.data[i] = drawn ? rgba.data[4 * i] : std::numeric_limits<float>::quiet_NaN();
    }
    return values;
}

}  // namespace

std::vector<View> views() {
    std::vector<View> list = {
        {"shaded", "Shaded", "The scene lit and shadowed.", false, 0},
        {"visibility", "Visibility", "How much of the light of view.light reaches each pixel: 1 lit, 0 in shadow.",
         true, 0},
        {"shadow-map", "Shadow map",
         "The depth map of view.light as view.map shows it; as floats the stored depth, or "
         "metres when view.map is linear; or the moment that view.map_channel chooses.",
         true, 0},
        {"camera-depth", "Camera depth",
         "The camera's own depth as view.map shows it; as floats the stored depth (reversed: 1 near, 0 far and where "
         "nothing was drawn), or metres when view.map is linear.",
         true, 0},
    };
    int index = 0;
    for (const Overlay& overlay : overlays()) {
        ++index;
        if (std::ranges::find(list, overlay.key, &View::key) != list.end())
            continue;  // listed above, also as a float file
        list.push_back(
            {std::string(overlay.key), std::string(overlay.label), std::string(overlay.help), overlay.scalar, index});
    }
    return list;
}

View find_view(const std::string& key) {
    std::vector<std::string> keys;
    for (const View& view : views()) {
        if (view.key == key) return view;
        keys.push_back(view.key);
    }
    throw UsageError(fmt::format("no view '{}': it is one of {}{}", key, fmt::join(keys, ", "),
                                 did_you_mean(nearest_name(key, keys))));
}

void check_view_file(const View& view, const std::string& path) {
    const std::string extension = lower_extension(path);
    if (extension != ".png" && !is_float_file(path))
        throw UsageError(fmt::format("{}: the file must end in .png (8 bit), .pfm or .exr (float)", path));
    if (extension != ".png" && !view.scalar)
        throw UsageError(
            fmt::format("{}: the view '{}' is a picture, not one number a pixel; write it as .png", path, view.key));
}

PaneGrid picture_grid(const Settings& settings, int width, int height) {
    return pane_grid(settings.view.panes, width, height, kPaneGap);
}

FrameResult write_view(Renderer& renderer, const Scene& scene, Settings settings, FrameRequest request,
                       const View& view, const std::string& path, const Workers& workers) {
    const bool floats = is_float_file(path);
    if (view.overlay > 0) settings.view.overlay = view.overlay;
    // Only the shaded picture has panes; every other view is a single picture.
    if (view.key != "shaded") settings.view.panes = Panes::One;
    const bool depth = view.key == "shadow-map" || view.key == "camera-depth";
    if (depth) settings.view.map_source = view.key == "camera-depth" ? MapSource::Camera : MapSource::Light;
    const bool visibility = view.key == "visibility", picture = !depth && !visibility;
    request.outputs = {
        .colour = picture && !floats, .shadow_map = depth, .visibility = visibility, .overlay = picture && floats};
    const int width = request.width, height = request.height;
    const PaneGrid grid = picture_grid(settings, width, height);
    if (grid.count() > 1) {
        request.width = grid.width;
        request.height = grid.height;
    }
    ReferenceCache references;
    // The frame may lack the reference that overlays need.
    const FrameResult result = render_with_reference(renderer, scene, settings, request, references, workers);
    if (depth) {
        if (view.key == "shadow-map") require_map(settings, result);
        write_depth(renderer, settings, result, path);
    } else if (visibility) {
        write_scalar_image(path, renderer.read_float(result.visibility, 1));
    } else if (floats) {
        write_floats(path, overlay_values(renderer, result));
    } else if (grid.count() > 1) {
        write_png(path, joined(renderer, result, grid, width, height));
    } else {
        write_png(path, renderer.read_colour(result.colour));
    }
    return result;
}

}  // namespace si
