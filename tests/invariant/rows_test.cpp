// Tests invariants of every kernel under alternating rows of the other tables: a loop over the rows of the filter
// table, with a row that only this binary has. Tolerances are the rows' own.
#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>

#include "renderer/gl/shader_source.h"
#include "renderer/inspect/probe.h"
#include "renderer/scenes/shapes.h"
#include "renderer/settings/biases.h"
#include "renderer/settings/depth_compare.h"
#include "renderer/settings/filters.h"
#include "renderer/settings/fits.h"
#include "renderer/settings/param.h"
#include "renderer/view/lights/kernel_reach.h"
#include "tests/support/box_scene.h"
#include "tests/support/hard_case.h"
#include "tests/support/mesh_scene.h"
#include "tests/support/sets.h"
#include "tests/support/square_kernels.h"
#include "tests/support/traits.h"

namespace si::test {
namespace {

/// Adds a kernel to the built-in table: weights 1 2 1 across the map, by the interface that every kernel uses.
const bool row_added = [] {
    gl::add_shader_text("filters/added_here.glsl", R"(
float filter_visibility(Receiver r) {
    vec2 step_uv = vec2(1.0 / float(map_resolution), 0.0);
    return 0.25 * compares_lit(r, r.uvd_offset.xy - step_uv) + 0.5 * compares_lit(r, r.uvd_offset.xy) +
           0.25 * compares_lit(r, r.uvd_offset.xy + step_uv);
}
)");
    add_filter({.key = "added-here",
                .label = "Added here",
                .help = "A row of the test.",
                .file = "filters/added_here.glsl",
                .reach =
                    [](const Filter&, const Settings&, double) {
                        return Reach{1.5, 1.5, 1.5};
                    },
                .cost =
                    [](const Filter&, const Settings&) {
                        return FilterCost{0, 3, 3};
                    }});
    return true;
}();

struct Case {
    std::string kernel;
    LightType light;
    MapFormat format;
    bool reversed;
    std::string bias, fit;  ///< keys of their tables
    Place place;
};

std::string name_of(const testing::TestParamInfo<Case>& info) {
    return identifier(info.param.kernel + "_" + light_name(info.param.light) + "_" + format_name(info.param.format) +
                      (info.param.reversed ? "_reversed" : ""));
}

/// Returns each kernel under each light, with alternating formats, depth directions, kinds of bias, fits and
/// positions.
std::vector<Case> all_cases() {
    std::vector<Case> out;
    std::size_t turn = 0;
    for (const Filter& row : filters()) {
        for (const LightType light : kLightTypes) {
            // prevents a light from meeting one row only
            const std::size_t shifted = turn + turn / std::size(kLightTypes);
            out.push_back({std::string(row.key), light, turn % 2 ? MapFormat::D16 : MapFormat::D32F, turn % 4 >= 2,
                           std::string(bias_choices()[shifted % bias_choices().size()].key),
                           std::string(fits()[shifted % fits().size()].key), kPlaces[shifted % std::size(kPlaces)]});
            ++turn;
        }
    }
    return out;
}

/// Sets the bias along the light that the row states for a plane at any angle up to the steepest: a texel's height on
/// the plane is its width times the angle's tangent.
void give_bias(Settings& s, const FittedLight& light, double steepest_tan) {
    const int kind = s.bias.kind;
    s.bias = no_bias();
    s.bias.kind = kind;
    s.bias.unit = BiasUnit::Texels;
    // Both axes of the map may rise; the sub-pixel grid's share and the depth's step come on top.
    const double kappa = std::max(kernel_reach_in_light(s, light, s.map.resolution).bias, 0.5) + 0.1;
    s.bias.constant = kappa * glm::root_two<double>() * steepest_tan + 1;
}

Settings settings_of(const Case& c, int resolution) {
    Settings s = hard_settings();
    s.lights[0].type = c.light;
    s.lights[0].distance = c.light == LightType::Directional ? 0 : 9;
    s.lights[0].cone = 80;
    s.lights[0].size = c.light == LightType::Directional ? 0.5 : 0.05;
    s.map.resolution = resolution;
    s.map.format = c.format;
    s.map.reversed_z = c.reversed;
    set_setting(s, "filter.kernel", c.kernel);
    set_setting(s, "bias.kind", c.bias);
    set_setting(s, "light.fit", c.fit);
    s.lights[0].azimuth = c.place.azimuth;
    move_camera(s, c.place.at);
    return s;
}

Scene there(const Case& c, Scene scene) {
    move_scene(scene, c.place.at);
    return scene;
}

FittedLight fitted(const Scene& scene, const Settings& s) {
    const FrameRequest request{.width = 16, .height = 16};
    return hard_renderer().render(scene, s, request).lights.at(0);
}

class EachKernel : public testing::TestWithParam<Case> {
protected:
    const Case& c = GetParam();
    const Filter& row = filters()[std::size_t(kernel_row(c.kernel))];
};

/// Visits each pixel's reference and visibility. Boundary pixels have an edge within the given number of texels.
template <class Visit>
void for_pixels(const Shot& shot, const Scene& scene, double reach_texels, Visit visit) {
    const ReferenceImage reference = trace_reference(RayReference(scene), shot, reach_texels);
    for (int y = 0; y < shot.height; ++y)
        for (int x = 0; x < shot.width; ++x) visit(reference.state_at(x, y), double(shot.visibility.at(x, y)));
}

TEST_P(EachKernel, PlanesAreLitAndCoveredFloorsAreDark) {
    const Scene scene = floor_under_sheet(c.place);
    Settings s = settings_of(c, 256);
    s.lights[0].elevation = 60;
    give_bias(s, fitted(scene, s), 2.5);  // a point light's faces see the floor at up to 68 degrees there
    const Shot shot = draw_shot(scene, s);
    const double reach = kernel_reach_in_light(s, shot.light(), shot.frame.map_resolution).edge + 1;
    int lit = 0, dark = 0, darkened = 0;
    double most = 0;
    for_pixels(shot, scene, reach, [&](ReferenceState reference, double v) {
        if (reference == ReferenceState::Lit) {
            ++lit;
            darkened += v < 1 - row.tolerance.lit;
        }
        if (reference == ReferenceState::Shadow) {
            ++dark;
            most = std::max(most, v);
        }
    });
    EXPECT_GT(lit, 2000);
    EXPECT_GT(dark, 100);
    // Four moments round by themselves, which a bias of exactly the depths' need leaves no room for.
    const bool rounds = row.samples() == Samples::Moments && c.bias == "adaptive";
    EXPECT_LE(darkened, rounds ? lit / 2000 : 0) << row.tolerance.why;
    EXPECT_LE(most, row.tolerance.dark) << row.tolerance.why;
}

/// Point lights are left out: their faces meet a plane at every angle.
class EachKernelOfOneMap : public EachKernel {};

std::vector<Case> cases_of_one_map() {
    std::vector<Case> out = all_cases();
    std::erase_if(out, [](const Case& c) { return c.light == LightType::Point; });
    return out;
}

TEST_P(EachKernelOfOneMap, AGrazingPlaneStaysLit) {
    Scene scene = make_scene(make_plane(6, 6));
    move_scene(scene, c.place.at);
    Settings s = settings_with(settings_of(c, 256), {"light.elevation=20", "light.cone=40"});
    give_bias(s, fitted(scene, s), std::tan(glm::radians(c.light == LightType::Spot ? 84.0 : 70.0)));
    int lit = 0;
    double least = 1;
    const Shot shot = draw_shot(scene, s);
    const ReferenceImage reference = trace_reference(RayReference(scene), shot, 0);
    for (std::size_t i = 0; i < reference.states.size(); ++i) {
        if (reference.states[i] != ReferenceState::Lit) continue;
        // Moments over the floor's rim mix two surfaces, the floor and empty space: they bound, but do not clear.
        const glm::dvec3 at = reference.hits[i]->position - c.place.at;
        if (row.samples() == Samples::Moments && std::max(std::abs(at.x), std::abs(at.z)) > 2.2) continue;
        ++lit;
        least = std::min(least, double(shot.visibility.data[i]));
    }
    EXPECT_GT(lit, 1000);
    EXPECT_GE(least, 1 - row.tolerance.lit) << row.tolerance.why;
}

SI_TEST_IS(Later, EachKernel, FinerMapsAreCloserToTheReference);
TEST_P(EachKernel, FinerMapsAreCloserToTheReference) {
    const Scene scene = there(c, floor_and_box(8, {1.5, 1, 2}, 0.4));
    const auto error = [&](int resolution) {
        Settings s = settings_of(c, resolution);
        s.lights[0].size *= 0.1;  // keeps the penumbra's width
        give_bias(s, fitted(scene, s), 1.5);
        double sum = 0;
        for_pixels(draw_shot(scene, s), scene, 0, [&](ReferenceState reference, double v) {
            if (reference == ReferenceState::Lit || reference == ReferenceState::Shadow)
                sum += std::abs(v - (reference == ReferenceState::Lit ? 1 : 0));
        });
        return sum;
    };
    const double coarse = error(128), fine = error(512);
    EXPECT_GT(coarse, 0);
    EXPECT_LT(fine, 0.6 * coarse);
}

SI_TEST_IS(Later, EachKernel, WeightedTapsEqualTheVisibilityOnTheGpu);
TEST_P(EachKernel, WeightedTapsEqualTheVisibilityOnTheGpu) {
    const Scene scene = there(c, floor_and_box(8, {1.5, 1, 2}, 0.4));
    Settings s = settings_of(c, 64);
    // One texel: the bias that clears every plane can exceed the box's height under a wide kernel.
    give_bias(s, fitted(scene, s), 0);
    const FrameRequest picture{.width = 160, .height = 120};
    int told = 0, partly = 0;
    for (int y = 22; y < 110 && (partly < 3 || told < 12); y += 7)
        for (int x = 33; x < 140; x += 9) {
            const Probe p = hard_renderer().probe(scene, s, picture, x, y);
            if (!p.hit || p.lights[0].place != MapPlace::Inside || p.lights[0].account.receiver.n_dot_l <= 1e-3)
                continue;
            const Probe::PerLight& l = p.lights[0];
            if (!row.linear) {
                ASSERT_TRUE(l.taps.empty()) << "its result is no sum of comparisons";
                return;
            }
            if (l.taps.empty()) {
                EXPECT_TRUE(row.searches_blockers);
                EXPECT_EQ(l.visibility, 1) << "compared nothing";
                continue;
            }
            double sum = 0, weights = 0;
            for (const KernelTap& t : l.taps) {
                sum += t.lit ? t.weight : 0;
                weights += t.weight;
                const glm::dvec2 off =
                    glm::abs(glm::dvec2(t.texel) + 0.5 - glm::dvec2(l.account.receiver.tap) * double(p.map_resolution));
                EXPECT_LE(std::max(off.x, off.y), kernel_reach_in_light(s, l.fitted, p.map_resolution).read + 1e-3);
            }
            ++told;
            EXPECT_NEAR(weights, 1, 1e-5);
            EXPECT_NEAR(sum, l.visibility, 2e-5) << x << "," << y;
            partly += l.visibility > 0.01 && l.visibility < 0.99;
        }
    EXPECT_GT(told, 0);
    if (kernel_reach_in_light(s, fitted(scene, s), s.map.resolution).read > 0.5) {
        EXPECT_GT(partly, 0) << "no pixel at an edge, so this proves little";
    }
}

INSTANTIATE_TEST_SUITE_P(All, EachKernel, testing::ValuesIn(all_cases()), name_of);
INSTANTIATE_TEST_SUITE_P(All, EachKernelOfOneMap, testing::ValuesIn(cases_of_one_map()), name_of);

/// Makes a floor, and 1 m above it a cover over the half where x is below 0.
Scene half_covered_floor() {
    return grey_scene({{"floor", make_plane(8, 8)}, {"cover", make_plane(4, 8), moved(-2, 1, 0)}});
}

Settings overhead(std::string_view kernel) {
    Settings s = settings_with(texel_settings(kernel, 64, 0.2),
                               {"light.elevation=90", "light.azimuth=0", "camera.elevation=30"});
    s.camera.azimuth = 90;  // sees below the cover
    s.camera.distance = 6;
    return s;
}

/// Floor pixel near the shadow's edge. Columns of the map are counted towards the lit side.
struct EdgePixel {
    int x = 0, y = 0;       ///< position in the picture
    int axis = 0;           ///< axis of the map across the edge
    bool grows = true;      ///< direction: columns count as the map counts them; otherwise from its other side
    int resolution = 0;     ///< texels per side of the map
    double place = 0;       ///< centre of the kernel, in columns
    double first = 0;       ///< the first lit column, from the geometry
    double visibility = 0;  ///< visibility in the picture

