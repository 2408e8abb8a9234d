// Read-back of pictures and maps from the GPU, top row first.
#include <fmt/format.h>

#include <algorithm>

#include "renderer/base/error.h"
#include "renderer/frame/read_images.h"
#include "renderer/render/renderer.h"
#include "renderer/render/renderer_impl.h"

namespace si {
namespace {

/// Returns the number of the last drawing of an image; 0: it was never drawn.
/// @param place address of the image's cache key
std::uint64_t last_drawing_of(const Resources& resources, const std::uint64_t* place) {
    const auto drawing = resources.drawings.find(place);
    return drawing == resources.drawings.end() ? 0 : drawing->second;
}

/// Returns true when no later drawing has replaced this image of the frame.
bool is_there(const FrameContents::Part& part, const Resources& resources) {
    return *part.place == part.key && last_drawing_of(resources, part.place) == part.drawn;
}

/// Returns the first image of a result.
/// @throws Error when the frame did not draw it or a later frame replaced it
const gl::Target& require(const FrameResult& frame, std::uint64_t renderer, const Resources& resources, Result result) {
    const gl::Target* image = nullptr;
    for (const FrameContents::Part& part : frame.contents.parts) {
        if (frame.contents.renderer != renderer || part.of != result) continue;
        image = part.image;
        if (!is_there(part, resources))
            throw Error(
                fmt::format("the {} of this frame were overwritten by a later frame; draw it again "
                            "before reading them",
                            result_name(result)));
    }
    if (!image)
        throw Error(fmt::format("the frame did not draw its {}: none of its requested outputs needs them",
                                result_name(result)));
    return *image;
}

/// Reads back a texture, top row first. @param numbers count of type T in each pixel
template <typename T>
std::vector<T> read_image(const Image& image, int numbers, GLenum format, GLenum type) {
    const std::size_t count = std::size_t(image.width) * std::size_t(image.height) * std::size_t(numbers);
    std::vector<T> data = gl::read_texture<T>(image.texture, count, format, type);
    flip_rows(data, image.width, image.height, numbers);
    return data;
}

}  // namespace

ByteImage Renderer::read_colour(const Image& image) {
    return {image.width, image.height, read_image<std::uint8_t>(image, 4, GL_RGBA, GL_UNSIGNED_BYTE)};
}

FloatImage read_floats(const Image& image, int channels) {
    constexpr GLenum kFormats[] = {GL_RED, GL_RG, GL_RGB, GL_RGBA};
    return {image.width, image.height, channels, read_image<float>(image, channels, kFormats[channels - 1], GL_FLOAT)};
}

SurfaceIds read_ids(const Image& image) {
    return {image.width, image.height, read_image<glm::uvec2>(image, 1, GL_RG_INTEGER, GL_UNSIGNED_INT)};
}

FloatImage Renderer::read_float(const Image& image, int channels) {
    return read_floats(image, channels);
}

SurfaceIds Renderer::read_surface_ids(const Image& image) {
    return read_ids(image);
}

FloatImage Renderer::read_shadow_map(const FrameResult& frame, int light, int face) {
    int layer = 0;
    bool found = false;
    for (std::size_t i = 0; i < frame.lights.size() && !found; ++i) {
        if (!frame.lights[i].casts) continue;
        const int views = int(frame.lights[i].views.size());
        found = int(i) == light && face >= 0 && face < views;
        layer += found ? face : views;
    }
    if (!found) throw Error(fmt::format("light {} has no shadow map image {}", light, face));
    const gl::Target& map = require(frame, impl_->number, impl_->resources, Result::ShadowMaps);
    if (!frame.maps_are_whole)
        throw Error(
            "the shadow maps of this frame hold only texels that its picture reads; request shadow maps before "
            "reading them");
    const MapSize n = frame.map_size;
    const DepthCurve& curve = frame.lights[std::size_t(light)].views[std::size_t(face)].curve;
    FloatImage out{n.width, n.height, 1,
                   impl_->passes.pages.read_map_depths(
                       map, {curve, layer, frame.pages.has_value(), frame.map_holds_distances}, {0, 0}, n.sides())};
    flip_rows(out.data, n.width, n.height, 1);
    return out;
}

FloatImage Renderer::read_map_view_depth(const FrameResult& frame) {
    const ShownMap& shown = frame.shown_map;
    if (shown.light < 0) throw Error("the frame drew no map view to read from");
    if (shown.channel > 0)
        return read_floats(image_of(require(frame, impl_->number, impl_->resources, Result::MapChannel)), 1);
    if (shown.source == MapSource::Light) return read_shadow_map(frame, shown.light, shown.face);
    const Image image = image_of(require(frame, impl_->number, impl_->resources, Result::CameraDepth));
    return {image.width, image.height, 1, read_image<float>(image, 1, GL_DEPTH_COMPONENT, GL_FLOAT)};
}

std::shared_ptr<const NumericHealth> Renderer::numeric_health(const FrameResult& frame, bool wait) {
    require(frame, impl_->number, impl_->resources, Result::Health);
    return impl_->passes.numeric_health.read_result(wait);
}

bool Renderer::has_images_of(const FrameResult& frame) const {
    const auto there = [&](const FrameContents::Part& p) { return is_there(p, impl_->resources); };
    const auto& parts = frame.contents.parts;
    return frame.contents.renderer == impl_->number && std::all_of(parts.begin(), parts.end(), there);
}

FrameContents contents_of(const FrameState& f, const std::vector<PassInfo>& infos) {
    FrameContents out;
    const std::vector<Pass>& plan = f.plan.passes();
    for (std::size_t i = 0; i < plan.size(); ++i) {
        if (infos[i].state == PassState::Skipped || !plan[i].cached) continue;
        const std::uint64_t drawn = last_drawing_of(f.gl, plan[i].cached);
        for (const ResultRef& result : plan[i].writes)
            out.parts.push_back({result.what, &f.result(result), plan[i].cached, plan[i].key, drawn});
    }
    return out;
}

}  // namespace si
