// Tests the cross-section of a probed pixel: its steps are the map's texels in metres under every light and map, and
// on a tilted plane everything follows from the plane's angle.
#include "renderer/inspect/section.h"

#include <algorithm>
#include <cmath>

#include "renderer/base/lengths_text.h"
#include "renderer/inspect/section_drawing.h"
#include "renderer/projection/projection.h"
#include "renderer/scenes/shapes.h"
#include "tests/gl/frame_fixture.h"
#include "tests/support/hard_case.h"
#include "tests/support/mesh_scene.h"
#include "tests/support/sets.h"
#include "tests/support/traits.h"

namespace si {
namespace {

const FrameRequest kPicture{.width = 160, .height = 120};
constexpr glm::ivec2 kMiddle{80, 60};

class SectionTest : public FrameTest {
protected:
    Probe probed;
    PixelDiagnosis diagnosis;

    const Probe::PerLight& light() const { return probed.lights.at(0); }

    Section section(const Scene& scene, const Settings& s, glm::ivec2 pixel = kMiddle) {
        probed = renderer.probe(scene, s, kPicture, pixel.x, pixel.y);
        if (!probed.hit) return {};
        const ReferenceScene casters(std::make_shared<ReferenceGeometry>(scene, s));
        diagnosis = diagnose_pixel(probed, light(),
                                   trace_fragment_reference(casters, probed, light(), s, object_traits(scene, s)), s,
                                   renderer.driver());
        const int n = probed.map_resolution;
        const SectionCut cut = section_cut(light(), &diagnosis, s, n);
        return cross_section(light(), &diagnosis, cut, n, reference_profile(casters, light(), cut, n));
    }

    /// Returns settings with a sun over the map's v axis. @param elevation degrees
    static Settings sun(double elevation, double constant_texels) {
        Settings s = test::texel_settings("hard", 256, constant_texels);
        s.lights[0].azimuth = 0;
        s.lights[0].elevation = elevation;
        return s;
    }
    /// Returns y of the surface's line.
    static double surface_y(const Section& s, double x) {
        return s.surface_at.y + (x - s.surface_at.x) * s.surface_along.y / s.surface_along.x;
    }

    /// Returns settings with a normal offset in texels as the only bias, and one hard comparison.
    static Settings offset_alone(LightType type, double texels) {
        Settings s = test::texel_settings("hard", 256, 0);
        s.lights[0].type = type;
        s.bias.normal = texels;
        return s;
    }

