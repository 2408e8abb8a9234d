// The measuring stick: the least OpenGL that draws the same scene with the same kernel, all vertices in world space in
// one buffer, two draws a frame (with textures two for each texture and mask), no settings, no overlays.
#pragma once

#include <cstdint>
#include <vector>

#include "renderer/frame/frame.h"
#include "renderer/gl/handle.h"
#include "renderer/gl/target.h"

namespace si {

/// What a BareForward draws of the materials.
enum class BareMaterials {
    Colours,   ///< their base colours; masks are solid
    Textures,  ///< base colour textures and masks too, sampled as the renderer does; no normal maps, no blending
};

class BareForward {
public:
    /// kernel_size 0: no shadows at all (one pass); 1: 2x2 bilinear by one gather; 3, 5, 7: N x N bilinear by gathers;
    /// -1: one nearest tap.
    /// @throws Error when a material has what Textures leaves out
    BareForward(const Scene& scene, int kernel_size, int map_resolution, int width, int height,
                BareMaterials materials = BareMaterials::Colours);
    /// Draws a frame with the camera and light that the renderer found; `depth_pass` off leaves the map as it is.
    void draw(const Camera& camera, const FittedLight& light, bool depth_pass = true, bool shade_pass = true);

    /// What was drawn last, bottom row first, as RGBA.
    std::vector<std::uint8_t> picture() const;

private:
    /// Triangles of one look, one draw.
    struct Group {
        int texture = -1;  ///< of the scene
        bool masked = false, double_sided = false;
        float cutoff = 0;
        std::vector<std::uint32_t> indices;
        std::size_t first = 0;
    };
    Group& group_of(const Scene& scene, const Mesh& mesh);
    void use(const gl::Program& program, const Group& group, const glm::mat4& clip);

    int kernel_, resolution_, width_, height_;
    BareMaterials materials_;
    std::vector<Group> groups_;
    gl::VertexArray vao_;
    gl::Buffer vertices_, indices_;
    gl::Program depth_program_, masked_depth_program_, shade_program_, textured_program_, masked_program_;
    std::vector<gl::Texture> textures_;
    gl::Target map_, colour_, depth_;
    gl::Framebuffer map_framebuffer_, framebuffer_;
    glm::dvec3 origin_;
};

}  // namespace si
