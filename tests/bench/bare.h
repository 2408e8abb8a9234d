// The measuring sticks: the least OpenGL that draws the same scene with the same kernel. All vertices lie in world
// space in one buffer, a pass is one draw (with textures one for each texture and mask), and nothing is asked for or
// set that a frame does not need. See BareOptions for which stick is which.
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

enum class BareKernel {
    None,     ///< no shadows: the camera's pass alone
    Nearest,  ///< one nearest tap
    Gather,   ///< `size` x `size` bilinear taps by ((size + 1) / 2)² gathers and own comparison; 1: 2x2 bilinear
    Sampler,  ///< the same taps by a shadow sampler
    Vsm,      ///< two moments of depth, blurred 5 x 5 in two passes, one bilinear tap
    Pcss,     ///< 16 taps search for blockers, 16 compare, on a disk that each pixel turns
};

enum class BareLight {
    Lambert,  ///< written as it is: the least that any light costs
    Ours,     ///< Blinn-Phong, encoded as sRGB: the renderer's light model
};

struct BareOptions {
    BareKernel kernel = BareKernel::Gather;
    int size = 3;
    BareLight light = BareLight::Ours;
    BareMaterials materials = BareMaterials::Colours;
    bool cull_casters = true;          ///< back faces stay out of the map
    bool large_last = true;            ///< large objects are drawn after the small ones that they lie behind
    bool separate_visibility = false;  ///< visibility into a texture of its own (R32F), which the shading pass reads
};

class BareForward {
public:
    /// @throws Error when a material has what Textures leaves out
    BareForward(const Scene& scene, const BareOptions& options, int map_resolution, int width, int height);
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
    /// Programs of the three looks: plain, textured, masked.
    struct Programs {
        gl::Program looks[3];
        const gl::Program& of(const Group& g) const { return looks[g.masked ? 2 : g.texture >= 0 ? 1 : 0]; }
    };
    Group& group_of(const Scene& scene, const Mesh& mesh);
    void make_geometry(const Scene& scene);
    void make_programs();
    void make_targets();
    void draw_map(const FittedLight& light);
    void draw_moments();
    void draw_from_camera(const Programs& programs, const Camera& camera, const FittedLight& light);
    void use(const gl::Program& program, const Group& group, const glm::mat4& clip);

    BareOptions options_;
    int resolution_, width_, height_;
    std::vector<Group> groups_;
    gl::VertexArray vao_, positions_vao_, no_vertices_;
    gl::Buffer vertices_, positions_, indices_;
    gl::Program depth_program_, masked_depth_program_, blur_program_[2];
    Programs visibility_programs_, shade_programs_;
    std::vector<gl::Texture> textures_;
    gl::Sampler compare_;
    gl::Target map_, moments_[2], visibility_, colour_, depth_;
    gl::Framebuffer map_framebuffer_, moments_framebuffer_[2], visibility_framebuffer_, framebuffer_;
    glm::dvec3 origin_;
};

}  // namespace si
