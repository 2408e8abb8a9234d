#include "app/views.h"

#include <fmt/format.h>

#include <limits>

#include "app/output.h"
#include "renderer/error.h"
#include "renderer/param.h"
#include "renderer/techniques.h"

namespace si {
namespace {

void write_shadow_map(Renderer& renderer, const Settings& settings, const FrameResult& frame, const std::string& path) {
    const std::size_t light = std::size_t(settings.view.light);
    if (light >= frame.lights.size()) {
        throw Error(fmt::format("view.light is {}, but light.count is {}", light, frame.lights.size()));
    }
    if (!frame.lights[light].casts) {
        throw Error(fmt::format("light {} has no shadow map: {}", light, frame.lights[light].reason));
    }
    if (lower_extension(path) == ".png") return write_png(path, renderer.read_colour(frame.map_view));
    const auto& all = frame.lights[light].views;
    const std::size_t face = std::min(std::size_t(settings.view.face), all.size() - 1);
    FloatImage map = renderer.read_shadow_map(int(light), int(face));
    if (settings.view.map == static_cast<int>(MapView::Linear)) {
        for (float& v : map.data) v = float(all[face].curve.distance(v));
    }
    write_pfm(path, map);
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
         "metres when view.map is linear.",
         true, 0},
    };
    int index = 0;
    for (const Overlay& overlay : overlays()) {
        ++index;
        if (overlay.key == "visibility") continue;
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
    throw UsageError(fmt::format("no view '{}': it is one of {}; did you mean {}?", key, fmt::join(keys, ", "),
                                 nearest_name(key, keys)));
}

void check_view_file(const View& view, const std::string& path) {
    const std::string extension = lower_extension(path);
    if (extension != ".png" && extension != ".pfm") {
        throw UsageError(fmt::format("{}: the file must end in .png (8 bit) or .pfm (float)", path));
    }
    if (extension == ".pfm" && !view.scalar) {
        throw UsageError(
            fmt::format("{}: the view '{}' is a picture, not one number a pixel; write it as .png", path, view.key));
    }
}

void write_view(Renderer& renderer, const Scene& scene, Settings settings, FrameRequest request, const View& view,
                const std::string& path, FrameResult* frame) {
    const bool floats = lower_extension(path) == ".pfm";
    if (view.overlay > 0) settings.view.overlay = view.overlay;
    request.outputs = {.colour = false};
    if (view.key == "visibility") {
        request.outputs.visibility = true;
    } else if (view.key == "shadow-map") {
        request.outputs.shadow_map = true;
    } else {
        (floats ? request.outputs.overlay : request.outputs.colour) = true;
    }
    const FrameResult result = renderer.render(scene, settings, request);
    if (frame) *frame = result;
    if (view.key == "shadow-map") {
        write_shadow_map(renderer, settings, result, path);
    } else if (view.key == "visibility") {
        const FloatImage visibility = renderer.read_float(result.visibility, 1);
        floats ? write_pfm(path, visibility) : write_grey_png(path, visibility);
    } else if (floats) {
        write_pfm(path, overlay_values(renderer, result));
    } else {
        write_png(path, renderer.read_colour(result.colour));
    }
}

}  // namespace si
