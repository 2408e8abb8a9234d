// Alpha test of masked materials for rays, equal to that of the light's depth pass at mip level 0.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <vector>

#include "renderer/base/key.h"
#include "renderer/scene/scene.h"

namespace si {

/// Alpha channel of a texture for the alpha test of shadow rays. Several alpha masks may share the texture.
struct AlphaTexture {
    int width = 0, height = 0;
    TextureWrap wrap_s = TextureWrap::Repeat, wrap_t = TextureWrap::Repeat;
    bool nearest = false;  ///< true: nearest filter; false: bilinear. Follows the texture's magnification filter
    std::vector<std::uint8_t> alpha;

    /// Copies the alpha channel of a texture for the alpha test of shadow rays.
    explicit AlphaTexture(const Texture& texture);
    /// Samples this texture's alpha at texture coordinates, nearest or bilinear (OpenGL 4.5, section 8.14). Returns 0
    /// to 1.
    double sample(const glm::dvec2& uv) const;
    /// Returns true when the alpha that sample() gives at `uv` is at least `cutoff`. Faster than sample(), since the
    /// least and largest alpha of the blended texels often decide.
    bool reaches(const glm::dvec2& uv, double cutoff) const;

private:
    /// Returns the alpha of one texel, after the texture's wrapping (repeat, clamp or mirror). @param x,y texel, not
    /// yet wrapped
    std::uint8_t texel(double x, double y) const;
    /// Least and largest alpha of 2x2 texels. Their bilinear blend lies between the two.
    struct Bounds {
        std::uint8_t least, most;
    };
    std::vector<Bounds> bounds_;  ///< by texel (x, y): bounds over texels x to x + 1, y to y + 1; empty if `nearest`
};

/// Alpha test of one mesh with a masked material, for shadow rays. Shares the mesh's arrays, so that a trace may
/// outlive its scene.
class AlphaMask {
public:
    /// Prepares the alpha test of a mesh. @param cutoff alpha below it is a hole @param texture null: alpha 1
    AlphaMask(const Mesh& mesh, const Material& material, double cutoff, std::shared_ptr<const AlphaTexture> texture);
    /// Returns true when a point of a triangle passes the alpha test. A shadow ray hits such points and passes through
    /// others.
    /// @param triangle index of the triangle abc in the mesh
    /// @param u,v barycentric coordinates of the point (1-u-v) a + u b + v c
    bool is_solid(std::uint32_t triangle, double u, double v) const;
    /// Adds cutoff, texture coordinates and alpha values of the alpha test to a content key (hash of contents).
    /// ReferenceGeometry::add_content() adds the triangles.
    void add_content(Key& key) const;

private:
    SharedArray<std::uint32_t> indices_;
    SharedArray<glm::vec2> uv_;
    std::vector<std::uint8_t> vertex_alpha_;       ///< by vertex; empty: alpha 1
    std::shared_ptr<const AlphaTexture> texture_;  ///< null: alpha 1
    double base_, cutoff_;
};

}  // namespace si
