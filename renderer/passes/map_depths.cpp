#include "renderer/passes/map_depths.h"

#include "renderer/passes/pages.h"

namespace si {
namespace {

std::vector<float> read_whole(const gl::Target& maps, int layer, glm::ivec2 first, glm::ivec2 size) {
    std::vector<float> out(std::size_t(size.x) * std::size_t(size.y));
    if (out.empty()) return out;
    gl::prepare_read_back();
    glGetTextureSubImage(maps.texture.id(), 0, first.x, first.y, layer, size.x, size.y, 1,
                         gl::single_channel_format(maps.format), GL_FLOAT, GLsizei(out.size() * sizeof(float)),
                         out.data());
    return out;
}

}  // namespace

std::vector<float> read_map_depths(const PagePasses& pages, const gl::Target& maps, const MapLayer& of,
                                   glm::ivec2 first, glm::ivec2 size) {
    const float empty = float(of.curve.convention.far_depth());
    std::vector<float> out =
        of.paged ? pages.read_depths(of.layer, first, size, empty) : read_whole(maps, of.layer, first, size);
    if (of.holds_distances)
        for (float& d : out) d = float(of.curve.depth_at_fraction(double(d)));
    return out;
}

}  // namespace si