    const LightView& view() const { return light().fitted.views.at(std::size_t(light().face)); }
    /// Expects both ends to equal the diagnosis, by projecting places on the surface's ray, and to be drawn at that
    /// distance before the ring.
    void expect_window_before_surface(const Section& s, const SectionDrawing& d) const {
        const Probe::PerLight& p = light();
        const glm::dmat4 uvd_from_surface =
            uvd_from_clip(view().curve.convention) * view().clip_from_relative(probed.position_ws);
        const auto depth_change_towards_light = [&](double metres) {
            const glm::dvec4 h = uvd_from_surface * glm::dvec4(metres * p.account.receiver.to_light, 1);
            return (view().curve.convention.reversed ? -1 : 1) * (p.account.receiver.uvd.z - h.z / h.w);
        };
        EXPECT_NEAR(depth_change_towards_light(s.window_from), diagnosis.least.depth, 1e-6 * diagnosis.least.depth);
        if (s.light == LightType::Directional) {
            EXPECT_NEAR(s.window_from, diagnosis.least.metres, 1e-6 * diagnosis.least.metres);
            EXPECT_NEAR(s.window_from, s.least.texels * p.account.receiver.texel_m, 1e-6 * diagnosis.least.metres)
                << "as is printed";
        }
        EXPECT_EQ(std::isfinite(s.window_to), std::isfinite(diagnosis.occluder.depth));
        if (std::isfinite(s.window_to)) {
            EXPECT_NEAR(depth_change_towards_light(s.window_to), diagnosis.occluder.depth,
                        1e-6 * diagnosis.occluder.depth);
        }
        const auto end = std::ranges::find_if(d.marks, [](const Mark& m) {
            return m.kind == Mark::Kind::Line && (m.ink == Ink::Window || m.ink == Ink::NoWindow);
        });
        ASSERT_NE(end, d.marks.end());
        const glm::dvec2 drawn = 0.5 * (end->points[0] + end->points[1]) + glm::dvec2(0.75 * SectionPage().em, 0);
        const glm::dvec2 wanted = diagnosis.least.metres * s.light_ray;
        EXPECT_NEAR(drawn.x - d.zero_x, wanted.x * d.across, 1e-6 * d.across * glm::length(wanted));
        EXPECT_NEAR(d.zero_y - drawn.y, wanted.y * d.along, 1e-6 * d.along * glm::length(wanted));
    }
    /// Expects the scale's bar to be as wide as the texels, and the offset's arrow as long as its label reports.
    void expect_to_scale(const Section& s, const SectionDrawing& d) const {
        const auto scale = std::ranges::find_if(d.marks, [](const Mark& m) {
            return m.kind == Mark::Kind::Text && m.ink == Ink::Muted && m.text.find(" = ") != std::string::npos;
        });
        ASSERT_NE(scale, d.marks.end());
        const std::vector<glm::dvec2>& bar = (scale - 1)->points;
        const double texel = (bar.back().x - bar.front().x) / std::stod(scale->text);
        ASSERT_TRUE(s.lookup_step());
        const Section::Step& step = *s.lookup_step();
        EXPECT_NEAR(texel, (step.compared_to.x - step.compared_from.x) * d.across, 1e-3 * texel) << scale->text;
        EXPECT_NE(scale->text.find(metres_text(std::stod(scale->text) * texel / d.across)), std::string::npos)
            << scale->text;

        const auto arrow = std::ranges::find_if(
            d.marks, [](const Mark& m) { return m.kind == Mark::Kind::Line && m.ink == Ink::Offset && m.arrow; });
        if (glm::length(s.moved * glm::dvec2(d.across, d.along)) < 0.2 * SectionPage().em) return;
        ASSERT_NE(arrow, d.marks.end());
        const glm::dvec2 way = (arrow->points[1] - arrow->points[0]) / glm::dvec2(d.across, d.along);
        // The expected value uses world vectors, without the part that leaves the plane of the cut.
        const glm::dvec3 offset = light().offset_position_ws - light().point.position_ws;
        const glm::dvec3 ray = view().curve.perspective ? view().eye - light().offset_position_ws : view().axes[2];
        const glm::dvec3 normal = glm::normalize(glm::cross(view().axes[s.cut.axis], ray));
        const double whole = glm::length(offset), held = glm::length(offset - normal * glm::dot(offset, normal));
        EXPECT_NEAR(glm::length(way), held, 1e-6 * whole);
        const bool leaves = whole - held > 1e-3 * whole;
        const std::string words =
            leaves ? "offset " + metres_text(held) + " in the cut" : "normal offset " + metres_text(whole);
        EXPECT_TRUE(std::ranges::any_of(d.marks, [&](const Mark& m) { return m.text == words; })) << words;
    }
};

SI_TESTS_ARE(DriverIndependent, SectionTest);
SI_TEST_IS(Repeated, SectionTest, StepsEqualTheMapsTexelsUnderEveryLightAndMap);
SI_TEST_IS(Later, SectionTest, StepsEqualTheMapsTexelsUnderEveryLightAndMap);
TEST_F(SectionTest, StepsEqualTheMapsTexelsUnderEveryLightAndMap) {
    const Scene scene = test::floor_and_box(10, {1.5, 1, 2}, 0.3);
    const std::vector<Sets> kinds{{"light.type=directional"},
                                  {"light.type=directional", "map.format=d16"},
                                  {"map.reversed_z=true"},
                                  {"light.fit=lispsm"},
                                  {"light.cascades=3", "light.fit=view"},
                                  {"light.type=spot"},
                                  {"light.type=spot", "map.reversed_z=true"},
                                  {"light.type=spot", "map.format=linear"},
                                  {"light.type=point"},
                                  {"light.type=point", "map.format=linear16", "map.reversed_z=true"}};
    for (const Sets& kind : kinds) {
        Settings s = test::texel_settings("pcf3", 256, 1);
        set_all(s, kind);
        const std::string name = kind.front().second + (kind.size() > 1 ? " " + kind[1].second : "");
        int steps = 0, nearer = 0;
        for (const glm::ivec2 pixel : {glm::ivec2(80, 60), {66, 58}, {64, 66}, {72, 70}, {94, 66}, {84, 48}}) {
            const Section cut = section(scene, s, pixel);
            if (!cut.shadowed) continue;
            FrameRequest maps = kPicture;
            maps.outputs = {.colour = false, .shadow_map = true};
            const FrameResult frame = renderer.render(scene, s, maps);
            const FloatImage map = renderer.read_shadow_map(frame, 0, light().face);
            const LightView& view = light().fitted.views.at(std::size_t(light().face));
            const int n = map.width;
            // The expected value uses the inverse of the map's projection at the surface's point, which the tested
            // code does not use.
            const glm::dmat4 ws_from_uvd =
                glm::inverse(uvd_from_clip(view.curve.convention) * view.clip_from_relative(probed.position_ws));
            for (const Section::Step& step : cut.steps) {
                if (!step.in_map || step.meets == KernelTap::Meets::Nothing) continue;
                const glm::ivec2 texel =
                    cut.cut.axis == 0 ? glm::ivec2(step.texel, cut.row) : glm::ivec2(cut.row, step.texel);
                const double stored = map.at(texel.x, n - 1 - texel.y);
                // Distances become depths in single precision, here and in the kernel.
                EXPECT_NEAR(step.stored, stored, name.find("linear") == name.npos ? 0 : 3e-6) << name << step.texel;
                // A warped map's depth range is that of the texel's centre, the only exact place.
                glm::dvec2 at = (glm::dvec2(texel) + 0.5) / double(n);
                if (!view.warped()) at[1 - cut.cut.axis] = light().account.receiver.tap[1 - cut.cut.axis];
                const glm::dvec4 h = ws_from_uvd * glm::dvec4(at, step.stored, 1);
                const glm::dvec3 from_surface = glm::dvec3(h) / h.w;
                const glm::dvec3 ray = light().account.receiver.to_light;
                const glm::dvec2 middle = 0.5 * (step.from + step.to);
                const double along = glm::dot(from_surface, ray);
                if (!view.warped()) {
                    EXPECT_NEAR(glm::length(middle), glm::length(from_surface), 1e-5 + 1e-4 * std::abs(along))
                        << name << " " << step.texel;
                }
                EXPECT_NEAR(middle.y, along, 1e-5 + 1e-4 * glm::length(from_surface)) << name << " " << step.texel;
                ++steps;
                nearer += step.meets == KernelTap::Meets::Nearer;
            }
        }
        EXPECT_GT(steps, 12) << name;
        EXPECT_GT(nearer, 0) << name << ": a step of the box belongs among them";
    }
}

TEST_F(SectionTest, ACutAcrossTheShortSideOfAMapShowsItsTexels) {
    const Scene scene = test::floor_and_box(10, {1.5, 1, 2}, 0.3);
    const Settings s = test::texel_settings("pcf3", 256, 1);
    FrameRequest oblong = kPicture;
    oblong.map_size = MapSize(256, 64);
    int beyond_short_side = 0;
    for (int x = 16; x <= 144; x += 16) {
        const Probe probe = renderer.probe(scene, s, oblong, x, kMiddle.y);
        if (!probe.hit || probe.lights.at(0).rows[0].empty()) continue;
        ASSERT_EQ(probe.map_size, MapSize(256, 64));
        const Probe::PerLight& p = probe.lights[0];
        for (const int axis : {0, 1}) {
            const SectionCut cut{.axis = axis, .first = p.texel[axis] - 2, .count = 5};
            const Section shown = cross_section(p, nullptr, cut, probe.map_size);
            ASSERT_TRUE(shown.lookup_step()) << x << " axis " << axis;
            EXPECT_TRUE(shown.lookup_step()->in_map) << x << " axis " << axis;
        }
        beyond_short_side += p.texel.x >= probe.map_size.height;
    }
    EXPECT_GT(beyond_short_side, 0);
}

TEST_F(SectionTest, OnATiltedPlaneAcneFollowsFromTheAngle) {
    const Scene scene = make_scene(make_plane(10, 10));
    for (const double elevation : {65.0, 40.0, 25.0}) {
        const double theta = glm::radians(90 - elevation);
        std::optional<Section> found;
        for (int y = 50; y < 70 && !found; ++y) {
            const Section s = section(scene, sun(elevation, 0), {80, y});
            if (s.artefact == "acne") found = s;
        }
        ASSERT_TRUE(found) << "no bias, no acne?";
        const Section& s = *found;
        const double texel = s.texel_m;
        EXPECT_EQ(s.cut.axis, 1) << "the sun stands over v";
        EXPECT_NEAR(std::abs(s.surface_along.y / s.surface_along.x), std::tan(theta), 1e-6);
        EXPECT_NEAR(glm::length(s.moved), 0, 1e-9) << "no offset";
        ASSERT_TRUE(s.lookup_step());
        EXPECT_LT(s.compared.y, s.lookup_step()->from.y) << "acne: the point lies behind its own texel's step";
        EXPECT_FALSE(s.lit);
        EXPECT_TRUE(s.reference_lit);
        for (const Section::Step& step : s.steps) {
            EXPECT_EQ(step.meets, KernelTap::Meets::Own);
            EXPECT_NEAR(step.from.y, surface_y(s, 0.5 * (step.from.x + step.to.x)), 1e-3 * texel)
                << "each step crosses the surface in its middle";
            EXPECT_NEAR(step.to.x - step.from.x, texel, 1e-9);
        }
        // The tolerance is half a texel of the slope, up to a sixteenth for the sub-pixel grid, and little for format
        // and rounding.
        EXPECT_TRUE(s.window_open());
        EXPECT_GE(s.window_from, 0.5 * texel * std::tan(theta));
        EXPECT_LT(s.window_from, (0.505 + 1.0 / 16) * texel * std::tan(theta) + 0.01 * texel);
        EXPECT_NEAR(s.window_from, diagnosis.least.metres, 1e-9);
        EXPECT_GT(s.window_from, s.lookup_step()->from.y) << "and clears this step";
        ASSERT_EQ(s.profile.size(), 1u) << "one surface in the reference";
        EXPECT_GT(s.profile[0].size(), 8u * s.steps.size());
        for (const glm::dvec2& p : s.profile[0]) EXPECT_NEAR(p.y, surface_y(s, p.x), 1e-4 * texel);
    }
}

TEST_F(SectionTest, ANormalOffsetOfHClearsHOverCosine) {
    const Scene scene = make_scene(make_plane(10, 10));
    Settings settings = sun(35, 0);
    settings.bias.normal = 1.5;
    const Section s = section(scene, settings);
    const double theta = glm::radians(55.0), h = s.normal_offset_m;
    EXPECT_NEAR(h, 1.5 * s.texel_m, 1e-9);
    EXPECT_NEAR(s.moved.y, h * std::cos(theta), 1e-6);
    EXPECT_NEAR(std::abs(s.moved.x), h * std::sin(theta), 1e-6);
    EXPECT_NEAR(s.moved.y - surface_y(s, s.moved.x), h / std::cos(theta), 1e-6);
    EXPECT_NEAR(s.has.metres, h / std::cos(theta), 1e-6) << "the diagnosis' equivalent depth bias";
    EXPECT_TRUE(s.lit && s.artefact.empty());
    EXPECT_GT(s.compared.y, s.window_from);
    EXPECT_TRUE(s.terms.empty()) << "no depth bias";
}

TEST_F(SectionTest, TheWindowOfAcneWithAnOffsetCountsFromTheSurface) {
    const Scene scene = make_scene(make_plane(10, 10));
    for (const LightType type : test::kLightTypes) {
        SCOPED_TRACE(int(type));
        std::optional<Section> found;
        Settings settings = offset_alone(type, 0.1);
        settings.lights[0].elevation = 25;  // low, so that no face of a point light's map lies along the floor
        for (int y = 40; y < 80 && !found; ++y) {
            const Section s = section(scene, settings, {80, y});
            if (s.artefact == "acne" && s.has_window) found = s;
        }
        ASSERT_TRUE(found) << "hardly any bias, no acne?";
        const SectionDrawing d = draw_section(*found, {.captions = false});
        EXPECT_GT(glm::length(found->moved), 0);
        EXPECT_GT(found->window_from, 0) << "behind the surface";
        expect_window_before_surface(*found, d);
        expect_to_scale(*found, d);
    }
}

SI_TEST_IS(Slow, SectionTest, WindowAndScaleHoldUnderEveryLightWithAnOffsetAndWithout);
TEST_F(SectionTest, WindowAndScaleHoldUnderEveryLightWithAnOffsetAndWithout) {
    const Scene scene = test::floor_and_box(10, {1.5, 1, 2}, 0.3);
    int aslant = 0, leave_the_cut = 0;
    for (const LightType type : test::kLightTypes)
        for (const double texels : {0.0, 3.0}) {
            int classified = 0, bounded = 0;
            for (int y = 18; y <= 114 && (classified < 12 || bounded < 2); y += 6)
                for (int x = 16; x <= 144 && (classified < 12 || bounded < 2); x += 8) {
                    const Section s = section(scene, offset_alone(type, texels), {x, y});
                    if (!s.has_window || !s.lookup_step()) continue;
                    SCOPED_TRACE(testing::Message() << int(type) << ", " << texels << " texels, " << x << "," << y);
                    const SectionDrawing d = draw_section(s, {.captions = false});
                    expect_window_before_surface(s, d);
                    expect_to_scale(s, d);
                    ++classified;
                    bounded += std::isfinite(s.window_to);
                    aslant += s.texel_long_m > 1.02 * s.texel_m;
                    leave_the_cut += std::abs(s.surface_offset_texels) > 0.5;
                }
            EXPECT_GE(classified, 12) << int(type);
            EXPECT_GE(bounded, 2) << int(type);
        }
    EXPECT_GT(aslant, 0);
    EXPECT_GT(leave_the_cut, 0);
}

TEST_F(SectionTest, PeterPanningPutsTheComparedPointBeforeItsOccluder) {
    const double elevation = 50, height = 0.3;
    const Settings settings = sun(elevation, 14);
    std::optional<Section> found;
    for (int y = 58; y < 64 && !found; ++y) {
        // The camera looks from the side, below the sheet.
        Settings s = settings_with(settings, {"camera.elevation=5", "camera.target_y=0.1"});
        const Section one = section(test::sheet_over_floor(height), s, {80, y});
        if (one.artefact.find("peter-panning") == 0) found = one;
    }
    ASSERT_TRUE(found);
    const Section& s = *found;
    EXPECT_TRUE(s.lit);
    EXPECT_FALSE(s.reference_lit);
    ASSERT_TRUE(s.occluder);
    EXPECT_NEAR(s.occluder_m, height / std::sin(glm::radians(elevation)), 1e-4);
    EXPECT_NEAR(s.occluder->x, 0, 1e-9);
    EXPECT_NEAR(s.occluder->y, s.occluder_m, 1e-9);
    EXPECT_NEAR(s.window_to, s.occluder_m, 1e-6) << "the window ends where the occluder stands";
    EXPECT_TRUE(s.window_open());
    EXPECT_GT(s.compared.y, s.window_to) << "and the compared point lies before it";
    ASSERT_EQ(s.terms.size(), 1u);
    EXPECT_EQ(s.terms[0].name, "constant bias");
    EXPECT_NEAR(s.terms[0].to.y, s.compared.y, 1e-9);
    ASSERT_TRUE(s.lookup_step());
    EXPECT_GE(s.compared.y, s.lookup_step()->from.y);
}

TEST_F(SectionTest, KeepsItsFormWithoutGeometryToCut) {
    const Scene scene = make_scene(make_plane(10, 10));
    Settings s = sun(40, 1);
    s.lights[0].cast = false;
    const Section none = section(scene, s);
    EXPECT_FALSE(none.shadowed);
    EXPECT_TRUE(none.steps.empty());
    EXPECT_FALSE(none.verdict.empty());
}

}  // namespace
}  // namespace si
