// Compares the triangle id of each drawn pixel with rays tested against every triangle.
#include "app/session/session.h"
#include "renderer/reference/receivers.h"
#include "renderer/scenes/shapes.h"
#include "tests/gl/frame_fixture.h"
#include "tests/support/ray_reference.h"
#include "tests/support/traced.h"
#include "tests/support/traits.h"

namespace si {
namespace {

class SurfaceIdsTest : public FrameTest {
protected:
    FrameResult frame;
    SurfaceIds draw(const Scene& scene, const Settings& settings, int width = 240, int height = 160) {
        FrameRequest request{.width = width, .height = height, .outputs = {.colour = false, .surface_ids = true}};
        frame = renderer.render(scene, settings, request);
        return renderer.read_surface_ids(frame.surface_ids);
    }
};

Scene ring_scene() {
    Scene scene;
    const int grey = add_material(scene, "grey", {0.6f, 0.6f, 0.6f}), red = add_material(scene, "red", {0.6f, 0, 0});
    add_object(scene, "floor", -1, add_mesh(scene, "floor", make_plane(8, 8, 4, 4), grey));
    const int ring = add_mesh(scene, "ring", make_torus(1, 0.3, 20, 10), red);
    for (int i = 0; i < 4; ++i)  // one draw
        add_object(scene, "ring", -1, ring, moved(0.9 * i - 1.5, 1, 0.4 * i) * turned(50 * i, {1, 0, 0}));
    add_object(scene, "mirrored ring", -1, ring, moved(-1.5, 0.6, 2) * scaled(-0.6, 0.4, 0.6));
    add_object(scene, "box", -1, add_mesh(scene, "box", make_box({0.7, 1.2, 0.5}), grey), moved(1.8, 0.6, -1));
    finalise(scene);
    return scene;
}

TEST_F(SurfaceIdsTest, EqualTheFirstHitsOfRays) {
    const Scene scene = ring_scene();
    const Settings settings = settings_for(scene);
    const SurfaceIds drawn = draw(scene, settings), traced = test::ids_by_rays(scene, frame.camera, 240, 160);
    const ReferenceGeometry geometry(scene, settings);
    const Receivers a = reconstruct_receivers(geometry, frame.camera, drawn, {});
    const Receivers b = reconstruct_receivers(geometry, frame.camera, traced, {});
    std::size_t shown = 0, differing = 0, far = 0;
    std::vector<std::size_t> pixels(scene.objects.size());
    for (std::size_t i = 0; i < drawn.data.size(); ++i) {
        shown += drawn.data[i].x != 0;
        if (drawn.data[i].x) ++pixels[drawn.data[i].x - 1];
        if (a.pixels[i].object != b.pixels[i].object || a.pixels[i].primitive != b.pixels[i].primitive)
            ++differing;
        else
            far += glm::distance(a.pixels[i].position_ws, b.pixels[i].position_ws) > 1e-12;
    }
    EXPECT_GT(shown, drawn.data.size() / 8);
    EXPECT_EQ(far, 0u);
    // A rasteriser snaps corners to a grid of 1/256 pixel: some pixels at edges show the neighbour.
    EXPECT_LT(differing, drawn.data.size() / 300);
    for (std::size_t o = 0; o < pixels.size(); ++o) EXPECT_GT(pixels[o], 20u) << "object " << o;
}

TEST_F(SurfaceIdsTest, AreCachedAndFollowTheCamera) {
    const Scene scene = ring_scene();
    Settings settings = settings_for(scene);
    const SurfaceIds first = draw(scene, settings);
    EXPECT_EQ(frame.pass("surface ids")->state, PassState::Drawn);
    set_setting(settings, "bias.kind", "slope");
    EXPECT_EQ(draw(scene, settings).data, first.data);
    EXPECT_EQ(frame.pass("surface ids")->state, PassState::Cached);
    set_all(settings, {"camera.source=manual", "camera.azimuth=100"});
    EXPECT_NE(draw(scene, settings).data, first.data);
    const FrameResult other = renderer.render(scene, settings, small_request());
    EXPECT_EQ(other.pass("surface ids")->state, PassState::Skipped);
}

/// Makes a masked quad in front of the camera.
Scene masked_quad(bool nearest, TextureWrap wrap) {
    Scene scene;
    Material leaf;
    leaf.alpha = AlphaMode::Mask;
    leaf.base_colour_texture = 0;
    leaf.alpha_cutoff = 0.4f;
    leaf.base_colour.a = 0.9f;
    leaf.double_sided = true;
    scene.materials.push_back(leaf);
    Texture t;
    t.width = 13;
    t.height = 8;
    t.mipmaps = false;  // level 0 at every distance
    t.nearest_mag = t.nearest_min = nearest;
    t.wrap_s = wrap;
    t.wrap_t = TextureWrap::Mirror;
    Random random(5);
    for (int i = 0; i < t.width * t.height; ++i) t.rgba.append({90, 120, 60, std::uint8_t(random.in(0, 256))});
    scene.textures.push_back(t);
    Mesh quad = make_quad(2, 2);
    for (glm::vec2& uv : quad.uv.edit()) uv = uv * 3.3f - glm::vec2(1.1f);
    quad.colours.assign(quad.positions.size(), glm::vec4(1, 1, 1, 0.8f));
    quad.colours.edit()[0].a = 1;
    add_object(scene, "quad", -1, add_mesh(scene, "quad", quad, 0));
    finalise(scene);
    return scene;
}

TEST_F(SurfaceIdsTest, MasksAgreeWithTheReferenceAtMipLevelZero) {
    for (const bool nearest : {true, false})
        for (const TextureWrap wrap : {TextureWrap::Repeat, TextureWrap::Clamp, TextureWrap::Mirror}) {
            const Scene scene = masked_quad(nearest, wrap);
            const Settings settings =
                settings_for(scene, {"camera.source=manual", "camera.azimuth=20", "camera.elevation=15",
                                     "camera.distance=3", "camera.target_y=1"});
            const SurfaceIds drawn = draw(scene, settings, 400, 300);
            const SurfaceIds behind = test::ids_by_rays(scene, frame.camera, 400, 300);  // ignores masks
            const ReferenceGeometry geometry(scene, settings);
            const AlphaMask& mask = *geometry.objects[0].mesh->mask;
            std::size_t holes = 0, solid = 0, wrong = 0;
            for (const auto& [x, y, origin, dir] : test::pixel_rays(frame.camera, 400, 300)) {
                const std::size_t i = std::size_t(y) * 400 + std::size_t(x);
                if (!behind.data[i].x) continue;
                const TriangleWs t = geometry.triangle(0, behind.data[i].y);
                const glm::dvec3 e1 = t[1] - t[0], e2 = t[2] - t[0], p = glm::cross(dir, e2), s = origin - t[0];
                const double det = glm::dot(e1, p);
                const bool is_solid =
                    mask.is_solid(behind.data[i].y, glm::dot(s, p) / det, glm::dot(dir, glm::cross(s, e1)) / det);
                ++(is_solid ? solid : holes);
                wrong += is_solid != (drawn.data[i].x != 0);
            }
            EXPECT_GT(holes, 5000u);
            EXPECT_GT(solid, 5000u);
            // The quad's outline is snapped, and single precision decides at the alpha cutoff.
            EXPECT_LT(wrong, 60u) << (nearest ? "nearest" : "bilinear") << " wrap " << int(wrap);
        }
}

TEST_F(SurfaceIdsTest, ReferenceAndShadowMapHoldTheSameTriangles) {
    for (const char* name : {"stage", "boxes", "teapot", "figures"})
        for (const char* time : {"scene.time=0", "scene.time=0.7"}) {
            Session session = open_session({.scene = name, .sets = {time, "light.0.type=directional"}});
            const std::size_t first = std::size_t(session.scene.objects[0].node);
            set_setting(session.settings, "object." + session.scene.nodes[first].path + ".cast", "false");
            FrameRequest request = small_request({.colour = false, .shadow_map = true});
            request.force = true;
            const FrameResult result = renderer.render(session.scene, session.settings, request);
            ASSERT_EQ(result.passes[0].state, PassState::Drawn) << name;
            const auto geometry = std::make_shared<ReferenceGeometry>(session.scene, session.settings);
            EXPECT_GT(result.passes[0].triangles, 0u) << name;
            EXPECT_LT(result.passes[0].triangles, session.scene.triangle_count()) << name;
            EXPECT_EQ(ReferenceScene(geometry).triangle_count(), result.passes[0].triangles) << name;
            EXPECT_EQ(geometry->caster_triangles(), result.passes[0].triangles) << name;
        }
}

/// Returns the pixels that show a triangle whose plane contains the camera, within single precision.
std::vector<glm::ivec2> seen_edge_on(const Scene& scene, const Settings& s, const SurfaceIds& ids, const Camera& c) {
    const ReferenceGeometry geometry(scene, s);
    std::vector<glm::ivec2> out;
    for (int y = 0; y < ids.height; ++y)
        for (int x = 0; x < ids.width; ++x) {
            const glm::uvec2 id = ids.data[std::size_t(y * ids.width + x)];
            if (id.x == 0) continue;
            const TriangleWs t = geometry.triangle(id.x - 1, id.y);
            const glm::dvec3 normal = glm::normalize(glm::cross(t[1] - t[0], t[2] - t[0]));
            if (std::abs(glm::dot(normal, c.axes[2])) < 1e-7) out.push_back({x, y});
        }
    return out;
}

SI_TEST_IS(Repeated, SurfaceIdsTest, SurfacesSeenEdgeOnAreShadedAndProbed);
// A triangle may cover a pixel by rounding alone. Its plane may then give the pixel no position. The results are finite
// all the same, and equal with fused and separate visibility.
SI_TEST_IS(Later, SurfaceIdsTest, SurfacesSeenEdgeOnAreShadedAndProbed);
TEST_F(SurfaceIdsTest, SurfacesSeenEdgeOnAreShadedAndProbed) {
    const Scene scene = load_scene("stage");
    std::size_t met = 0;
    for (const int turn : {0, 4}) {
        Settings s = stage_from_above(scene, "256");
        s.camera.roll += 45 * turn;
        s.camera.target_x += 0.01 * turn;
        const SurfaceIds ids = draw(scene, s, 295, 332);
        FrameRequest request{.width = ids.width, .height = ids.height};
        const ByteImage fused = renderer.read_colour(renderer.render(scene, s, request).colour);
        request.outputs.visibility = true;
        const ByteImage apart = renderer.read_colour(renderer.render(scene, s, request).colour);
        for (const glm::ivec2& at : seen_edge_on(scene, s, ids, frame.camera)) {
            ++met;
            SCOPED_TRACE(testing::Message() << "turn " << turn << ", pixel " << at.x << ", " << at.y);
            const std::size_t i = std::size_t(at.y * ids.width + at.x);
            int brightness = 0, off = 0;
            for (std::size_t c = 4 * i; c < 4 * i + 3; ++c) {
                brightness += fused.data[c];
                off = std::max(off, std::abs(int(fused.data[c]) - int(apart.data[c])));
            }
            EXPECT_GT(brightness, 0) << "what is no number is drawn black";
            EXPECT_LE(off, 1) << "fused and apart";
            const Probe probe = renderer.probe(scene, s, request, at.x, at.y);
            EXPECT_TRUE(probe.hit);
            EXPECT_EQ(probe.id, ids.data[i]) << "the probe names another surface than the picture";
            EXPECT_TRUE(std::isfinite(glm::length(probe.position_ws)));
        }
    }
    EXPECT_GT(met, 0u);
}

}  // namespace
}  // namespace si
