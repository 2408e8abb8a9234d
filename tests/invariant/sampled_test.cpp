// Tests kernels that sample: penumbra widths match the light, and noise falls towards each kernel's limit as its row
// states.
#include <algorithm>
#include <cmath>
#include <map>

#include "renderer/scenes/shapes.h"
#include "renderer/settings/filters.h"
#include "renderer/settings/param.h"
#include "renderer/view/lights/kernel_reach.h"
#include "tests/support/box_scene.h"
#include "tests/support/hard_case.h"
#include "tests/support/sets.h"
#include "tests/support/traits.h"

namespace si::test {
namespace {

const glm::dvec3 kThere = {40, 3, -70};

/// Makes a floor and, 1 m above it, a cover over the half where x is below 0. Far from both a brick of 3 m allows
/// higher casters. The scene stands off the origin.
Scene covered_floor_and_a_brick() {
    Scene scene = grey_scene({{"floor", make_plane(8, 8)},
                              {"cover", make_plane(4, 8), moved(-2, 1, 0)},
                              {"brick", make_box({0.2, 0.2, 0.2}), moved(3.8, 3, 3.8)}});
    move_scene(scene, kThere);
    return scene;
}

/// Returns settings with a light straight above.
Settings soft_settings(std::string_view kernel, LightType type) {
    Settings s = texel_settings(kernel, 1024, 1);
    s.lights[0].type = type;
    s.lights[0].size = type == LightType::Directional ? 4 : 0.3;
    s.lights[0].distance = type == LightType::Directional ? 0 : 5;
    set_all(s,
            {"light.cone=80", "light.elevation=90", "light.azimuth=0", "filter.max_radius=64", "camera.elevation=40"});
    s.camera.azimuth = 90;  // sees below the cover
    s.camera.target_x = s.camera.target_y = s.camera.target_z = 0;
    s.camera.distance = 1.2;
    move_camera(s, kThere);
    return s;
}

/// Visits the floor's pixels: (metres across the edge, visibility).
template <class Visit>
void across_the_edge(const Shot& shot, Visit visit) {
    for (const auto& [x, y, origin, dir] : pixel_rays(shot)) {
        const glm::dvec3 at = origin + dir * ((kThere.y - origin.y) / dir.y) - kThere;
        if (dir.y < 0 && std::abs(at.x) < 1 && std::abs(at.z) < 1) visit(at.x, double(shot.visibility.at(x, y)));
    }
}

/// Returns the place where mean visibility, over narrow stripes along the edge, first exceeds a share.
double crossing(const std::map<int, std::pair<double, int>>& stripes, double stripe_m, double share) {
    double before = 0, place = 0;
    for (const auto& [i, sum] : stripes) {
        const double mean = sum.first / sum.second, at = (i + 0.5) * stripe_m;
        if (mean > share) return mean > before ? place + (at - place) * (share - before) / (mean - before) : at;
        before = mean;
        place = at;
    }
    ADD_FAILURE() << "visibility stays below " << share;
    return 0;
}

SI_TEST_IS(Later, SoftKernels, PenumbraWidthsMatchTheLightsSize);
TEST(SoftKernels, PenumbraWidthsMatchTheLightsSize) {
    const Scene scene = covered_floor_and_a_brick();
    const std::pair<const char*, Sets> kernels[] = {
        {"pcss", {"filter.taps=64", "filter.blocker_taps=64"}},
        {"pcss", {"filter.disk=spiral", "filter.taps=200", "filter.blocker_taps=200"}},
        {"dpcf", {"filter.disk=spiral", "filter.taps=400"}},
        {"smrt", {"filter.rays=64", "filter.steps=32"}}};
    for (const auto& [kernel, changes] : kernels)
        for (const LightType type : kLightTypes)
            for (const bool reversed : {false, true}) {
                if (reversed && type != LightType::Spot) continue;
                Settings s = soft_settings(kernel, type);
                s.map.reversed_z = reversed;
                set_all(s, changes);
                SCOPED_TRACE(std::string(kernel) + " " + changes.front().second + " light " +
                             std::to_string(int(type)));
                const Shot shot = draw_shot(scene, s, 240, 120);
                const FittedLight& light = shot.light();
                const double above_m = light.position.y - kThere.y;
                const double width_m = type == LightType::Directional ? 2 * std::tan(glm::radians(s.lights[0].size))
                                                                      : 2 * s.lights[0].size / (above_m - 1);
                const double stripe_m = 0.04 * width_m;
                std::map<int, std::pair<double, int>> stripes;
                across_the_edge(shot, [&](double x, double v) {
                    auto& [sum, count] = stripes[int(std::floor(x / stripe_m))];
                    sum += v;
                    ++count;
                });
                ASSERT_GT(stripes.size(), 40u);
                // A tenth of a disk of light is visible at 0.687 of the way from the middle.
                const double found_m = (crossing(stripes, stripe_m, 0.9) - crossing(stripes, stripe_m, 0.1)) / 0.687;
                EXPECT_NEAR(found_m, width_m, 0.2 * width_m);
                EXPECT_NEAR(crossing(stripes, stripe_m, 0.5), 0, 0.1 * width_m);
            }
}

// A radius in metres has one width on the ground for every resolution and every texel size of a perspective map; the
// reach reports it.
SI_TEST_IS(Later, SampledKernels, ARadiusInMetresHoldsUnderEveryLight);
TEST(SampledKernels, ARadiusInMetresHoldsUnderEveryLight) {
    const Scene scene = covered_floor_and_a_brick();
    for (const LightType type : kLightTypes)
        for (const int resolution : {512, 1024}) {
            SCOPED_TRACE(std::to_string(int(type)) + " " + std::to_string(resolution));
            Settings s = soft_settings("vogel", type);
            s.map.resolution = resolution;
            set_all(s, {"filter.taps=256", "filter.radius_unit=metres", "filter.radius=0.08"});
            const Shot shot = draw_shot(scene, s, 240, 120);
            std::map<int, std::pair<double, int>> stripes;
            const double stripe_m = 0.006;
            across_the_edge(shot, [&](double x, double v) {
                auto& [sum, count] = stripes[int(std::floor(x / stripe_m))];
                sum += v;
                ++count;
            });
            // The disk lies about the receiver: its shadowed part is a tenth 0.687 radii from the edge.
            const double found_m = (crossing(stripes, stripe_m, 0.9) - crossing(stripes, stripe_m, 0.1)) / 0.687;
            EXPECT_NEAR(found_m, 0.16, 0.1 * 0.16);
            const double texel_m = shot.view().texel_size(
                type == LightType::Directional ? 1 : shot.light().position.y - kThere.y, shot.frame.map_resolution);
            const Reach reach = kernel_reach_in_light(s, shot.light(), shot.frame.map_resolution);
            EXPECT_GE(reach.read, 0.08 / texel_m + 0.5 - 1e-6);
            EXPECT_LE(reach.read, s.filter.max_radius + 0.5);
            s.filter.max_radius = 2;
            EXPECT_NEAR(kernel_reach_in_light(s, shot.light(), shot.frame.map_resolution).read, 2.5, 1e-9)
                << "no more than that";
        }
}

TEST(SampledKernels, ReportWhereTheirTableEnds) {
    const Scene scene = covered_floor_and_a_brick();
    const auto notes = [&](std::string_view kernel, const char* disk) {
        Settings s =
            settings_with(soft_settings(kernel, LightType::Directional), {"map.resolution=64", "filter.taps=100"});
        set_setting(s, "filter.disk", disk);
        std::string all;
        for (const std::string& note : hard_renderer().render(scene, s, {.width = 8, .height = 8}).notes) all += note;
        return all;
    };
    EXPECT_NE(notes("poisson", "spiral").find("filter.taps 100: the Poisson table has 64"), std::string::npos);
    EXPECT_NE(notes("pcss", "table").find("filter.taps 100"), std::string::npos);
    EXPECT_EQ(notes("pcss", "spiral").find("Poisson"), std::string::npos);
    EXPECT_EQ(notes("vogel", "table").find("Poisson"), std::string::npos);
    EXPECT_EQ(notes("hard", "table").find("Poisson"), std::string::npos);
}

// Each kernel is compared with its own limit, 4096 samples.
SI_TEST_IS(Later, SampledKernels, NoiseFallsWithTheSlopeOfTheirRows);
TEST(SampledKernels, NoiseFallsWithTheSlopeOfTheirRows) {
    const Scene scene = covered_floor_and_a_brick();
    int rows = 0;
    for (const Filter& row : filters()) {
        if (row.noise.taps.empty()) continue;
        ++rows;
        SCOPED_TRACE(row.key);
        const auto picture = [&](std::string_view kernel, int places, bool turned = true) {
            Settings s = settings_with(soft_settings(kernel, LightType::Directional),
                                       {"map.resolution=2048", "filter.radius=16", "filter.disk=spiral"});
            set_setting(s, row.noise.taps, std::to_string(places));
            s.filter.blocker_taps = places;
            s.filter.rotate = turned;
            s.camera.distance = 0.45;
            return draw_shot(scene, s, 64, 36).visibility.data;
        };
        // A table that ends early approaches the endless spiral over the same disk.
        const bool ends = row.uses_disk_table && std::ranges::find(row.settings, "filter.disk") == row.settings.end();
        const std::vector<float> limit = picture(ends ? "vogel" : row.key, 4096);
        const std::vector<float> unturned = picture(ends ? "vogel" : row.key, 4096, false);
        double turn = 0;
        for (std::size_t i = 0; i < limit.size(); ++i) turn = std::max(turn, double(std::abs(limit[i] - unturned[i])));
        EXPECT_LT(turn, 0.03) << "the limit is the whole disk's, however each pixel turns it";
        double n = 0, sx = 0, sy = 0, sxx = 0, sxy = 0;
        for (const int places : {4, 8, 16, 32, 64}) {
            const std::vector<float> few = picture(row.key, places);
            double sum = 0;
            int soft = 0;
            for (std::size_t i = 0; i < few.size(); ++i) {
                sum += (few[i] - limit[i]) * (few[i] - limit[i]);
                soft += limit[i] > 0.02 && limit[i] < 0.98;
            }
            ASSERT_GT(soft, 300);
            const double x = std::log(places), y = 0.5 * std::log(sum / soft);
            n += 1;
            sx += x;
            sy += y;
            sxx += x * x;
            sxy += x * y;
        }
        const double slope = (n * sxy - sx * sy) / (n * sxx - sx * sx);
        RecordProperty(std::string(row.key), std::to_string(slope));
        EXPECT_NEAR(slope, row.noise.slope, row.noise.tolerance);
    }
    EXPECT_GE(rows, 5);
}

}  // namespace
}  // namespace si::test
