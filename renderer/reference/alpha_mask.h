// The alpha test of masked materials at a triangle's point, as the light's depth pass makes it at level of detail 0.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <vector>

#include "renderer/base/key.h"
#include "renderer/scene/scene.h"

namespace si {

/// The alpha channel of a texture; shared by the masks that sample it.
struct AlphaTexture {
    int width = 0, height = 0;
    TextureWrap wrap_s = TextureWrap::Repeat, wrap_t = TextureWrap::Repeat;
    bool nearest = false;  ///< the magnification filter, which is what GL uses at level 0
    std::vector<std::uint8_t> alpha;

    explicit AlphaTexture(const Texture& texture);
    /// Alpha in [0,1] at texture coordinates; nearest or bilinear (OpenGL 4.5, section 8.14).
    double at(const glm::dvec2& uv) const;
};

/// What of a mesh the test needs. Shares arrays with it, so that a trace outlives the scene it was made from.
class AlphaMask {
public:
    /// @param cutoff alpha below it is a hole
    AlphaMask(const Mesh& mesh, const Material& material, double cutoff, std::shared_ptr<const AlphaTexture> texture);
    /// Whether the point (1-u-v) a + u b + v c of triangle abc is solid.
    bool solid(std::uint32_t triangle, double u, double v) const;
    /// Adds all that solid() goes by but the triangles.
    void add_content(Key& key) const;

private:
    SharedArray<std::uint32_t> indices_;
    SharedArray<glm::vec2> uv_;
    std::vector<std::uint8_t> vertex_alpha_;       ///< empty: 1
    std::shared_ptr<const AlphaTexture> texture_;  ///< null: 1
    double base_, cutoff_;
};

}  // namespace si
