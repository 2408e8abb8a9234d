// Stencil shadow volumes of the lights whose source they are: geometry, stencil buffer and result.
#pragma once

#include <array>
#include <memory>
#include <string>
#include <vector>

#include "renderer/frame/frame_pass.h"
#include "renderer/frame/state.h"
#include "renderer/view/lights/shadow_volume.h"

namespace si {

/// Counts at each pixel how many volumes hold the surface seen: of their faces behind it, those turned from the camera
/// add one and those turned to it take one away, so that the camera may stand in any of them (z-fail). Carmack, 2000;
/// Everitt and Kilgard, Practical and Robust Stenciled Shadow Volumes for Hardware-Accelerated Rendering, 2002;
/// McGuire, Hughes, Egan, Kilgard and Everitt, Fast, Practical and Robust Shadows, 2003.
///
/// By the older count, of the faces before the surface (z-pass, Heidmann, Real Shadows Real Time, 1991), those turned
/// to the camera add one: right only where the camera is in no volume and its near plane cuts none.
///
/// Volumes have no end; a camera without perspective is given one, far from the scene. Faces beyond the camera's far
/// plane count, as depth is clamped. A light cap coincides with the surface that casts:
/// it is drawn from the same corners in the same order, so that its depth is equal in every bit, and counts as behind.
/// All masked triangles cast as if they were solid, and so do blended ones that caster.blend lets cast. Culling of
/// casters is left aside: all cast from both sides. 256 volumes behind one another count as none.
class ShadowVolumes {
public:
    /// Triangles of casters without a closed surface, instances counted, above which nothing is drawn unless
    /// volumes.allow_large: each brings sides of its own.
    static constexpr std::size_t kMaxOpenTriangles = 20'000;

    /// Finds the volumes of the frame's lights, unless they are known, and which are too large to be drawn unasked.
    void prepare(const FrameState& f);
    /// Whether the light's volumes are drawn.
    bool draws(std::size_t light) const { return lights_[light].used && lights_[light].refusal.empty(); }
    /// Why not; empty: they are, or the light's source is another.
    const std::string& refusal(std::size_t light) const { return lights_[light].refusal; }
    /// Volumes of a light into its layer of lit().
    Pass make_pass(FrameState& f, std::size_t light);
    /// R8, a layer a light: 1 where the surface that the camera sees lies in no volume.
    const gl::Target& lit() const { return lit_; }
    /// Gives up the geometry of lights that have no volumes now.
    void release_unused();

private:
    struct Part {
        std::uint32_t instance = 0;  ///< of SceneGpu's transforms
        std::uint32_t mesh = 0;
        std::array<std::size_t, 4> first{};  ///< of caps, turned caps, the rest, and the end
    };
    struct Light {
        bool used = false;
        bool before = false;  ///< counts faces before the surface
        std::string refusal;
        std::uint64_t shape = 0;  ///< key of the triangles
        std::vector<Part> parts;
        std::vector<std::uint32_t> indices;
        std::size_t index_count = 0, open_triangles = 0;
        gl::Buffer buffer;
        std::uint64_t uploaded = 0;  ///< key of the triangles in `buffer`
        std::uint64_t drawn = 0;     ///< key of the layer
    };

    void build_volume_meshes(const FrameState& f);
    void build_volume_triangles(const FrameState& f, std::size_t light, const VolumeLight& source);
    std::string describe_cost(const FrameState& f, const Light& light, const VolumeLight& source) const;
    void upload_corners();
    void copy_depth(const FrameState& f, PassInfo& info);
    void count_volumes(const FrameState& f, std::size_t light, PassInfo& info);
    void draw_faces(const Light& light, int first, int last, PassInfo& info) const;

    std::uint64_t scene_ = 0, depth_copied_ = 0;
    bool corners_uploaded_ = false;
    std::vector<std::unique_ptr<VolumeMesh>> meshes_;  ///< by mesh of the scene; null: nothing casts it
    std::vector<std::uint32_t> first_corner_;          ///< by mesh
    std::array<Light, kMaxLights> lights_;             ///< frames remember where the keys of their layers stand
    gl::VertexArray vao_;
    gl::Buffer corners_;
    gl::Target depth_stencil_, lit_;
    gl::Framebuffer counting_, marking_;
};

/// Draws the shadow volumes of each light whose source they are.
class ShadowVolumePasses : public FramePass {
public:
    void declare(FrameState& f) override;
    /// Returns whether the light's volumes are drawn in the frame declared last.
    bool draws(std::size_t light) const { return volumes_.draws(light); }

private:
    ShadowVolumes volumes_;
};

}  // namespace si
