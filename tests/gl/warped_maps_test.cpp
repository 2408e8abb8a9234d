// Tests maps warped towards the camera (light.fit lispsm), as drawn and read.
#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

#include "app/report/map_report.h"
#include "renderer/measure/measured_error.h"
#include "renderer/scenes/shapes.h"
#include "renderer/settings/filters.h"
#include "tests/gl/frame_fixture.h"
#include "tests/support/combinations.h"
#include "tests/support/hard_case.h"
#include "tests/support/sets.h"
#include "tests/support/traits.h"

namespace si {
namespace {

class WarpedMapsTest : public FrameTest {
protected:
    ReferenceCache cache;
    inline static const FrameRequest kPicture{.width = 160, .height = 90};

    /// Makes a ground of 60 m with boxes, one of them mirrored, seen along the ground.
    static Scene long_ground(const glm::dvec3& at) {
        Scene scene;
        const int grey = add_material(scene, "grey", {0.6f, 0.6f, 0.6f});
        add_object(scene, "ground", -1, add_mesh(scene, "ground", make_plane(60, 60), grey));
        const int box = add_mesh(scene, "box", make_box({1, 2, 1}), grey);
        // Casters cover the whole ground: otherwise the map of the caster region is small, and compares nothing.
        for (int i = 0; i < 36; ++i)
            add_object(scene, "box" + std::to_string(i), -1, box,
                       moved(9 * (i % 6) - 22, 1.2, 27 - 9 * (i / 6)) *
                           (i == 8 ? glm::scale(glm::dmat4(1), glm::dvec3(-1, 1, 1)) : glm::dmat4(1)));
        test::move_scene(scene, at);
        return scene;
    }

    /// Makes the ground with tilted sheets above: planes alone, without corners where surfaces meet.
    static Scene sheets(const glm::dvec3& at) {
        Scene scene;
        const int grey = add_material(scene, "grey", {0.6f, 0.6f, 0.6f});
        add_object(scene, "ground", -1, add_mesh(scene, "ground", make_plane(60, 60), grey));
        const int sheet = add_mesh(scene, "sheet", make_plane(2, 2), grey);
        for (int i = 0; i < 20; ++i)
            add_object(scene, "sheet" + std::to_string(i), -1, sheet,
                       moved(6 * (i % 4) - 9, 1.5, 25 - 10 * (i / 4)) *
                           glm::rotate(glm::dmat4(1), 0.1 * (i % 5), glm::dvec3(1, 0, 0.5)));
        test::move_scene(scene, at);
        return scene;
    }

    static Settings along_the_ground(const glm::dvec3& at, const char* fit, int resolution) {
        Settings s = settings_with({}, {{"light.fit", fit},
                                        "light.azimuth=70",
                                        "light.elevation=55",
                                        "camera.source=manual",
                                        "camera.target_y=0.5",
                                        "camera.target_z=20",
                                        "camera.azimuth=0",
                                        "camera.elevation=12",
                                        "camera.distance=9"});
        s.map.resolution = resolution;
        test::move_camera(s, at);
        return s;
    }

    FloatImage values(const Scene& scene, const Settings& s, const char* overlay) {
        return overlay_values(scene, s, overlay, kPicture);
    }

    /// Returns the median of the numbers in rows of the picture, from the top.
    static double median(const FloatImage& image, int from, int to) {
        std::vector<float> v;
        for (int y = from; y < to; ++y)
            for (int x = 0; x < image.width; ++x)
                if (const float one = image.data[4 * std::size_t(y * image.width + x)]; !std::isnan(one))
                    v.push_back(one);
        std::nth_element(v.begin(), v.begin() + std::ptrdiff_t(v.size() / 2), v.end());
        return v.empty() ? NAN : v[v.size() / 2];
    }