    /// Returns the column of a texel of the map.
    int column(const glm::ivec2& texel) const { return grows ? texel[axis] : resolution - 1 - texel[axis]; }
};

/// Returns the floor pixels near the middle of the scene.
std::vector<EdgePixel> pixels_at_edge(const Shot& shot, const Scene& scene) {
    std::vector<EdgePixel> out;
    const LightView& view = shot.view();
    const RayReference rays(scene);
    const int n = shot.frame.map_resolution;
    const int axis = std::abs(view.axes[0].x) > 0.5 ? 0 : 1;
    const bool grows = view.axes[axis].x > 0;
    const double edge = uvdw(view, {0, 0, 0})[axis] * n;
    for (const auto& [x, y, hit] : pixel_hits(rays, shot)) {
        if (hit.position.y > 1e-6 || std::abs(hit.position.x) > 1.5 || std::abs(hit.position.z) > 1.5) continue;
        const double place = uvdw(view, hit.position)[axis] * n;
        const EdgePixel p{x,
                          y,
                          axis,
                          grows,
                          n,
                          grows ? place : n - place,
                          std::ceil((grows ? edge : n - edge) - 0.5),
                          shot.visibility.at(x, y)};
        const double fraction = p.place - std::floor(p.place);
        if (std::min(fraction, 1 - fraction) < 1e-3) continue;
        out.push_back(p);
    }
    return out;
}

/// Returns the share of a box of `across` columns about the kernel's centre that the lit columns cover.
double box_profile(const EdgePixel& p, int across) {
    const double off = p.first - p.place;
    return std::clamp(0.5 - off / across, 0.0, 1.0);
}

class EachSquareKernel : public testing::TestWithParam<SizedKernel> {};

// The weights are those that the GPU recorded, column by column. The lit columns follow from the geometry.
TEST_P(EachSquareKernel, BlursAnEdgeByItsTapWeights) {
    const SizedKernel& k = GetParam();
    const Scene scene = half_covered_floor();
    Settings s = overhead(k.key);
    s.filter.size = k.size;
    s.filter.point = k.point;
    constexpr int kWidth = 240, kHeight = 180;
    std::vector<EdgePixel> pixels = pixels_at_edge(draw_shot(scene, s, kWidth, kHeight), scene);
    // Taps of single texels jump where the look-up crosses a texel's middle, if their number is even.
    if (k.point)
        std::erase_if(pixels, [](const EdgePixel& p) { return std::abs(p.place - std::floor(p.place) - 0.5) < 1e-3; });
    std::ranges::sort(pixels, {}, &EdgePixel::place);
    const double reach = reach_of(s).edge;
    std::vector<EdgePixel> near;
    double last = 0;
    int falling = 0, wrong_beyond = 0;
    for (const EdgePixel& p : pixels) {
        const double off = p.first - p.place;
        if (std::abs(off) <= reach) near.push_back(p);
        if (std::abs(off) > reach + 0.5) wrong_beyond += std::abs(p.visibility - (off < 0 ? 1 : 0)) > 1e-5;
        falling += p.visibility < last - 2e-3;
        last = p.visibility;
    }
    EXPECT_EQ(wrong_beyond, 0) << "pixels beyond the reach of the row";
    EXPECT_EQ(falling, 0) << "brighter towards the lit side, so that the pixels between those below are right too";
    ASSERT_GT(near.size(), 50u);
    constexpr std::size_t kProbes = 40;
    int partly = 0;
    for (std::size_t i = 0; i < kProbes; ++i) {
        const EdgePixel& p = near[i * near.size() / kProbes];
        const Probe probe = hard_renderer().probe(scene, s, {.width = kWidth, .height = kHeight}, p.x, p.y);
        ASSERT_TRUE(probe.hit);
        double lit = 0, all = 0;
        for (const KernelTap& tap : probe.lights[0].taps) {
            all += tap.weight;
            if (p.column(tap.texel) >= p.first) lit += tap.weight;
        }
        EXPECT_NEAR(all, 1, 1e-5);
        EXPECT_NEAR(p.visibility, lit, 2e-3) << "centred at column " << p.place << ", lit from " << p.first;
        partly += lit > 0.01 && lit < 0.99;
    }
    if (reach > 0.5) {
        EXPECT_GT(partly, 5);
    }
}

INSTANTIATE_TEST_SUITE_P(All, EachSquareKernel, testing::ValuesIn(square_kernels({3, 4, 5})),
                         [](const auto& row) { return test_name(row.param); });

// With two depths Chebyshev's inequality is exact: the share of lit texels, equal to percentage-closer filtering over
// the same texels.
TEST(Vsm, OfTwoPlanesEqualsTheLitShare) {
    const Scene scene = half_covered_floor();
    for (const int blur : {0, 1, 2}) {
        Settings s = overhead("vsm");
        s.bias.constant = 0.01;
        s.filter.blur = blur;
        set_all(s, {"filter.bleed=0", "filter.min_variance=0"});
        int partly = 0;
        double worst = 0;
        for (const EdgePixel& p : pixels_at_edge(draw_shot(scene, s, 320, 240), scene)) {
            const double expected = box_profile(p, 2 * blur + 1);
            worst = std::max(worst, std::abs(p.visibility - expected));
            partly += expected > 0.01 && expected < 0.99;
        }
        EXPECT_LT(worst, 5e-3) << blur;
        EXPECT_GT(partly, 100);
    }
}

TEST(Vsm, LightBleedReductionCutsAShareAndRescalesTheRest) {
    const Scene scene = half_covered_floor();
    Settings s = settings_with(overhead("vsm"),
                               {"bias.constant=0.01", "filter.blur=1", "filter.bleed=0.3", "filter.min_variance=0"});
    double worst = 0;
    for (const EdgePixel& p : pixels_at_edge(draw_shot(scene, s, 320, 240), scene)) {
        const double share = box_profile(p, 3);
        const double expected = share >= 1 ? 1 : std::max(0.0, (share - 0.3) / 0.7);
        worst = std::max(worst, std::abs(p.visibility - expected));
    }
    EXPECT_LT(worst, 1e-2);
}

TEST(Vsm, MomentsAreDrawnWithTheMapAndOnlyWhenNeeded) {
    const Scene scene = half_covered_floor();
    Settings s = overhead("pcf3");
    Renderer& renderer = hard_renderer();
    FrameRequest request{.width = 64, .height = 48};
    request.outputs.shadow_map = true;  // whole map: kernels that reach farther need more of it
    const FrameResult off = renderer.render(scene, s, request);
    ASSERT_NE(off.pass("moments"), nullptr);
    EXPECT_EQ(off.pass("moments")->state, PassState::Skipped);
    set_setting(s, "filter.kernel", "vsm");
    const FrameResult on = renderer.render(scene, s, request);
    EXPECT_EQ(on.pass("moments")->state, PassState::Drawn);
    EXPECT_EQ(on.pass("moments")->category, PassCategory::Maps);
    EXPECT_EQ(on.pass("shadow map 0 (directional)")->state, PassState::Cached) << "a kernel is no reason to draw again";
    s.filter.bleed = 0.4;
    EXPECT_EQ(renderer.render(scene, s, request).pass("moments")->state, PassState::Cached);
    s.filter.blur = 4;
    EXPECT_EQ(renderer.render(scene, s, request).pass("moments")->state, PassState::Drawn);
    s.filter.radius = 7;  // setting of another kernel: no effect here
    const FrameResult idle = renderer.render(scene, s, request);
    for (const PassInfo& pass : idle.passes) EXPECT_NE(pass.state, PassState::Drawn) << pass.name;
}

struct SizedLight {
    LightType type;
    double size, penumbra_m;  ///< light.size; width of the penumbra of an edge 1 m above the floor, in closed form
};

class PenumbraKernels : public testing::TestWithParam<const char*> {};

// Kernels with a blocker search report the distance of an edge 1 m above a floor that faces the light, by the
// intercept theorem.
TEST_P(PenumbraKernels, PenumbraWidthsFollowSimilarTriangles) {
    const Scene scene = half_covered_floor();
    const double place_m = 5;
    // The light's target is the centre of the scene's bounds, half a metre above the floor.
    const double height_m = place_m + 0.5;
    const SizedLight lights[] = {{LightType::Directional, 4, 2 * std::tan(glm::radians(4.0))},
                                 {LightType::Spot, 0.3, 2 * 0.3 / (height_m - 1)},
                                 {LightType::Point, 0.3, 2 * 0.3 / (height_m - 1)}};
    for (const SizedLight& light : lights) {
        Settings s = settings_with(overhead(GetParam()), {"map.resolution=1024", "bias.constant=1"});
        s.lights[0].type = light.type;
        s.lights[0].size = light.size;
        s.lights[0].distance = light.type == LightType::Directional ? 0 : place_m;
        set_all(s, {"light.cone=80", "filter.max_radius=64", "filter.rays=32", "filter.steps=16", "camera.distance=3"});
        FrameRequest request{.width = 320, .height = 240, .outputs = {.colour = false, .overlay = true}};
        const auto values = [&](std::string_view overlay) {
            set_setting(s, "view.overlay", overlay);
            return hard_renderer().read_float(hard_renderer().render(scene, s, request).overlay, 4);
        };
        const FloatImage gap = values("blocker-gap"), width = values("penumbra-width"), taps = values("taps");
        const FrameResult frame = hard_renderer().render(scene, s, request);
        const RayReference rays(scene);
        int found = 0;
        for (const auto& [x, y, hit] : pixel_hits(rays, frame.camera, request.width, request.height)) {
            // In the middle of the penumbra the search meets the cover with all its samples.
            if (hit.position.y > 1e-6 || std::abs(hit.position.x) > 0.1 * light.penumbra_m ||
                std::abs(hit.position.z) > 1)
                continue;
            const float gap_m = gap.at(x, y, 0), texels = width.at(x, y, 0);
            if (std::isnan(gap_m)) continue;
            ++found;
            // A stopped ray takes no more of its steps.
            const int most = kernel_cost(s).texels;
            ASSERT_LE(taps.at(x, y, 0), most);
            ASSERT_GE(taps.at(x, y, 0), s.filter.kernel == kernel_row("smrt") ? most / 4 : most);
            const LightView& view = view_of(frame.lights[0], hit.position);
            const double texel_m =
                view.texel_size(glm::dot(view.eye - hit.position, view.axes[2]), frame.map_resolution);
            ASSERT_NEAR(gap_m, 1, 0.03) << x << "," << y;
            ASSERT_NEAR(texels * texel_m, light.penumbra_m, 0.05 * light.penumbra_m) << int(light.type);
        }
        EXPECT_GT(found, 20) << int(light.type);
    }
}

INSTANTIATE_TEST_SUITE_P(Each, PenumbraKernels, testing::Values("pcss", "dpcf", "smrt"));

}  // namespace
}  // namespace si::test
