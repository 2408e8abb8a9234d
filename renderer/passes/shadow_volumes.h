// Stencil shadow volumes of lights: geometry, stencil buffer and result.
#pragma once

#include <array>
#include <memory>
#include <string>
#include <vector>

#include "renderer/frame/frame_pass.h"
#include "renderer/frame/state.h"
#include "renderer/view/lights/shadow_volume.h"

namespace si {

/// Stencil shadow volumes of all lights whose light.source is shadow volumes: builds the volumes and counts them at
/// each pixel.
///
/// The stencil counts how many volumes contain the visible surface, by the volume faces behind the surface (z-fail):
/// back faces add one, front faces subtract one. The camera may therefore stand inside a volume. Carmack, 2000; Everitt
/// and Kilgard, Practical and Robust Stenciled Shadow Volumes for Hardware-Accelerated Rendering, 2002; McGuire,
/// Hughes, Egan, Kilgard and Everitt, Fast, Practical and Robust Shadows, 2003.
///
/// The older method counts the faces in front of the surface (z-pass, Heidmann, Real Shadows Real Time, 1991): front
/// faces add one, back faces subtract one. It is right only if the camera is in no volume and its near plane cuts none.
///
/// Volumes are infinite; for an orthographic camera they end far from the scene. Faces beyond the camera's far plane
/// count, as depth is clamped. A light cap (end of a volume near the light) coincides with its caster's surface. The
/// cap is drawn from the same corners in the same order, so that depths are equal in every bit. It counts as behind the
/// surface. Masked triangles cast as if opaque. Blended triangles do so too, where caster.blend lets them cast. Caster
/// culling is ignored: all casters cast from both sides. The stencil has 8 bits: 256 nested volumes count as none.
class ShadowVolumes {
public:
    /// Largest number of a light's caster triangles that belong to no closed surface, over all instances. With more,
    /// the light's volumes are drawn only with volumes.allow_large, since each such triangle adds side faces.
    static constexpr std::size_t kMaxOpenTriangles = 20'000;

    /// Builds the stencil shadow volumes of the frame's lights where they changed, and decides which are too large to
    /// draw.
    void prepare(const FrameState& f);
    /// Returns true when the frame draws shadow volumes of the light.
    bool draws(std::size_t light) const { return lights_[light].used && lights_[light].refusal.empty(); }
    /// Returns the reason why a light's volumes are not drawn. Empty: they are drawn, or the light has another source.
    const std::string& refusal(std::size_t light) const { return lights_[light].refusal; }
    /// Returns the pass that counts the shadow volumes of a light in the stencil buffer, and draws the light's
    /// visibility into a layer of the visibility image (lit()).
    /// @param light light index
    Pass make_pass(FrameState& f, std::size_t light);
    /// Returns the visibility image: R8, a layer for each light, 1 where the visible surface lies in no volume.
    const gl::Target& lit() const { return lit_; }
    /// Frees the geometry of lights that draw no shadow volumes in this frame. Call after the frame is planned and
    /// before its passes run.
    void release_unused();

private:
    /// Index ranges of the shadow volume of one caster instance: light caps (ends near the light), light caps that wind
    /// clockwise seen from outside the volume, and other faces.
    struct Part {
        std::uint32_t instance = 0;  ///< index into SceneGpu's transforms
        std::uint32_t mesh = 0;
        std::array<std::size_t, 4> first{};  ///< first index: caps, clockwise caps, other faces, end
    };
    /// Stencil shadow volumes of one light, with cache keys of the triangles computed, uploaded and drawn.
    struct Light {
        bool used = false;
        bool before = false;  ///< z-pass: counts faces in front of the surface
        std::string refusal;
        std::uint64_t shape = 0;  ///< cache key of `indices`
        std::vector<Part> parts;
        std::vector<std::uint32_t> indices;
        std::size_t index_count = 0, open_triangles = 0;
        gl::Buffer buffer;
        std::uint64_t uploaded = 0;  ///< cache key of the triangles in `buffer`
        std::uint64_t drawn = 0;     ///< cache key of the light's layer
    };

    /// Drops the edge lists of all meshes, from which shadow volumes are built, when the frame has another scene.
    void reset_volume_meshes(const FrameState& f);
    /// Builds the shadow volumes of all casters for one light. Also builds the edge lists of meshes that had none.
    /// @param light light index
    /// @param source direction or position of the light
    void build_volume_triangles(const FrameState& f, std::size_t light, const VolumeLight& source);
    /// Returns an estimate of what drawing a light's shadow volumes costs, in words: number of triangles, and how many
    /// times their area covers the picture. Used to explain why they are not drawn.
    std::string describe_cost(const FrameState& f, const Light& light, const VolumeLight& source) const;
    /// Uploads the vertex positions of all casting meshes for shadow volumes, once for a scene.
    void upload_corners();
    /// Copies the camera's depth into the depth and stencil buffer against which faces of shadow volumes are tested,
    /// unless the copy is current.
    /// @param[out] info draw and triangle counts
    void copy_depth(const FrameState& f, PassInfo& info);
    /// Counts in the stencil buffer how many shadow volumes of a light contain each pixel's surface, and marks pixels
    /// in none as lit.
    /// @param light light index
    /// @param[out] info draw and triangle counts
    void count_volumes(const FrameState& f, std::size_t light, PassInfo& info);
    /// Draws the light caps (ends near the light) or the other faces of a light's shadow volumes into the stencil
    /// buffer.
    /// @param first, last kinds of faces to draw, from `first` to `last`: 0 light caps, 1 light caps that wind
    /// clockwise seen from outside the volume, 2 other faces
    /// @param[out] info draw and triangle counts
    void draw_faces(const Light& light, int first, int last, PassInfo& info) const;

    std::uint64_t scene_ = 0, depth_copied_ = 0;
    bool corners_uploaded_ = false;
    std::vector<std::unique_ptr<VolumeMesh>> meshes_;  ///< by mesh of the scene; null: no object casts it
    std::vector<std::uint32_t> first_corner_;          ///< by mesh
    std::array<Light, kMaxLights> lights_;             ///< stable addresses, as frames keep pointers to layer keys
    gl::VertexArray vao_;
    gl::Buffer corners_;
    gl::Target depth_stencil_, lit_;
    gl::Framebuffer counting_, marking_;
};

/// Passes that draw stencil shadow volumes, one for each light whose light.source is shadow volumes.
class ShadowVolumePasses : public FramePass {
public:
    void declare(FrameState& f) override;
    /// Returns true when the light's volumes are drawn in the frame declared last.
    bool draws(std::size_t light) const { return volumes_.draws(light); }

private:
    ShadowVolumes volumes_;
};

}  // namespace si
