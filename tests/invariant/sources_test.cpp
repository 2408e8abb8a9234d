// Tests invariants of every source of visibility: a loop over the rows of the source table under every light, against
// the closed form of a plane below half a cover.
#include "renderer/settings/sources.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "renderer/scenes/shapes.h"
#include "renderer/settings/biases.h"
#include "renderer/settings/filters.h"
#include "renderer/settings/fits.h"
#include "renderer/settings/param.h"
#include "renderer/view/lights/kernel_reach.h"
#include "tests/support/box_scene.h"
#include "tests/support/combinations.h"
#include "tests/support/hard_case.h"
#include "tests/support/traits.h"

namespace si::test {
namespace {

struct SourceCase {
    std::string source;
    LightType light;
    Place place;
};

std::vector<SourceCase> source_cases(bool maps_too = true) {
    std::vector<SourceCase> out;
    for (const Source& row : sources())
        if (maps_too || !row.needs.map)
            for (const LightType light : kLightTypes)
                for (const Place& place : kPlaces) out.push_back({std::string(row.key), light, place});
    return out;
}

std::string source_name(const testing::TestParamInfo<SourceCase>& info) {
    return identifier(info.param.source + "_" + light_name(info.param.light) + "_" +
                      std::to_string(info.index % std::size(kPlaces)));
}

constexpr double kCoverY = 1.5, kCoverHalf = 1.5;

class EachSource : public testing::TestWithParam<SourceCase> {
protected:
    const SourceCase& c = GetParam();
    const Source& row = *std::ranges::find(sources(), c.source, &Source::key);

    Settings settings() const {
        Settings s = texel_settings("hw2x2", 512, 4);
        set_setting(s, "light.source", c.source);
        place_light(s, c.light, c.place);
        s.camera.elevation = 22;
        s.camera.distance = 11;  // sees below the cover
        return s;
    }
    /// Makes a floor of 12 m, and a cover of 3 x 3 m in the half where x is below 0.
    Scene scene(bool covered) const {
        std::vector<GreyPart> parts{{"floor", make_plane(12, 12)}};
        if (covered)
            parts.push_back({"cover", make_plane(2 * kCoverHalf, 2 * kCoverHalf), moved(-kCoverHalf, kCoverY, 0)});
        Scene scene = grey_scene(std::move(parts));
        move_scene(scene, c.place.at);
        return scene;
    }
    /// Returns the distance by which the light ray of a floor point passes within the cover's edges, metres; negative
    /// outside them.
    double within_cover_m(const FittedLight& light, const glm::dvec3& point_ws) const {
        const glm::dvec3 ray = light.type == LightType::Directional ? light.to_light : light.position - point_ws;
        const glm::dvec3 at = point_ws + ray * (kCoverY / ray.y) - c.place.at;
        return std::min({-at.x, at.x + 2 * kCoverHalf, kCoverHalf - std::abs(at.z)});
    }
    template <class Visit>
    void each_floor_pixel(const Shot& shot, const Scene& scene, Visit visit) const {
        const RayReference rays(scene);
        for (const auto& [x, y, hit] : pixel_hits(rays, shot)) {
            if (std::abs(hit.position.y - c.place.at.y) > 1e-3) continue;
            visit(hit.position, double(shot.visibility.at(x, y)));
        }
    }
};

TEST_P(EachSource, LightsAPlaneAndDarkensCoveredFloors) {
    if (!row.approximation.empty()) return;  // tested by a closed form of its own
    const Scene half = scene(true);
    const Shot shot = draw_shot(half, settings());
    // Sources with a map may miss an edge by a texel; others by the rounding of a position.
    double slack_m = 2e-3;
    // Four different texels are mixed by a look-up: the error is their diagonal, larger across a near light's rays.
    for (const LightMapNeed& map : shot.frame.light_maps) slack_m += std::numbers::sqrt2 / map.texels_per_metre;
    if (row.needs.map) {
        const FittedLight& light = shot.light();
        const double kernel = kernel_reach_in_light(settings(), light, shot.frame.map_resolution).edge + 1;
        for (const LightView& view : light.views)
            slack_m = std::max(slack_m, kernel * view.texel_size(view.curve.perspective ? view.curve.far : 1, 512));
    }
    int lit = 0, dark = 0, wrong = 0;
    each_floor_pixel(shot, half, [&](const glm::dvec3& at, double v) {
        const double within_m = within_cover_m(shot.light(), at);
        if (std::abs(within_m) < slack_m) return;
        const bool shadow = within_m > 0 && c.source != "none";
        (shadow ? dark : lit) += 1;
        wrong += shadow ? v != 0 : std::abs(v - 1) > 1e-6;
    });
    EXPECT_EQ(wrong, 0) << "of " << lit << " lit and " << dark << " dark pixels, " << slack_m << " m from the edge";
    EXPECT_GT(lit, 3000);
    EXPECT_EQ(dark > 200, c.source != "none") << dark;
}

TEST_P(EachSource, LightsALonePlane) {
    const Scene floor = scene(false);
    each_floor_pixel(draw_shot(floor, settings(), 80, 60), floor,
                     [&](const glm::dvec3&, double v) { ASSERT_NEAR(v, 1, 1e-6); });
}

// Settings of maps have no effect on sources without a map.
class EachSourceWithoutAMap : public EachSource {};

SI_TESTS_ARE(DriverIndependent, EachSourceWithoutAMap);
SI_TESTS_ARE(Product, EachSourceWithoutAMap);
TEST_P(EachSourceWithoutAMap, IsIndependentOfKernelBiasAndFit) {
    const Scene half = scene(true);
    const FloatImage plain = draw_shot(half, settings(), 80, 60).visibility;
    const auto expect_same = [&](std::string_view key, std::string_view value) {
        Settings s = settings();
        set_setting(s, key, value);
        EXPECT_EQ(draw_shot(half, s, 80, 60).visibility.data, plain.data) << key << " " << value;
    };
    for (const Filter& other : portion(std::vector<Filter>(filters().begin(), filters().end()), 4))
        expect_same("filter.kernel", other.key);
    for (const Choice& other : bias_choices()) expect_same("bias.kind", other.key);
    for (const FitRow& other : fits()) expect_same("light.fit", other.key);
}

INSTANTIATE_TEST_SUITE_P(All, EachSource, testing::ValuesIn(source_cases()), source_name);
INSTANTIATE_TEST_SUITE_P(All, EachSourceWithoutAMap, testing::ValuesIn(source_cases(false)), source_name);

}  // namespace
}  // namespace si::test