    MeasuredError measure(const Scene& scene, const Settings& s) {
        FrameRequest request = kPicture;
        request.outputs = {.colour = false};
        return measure_error(renderer, scene, s, request, 0, {}, cache);
    }
};

SI_TESTS_ARE(Repeated, WarpedMapsTest);
// Terrain reaches from the camera's feet to distant hills. A uniform map's texels are large in the picture near the
// camera and small far away. A warped map's texels have one size everywhere, and near ones are finer.
TEST_F(WarpedMapsTest, TexelsAreFinerNearTheCameraAndUniformInThePicture) {
    const Scene scene = load_scene("landscape");
    double near[2], far[2];
    const char* fits[] = {"view", "lispsm"};
    for (int i = 0; i < 2; ++i) {
        const Settings s = settings_for(scene, {{"light.fit", fits[i]}, "light.cascades=1", "map.resolution=1024"});
        const FloatImage pixels = values(scene, s, "pixels-per-texel");
        near[i] = median(pixels, 82, 90);
        far[i] = median(pixels, 28, 36);
    }
    RecordProperty("near", std::to_string(near[0]) + " " + std::to_string(near[1]));
    RecordProperty("far", std::to_string(far[0]) + " " + std::to_string(far[1]));
    EXPECT_GT(near[0] / far[0], 8);
    EXPECT_NEAR(std::log2(near[1] / far[1]), 0, 1) << near[1] << " " << far[1];
    EXPECT_LT(near[1], 0.25 * near[0]) << near[0] << " " << near[1];
    EXPECT_GT(far[1], 1.5 * far[0]) << "which is what it costs";
}

SI_TEST_IS(Later, WarpedMapsTest, HasLessErrorThanAUniformMapAndConvergesToTheReference);
TEST_F(WarpedMapsTest, HasLessErrorThanAUniformMapAndConvergesToTheReference) {
    const auto error = [&](const Scene& scene, Settings s) {
        set_all(s, {"filter.kernel=hard", "bias.kind=receiver-plane"});
        s.bias.normal = 0;
        return measure(scene, s).metrics;
    };
    const Scene land = load_scene("landscape"), ground = long_ground({0, 0, 0});
    const auto on_land = [&](const char* fit) {
        return error(land, settings_for(land, {{"light.fit", fit}, "light.cascades=1", "map.resolution=1024"})).mae;
    };
    const double view = on_land("view"), warped = on_land("lispsm");
    EXPECT_LT(warped, 0.65 * view) << view;
    const ErrorMetrics coarse = error(ground, along_the_ground({0, 0, 0}, "lispsm", 256)),
                       fine = error(ground, along_the_ground({0, 0, 0}, "lispsm", 4096));
    EXPECT_LT(fine.mae, 0.15 * coarse.mae) << coarse.mae;
    EXPECT_LT(fine.mae, 5e-4);
    EXPECT_EQ(fine.outside_map, 0);
    RecordProperty("mae", std::to_string(view) + " " + std::to_string(warped) + " " + std::to_string(coarse.mae) + " " +
                              std::to_string(fine.mae));
}

SI_TEST_IS(DriverIndependent, WarpedMapsTest, PerTexelBiasesLeaveNoAcneOnPlanes);
SI_TEST_IS(Product, WarpedMapsTest, PerTexelBiasesLeaveNoAcneOnPlanes);
SI_TEST_IS(Slow, WarpedMapsTest, PerTexelBiasesLeaveNoAcneOnPlanes);
TEST_F(WarpedMapsTest, PerTexelBiasesLeaveNoAcneOnPlanes) {
    struct Angles {
        double azimuth, elevation;
    };
    struct Map {
        const char* format;
        bool reversed;
        const char* near_far;
    };
    for (const auto& [at, angles, kind, kernel, map] :
         test::combinations<glm::dvec3, Angles, const char*, const char*, Map>(
             {glm::dvec3(0), {115, 0, 0}, {1e5, 0, -3e4}}, {{70, 55}, {90, 90}, {180, 12}, {0, 20}},
             {"receiver-plane", "receiver-plane-derivatives", "adaptive"}, {"hard", "pcf5", "tent3"},
             {{"d16", false, "fitted"},
              {"d24", true, "casters"},
              {"d32f", false, "pancaking"},
              {"d32f", true, "scene"}})) {
        const auto& [azimuth, elevation] = angles;
        const auto& [format, reversed, near_far] = map;
        const Scene scene = sheets(at);
        SCOPED_TRACE(testing::Message() << at.x << " " << azimuth << " " << kind << " " << kernel << " " << format
                                        << (reversed ? " reversed " : " ") << near_far);
        Settings s = along_the_ground(at, "lispsm", 512);
        set_setting(s, "bias.kind", kind);
        set_setting(s, "filter.kernel", kernel);
        set_setting(s, "map.format", format);
        set_setting(s, "light.near_far", near_far);
        s.map.reversed_z = reversed;
        s.bias.constant = s.bias.slope = s.bias.normal = 0;
        s.lights[0].azimuth = azimuth;
        s.lights[0].elevation = elevation;
        const ErrorMetrics m = measure(scene, s).metrics;
        EXPECT_GT(m.counted, 2000u);
        EXPECT_EQ(m.artefacts[std::size_t(Artefact::Acne)], 0u);
        EXPECT_EQ(m.outside_map, 0);
    }
}

// Each texel's distance in the viewer and its files equals that of the first surface on its ray, for both depth
// directions. The test compares rays that meet the ground or a box's top, away from edges.
TEST_F(WarpedMapsTest, LinearDepthsAreDistances) {
    const Scene scene = long_ground({0, 0, 0});
    const test::RayReference rays(scene);
    for (const char* format : {"d16", "d24", "d32f", "colour"})
        for (const bool reversed : {false, true})
            for (const char* near_far : {"fitted", "casters", "scene"}) {
                SCOPED_TRACE(testing::Message() << format << (reversed ? " reversed " : " ") << near_far);
                Settings s = along_the_ground({0, 0, 0}, "lispsm", 256);
                set_setting(s, "map.format", format);
                set_setting(s, "light.near_far", near_far);
                s.map.reversed_z = reversed;
                s.view.map = MapView::Linear;
                s.bias.raster_slope = s.bias.raster_units = 0;
                FrameRequest request = kPicture;
                request.outputs = {.colour = false, .shadow_map = true};
                const FrameResult frame = renderer.render(scene, s, request);
                const LightView& view = frame.lights[0].views[0];
                const FloatImage depth = renderer.read_map_view_depth(frame);
                const ByteImage shown = renderer.read_colour(frame.map_view);
                int compared = 0;
                for (int y = 3; y < 256; y += 11)
                    for (int x = 5; x < 256; x += 13) {
                        const glm::dvec2 uv((x + 0.5) / 256, (255 - y + 0.5) / 256);
                        const DepthCurve row = view.curve.curve_at_row(uv.y);
                        const double before = row.near - 50;
                        const glm::dvec3 from = view.position_ws(uv, before);
                        const auto hit = rays.first_hit(from, -view.axes[2]);
                        const double d = depth.at(x, y);
                        if (!hit || hit->normal.y < 0.9 || d == view.curve.convention.far_depth()) continue;
                        const double metres = row.distance(d), step = (row.far - row.near) / 65535;
                        if (std::abs(metres - (before + hit->distance)) > 0.5) continue;  // an edge crosses the texel
                        EXPECT_NEAR(metres, before + hit->distance, 2e-3 + (format == std::string("d16") ? step : 0));
                        const double share = (metres - view.curve.near) / (view.curve.far - view.curve.near);
                        EXPECT_NEAR(shown.data[4 * std::size_t(y * 256 + x)], 255 * std::clamp(share, 0.0, 1.0), 1.5);
                        ++compared;
                    }
                EXPECT_GT(compared, 300);
            }
}

// Radii in metres and penumbrae equal those of a uniform map: compared with the area reference they have no more
// error.
TEST_F(WarpedMapsTest, PenumbraeAreAsWideAsUnderAUniformMap) {
    const Scene scene = long_ground({0, 0, 0});
    // The contrast of dpcf depends on the map's depth range, which differs between fits.
    for (const char* kernel : {"pcss", "smrt", "vogel", "poisson"}) {
        SCOPED_TRACE(kernel);
        const auto drawn = [&](const char* fit) {
            Settings s = along_the_ground({0, 0, 0}, fit, 512);
            set_all(s, {{"filter.kernel", kernel},
                        "bias.kind=receiver-plane",
                        "filter.radius_unit=metres",
                        "filter.radius=0.15",
                        "filter.max_radius=64",
                        "filter.rotate=false",
                        "light.size=6"});
            s.filter.taps = s.filter.blocker_taps = 64;
            s.bias.constant = s.bias.slope = s.bias.normal = 0;
            return visibility(scene, s);
        };
        const FloatImage even = drawn("view"), warped = drawn("lispsm");
        double off = 0, grey_even = 0, grey_warped = 0;
        for (std::size_t i = 0; i < even.data.size(); ++i) {
            const auto grey = [](float v) { return v > 0.05f && v < 0.95f; };
            off += std::abs(even.data[i] - warped.data[i]);
            grey_even += grey(even.data[i]);
            grey_warped += grey(warped.data[i]);
        }
        EXPECT_GT(grey_even, 150);
        EXPECT_NEAR(grey_warped / grey_even, 1, 0.12) << grey_even << " " << grey_warped;
        EXPECT_LT(off / double(even.data.size()), 0.006);
    }
}

// The warp keeps windings, also of mirrored objects: culling drops the same faces as in a uniform map.
TEST_F(WarpedMapsTest, CullingSelectsTheSameFaces) {
    const Scene scene = long_ground({0, 0, 0});
    for (const char* cull : {"none", "back", "front"}) {
        const auto shadow = [&](const char* fit) {
            Settings s = along_the_ground({0, 0, 0}, fit, 2048);
            set_setting(s, "caster.cull", cull);
            return visibility(scene, s, kPicture);
        };
        const FloatImage even = shadow("casters");
        EXPECT_LT(differing_values(even, shadow("lispsm"), 0.5f), even.data.size() / 100) << cull;
    }
}

// Pages of a warped map hold the texels of the whole map.
TEST_F(WarpedMapsTest, PagesHoldTheSameTexels) {
    const Scene scene = long_ground({0, 0, 0});
    Settings s = along_the_ground({0, 0, 0}, "lispsm", 1024);
    const FloatImage whole = visibility(scene, s, kPicture);
    set_all(s, {"map.virtual=true", "map.virtual_levels=1"});
    FrameResult frame;
    const FloatImage paged = visibility(scene, s, kPicture, &frame);
    ASSERT_TRUE(frame.pages);
    ASSERT_TRUE(frame.lights[0].is_warped());
    EXPECT_EQ(paged.data, whole.data);
}

}  // namespace
}  // namespace si
