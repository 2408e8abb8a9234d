// Minimal OpenGL programs that draw a scene with a shadow map. Benchmarks compare the renderer with them. All vertices
// are in world space in one buffer. A pass is one draw, or one a texture and mask. No query and no redundant state
// change is made.
#pragma once

#include <cstdint>
#include <vector>

#include "renderer/frame/frame.h"
#include "renderer/gl/handle.h"
#include "renderer/gl/target.h"

namespace si {

/// Material features that a BareForward draws.
enum class BareMaterials {
    Colours,   ///< base colours; masks are solid
    Textures,  ///< base colour textures and masks, sampled as the renderer does; no normal maps, no blending
};

/// Shadow filter of a BareForward.
enum class BareKernel {
    None,     ///< no shadows: the camera's pass alone
    Nearest,  ///< one nearest tap
    Gather,   ///< `size` x `size` bilinear taps by ((size + 1) / 2)² gathers and own comparison; 1: 2x2 bilinear
    Sampler,  ///< the same taps by a shadow sampler
    Vsm,      ///< two moments of depth, blurred 5 x 5 in two passes, one bilinear tap
    Pcss,     ///< 16 taps search for blockers, 16 compare, on a disk that each pixel turns
};

/// Light model of a BareForward.
enum class BareLight {
    Lambert,  ///< Lambert without encoding: the cheapest light
    Ours,     ///< Blinn-Phong, encoded as sRGB: the renderer's light model
};

/// Configuration of a BareForward: shadow filter, light model, materials and draw order.
struct BareOptions {
    BareKernel kernel = BareKernel::Gather;
    int size = 3;
    BareLight light = BareLight::Ours;
    BareMaterials materials = BareMaterials::Colours;
    bool cull_casters = true;          ///< back faces are left out of the map
    bool large_last = true;            ///< large objects are drawn after the small ones that they lie behind
    bool separate_visibility = false;  ///< visibility has a texture of its own (R32F), which the shading pass reads
};

/// Minimal forward renderer with one shadow map, the baseline of benchmarks. Needs a current OpenGL 4.5 context.
class BareForward {
public:
    /// Uploads the scene and compiles the programs. Sizes are in texels and pixels. @throws Error if a material has
    /// features that BareMaterials leaves out
    BareForward(const Scene& scene, const BareOptions& options, int map_resolution, int width, int height);
    /// Draws a frame with the renderer's camera and fitted light. Without `depth_pass` the map stays as it is; without
    /// `shade_pass` no picture is drawn.
    void draw(const Camera& camera, const FittedLight& light, bool depth_pass = true, bool shade_pass = true);

    /// Returns the last drawn picture as RGBA, 8 bits a channel, bottom row first.
    std::vector<std::uint8_t> picture() const;

private:
    /// Triangles of one texture and mask, drawn by one call.
    struct Group {
        int texture = -1;  ///< index of a texture of the scene; -1: none
        bool masked = false, double_sided = false;
        float cutoff = 0;
        std::vector<std::uint32_t> indices;
        std::size_t first = 0;
    };
    /// Programs for plain, textured and masked triangles.
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
