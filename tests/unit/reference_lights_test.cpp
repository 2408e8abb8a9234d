// Tests of lights with a size: penumbrae compared with closed forms, noise of samples, and work of progressive
// refinement.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "renderer/scenes/shapes.h"
#include "tests/support/box_scene.h"
#include "tests/support/traced.h"

namespace si {
namespace {

using test::geometry_of;
using test::query_for;
using test::sun;

constexpr double kPi = std::numbers::pi;
constexpr double kHeight = 2;  // height in metres of the half plane x > 0 over the floor

/// Returns the share of a unit disk at x < s, the part of a light that an edge leaves visible.
double disk_share(double s) {
    s = std::clamp(s, -1.0, 1.0);
    return 0.5 + (std::asin(s) + s * std::sqrt(1 - s * s)) / kPi;
}

/// Makes a floor, and a plane over it so wide that only its edge at x = 0 matters.
Scene half_plane() {
    return test::grey_scene(
        {{"floor", make_plane(8, 8)}, {"half plane", make_plane(200, 200), moved(100, kHeight, 0)}});
}

struct Penumbra {
    double rms = 0, mean = 0, largest = 0;
    std::size_t partial = 0;
    Reference reference;
};

/// Traces floor points along x in [-reach, reach] and compares them with share(x).
template <typename Share>
Penumbra penumbra(const Emitter& light, double reach, const ReferenceOptions& options, Share&& share) {
    const Scene scene = half_plane();
    const auto geometry = geometry_of(scene);
    Receivers receivers;
    receivers.width = 400;
    receivers.height = 4;
    for (int y = 0; y < receivers.height; ++y)
        for (int x = 0; x < receivers.width; ++x)
            receivers.pixels.push_back(
                test::floor_receiver({reach * (2 * (x + 0.5) / receivers.width - 1), 0, 0.1 * y}, 8));
    Penumbra p;
    p.reference = trace_visibility(ReferenceScene(geometry), receivers, query_for(scene, light, options), {});
    double squares = 0, sum = 0;
    for (std::size_t i = 0; i < receivers.pixels.size(); ++i) {
        const double expected = share(receivers.pixels[i].position_ws.x);
        const double error = p.reference.visibility.data[i] - expected;
        if (expected > 0 && expected < 1) {
            ++p.partial;
            squares += error * error;
            sum += error;
        }
        p.largest = std::max(p.largest, std::abs(error));
    }
    p.rms = std::sqrt(squares / double(p.partial));
    p.mean = sum / double(p.partial);
    return p;
}

void expect_penumbra(const Penumbra& p, const char* what) {
    EXPECT_GT(p.partial, 300u) << what;
    EXPECT_LT(p.rms, 0.004) << what << ": 1024 stratified samples err by 0.0022 at an edge";
    EXPECT_LT(std::abs(p.mean), 0.0012) << what;
    EXPECT_LT(p.largest, 0.02) << what;
}

const ReferenceOptions kFine{.area = true, .samples = 1024, .noise = 0};

TEST(AreaLight, SunBehindAnEdgeMatchesTheClosedForm) {
    const double radius_deg = 2, tangent = std::tan(radius_deg * kPi / 180);
    expect_penumbra(penumbra(sun({0, 1, 0}, radius_deg), 2 * kHeight * tangent, kFine,
                             [&](double x) { return disk_share(-x / (kHeight * tangent)); }),
                    "sun");
}

TEST(AreaLight, SpotDiskBehindAnEdgeMatchesTheClosedForm) {
    Emitter spot = sun({0, 1, 0});
    spot.type = LightType::Spot;
    const double height = 5, radius = 0.8;
    spot.position_ws = {0, height, 0.15};
    spot.size = radius;
    spot.cos_cone = 0.2;
    // The point x sees the part of the light at y < x (1 - D / H) past the edge.
    const double reach = 2 * radius / (height / kHeight - 1);
    expect_penumbra(
        penumbra(spot, reach, kFine, [&](double x) { return disk_share(x * (1 - height / kHeight) / radius); }),
        "spot");
}

TEST(AreaLight, PointLightSphereBehindAnEdgeMatchesTheClosedForm) {
    Emitter point = sun({0, 1, 0});
    point.type = LightType::Point;
    const double height = 50, radius = 1;
    point.position_ws = {0, height, 0.15};
    point.size = radius;
    // A distant sphere is almost the disk of its outline.
    const double tangent = radius / std::sqrt(height * height - radius * radius);
    expect_penumbra(penumbra(point, 2 * kHeight * tangent, kFine,
                             [&](double x) {
                                 const double shift = x / kHeight - x / height;
                                 return disk_share(-shift / tangent);
                             }),
                    "point");
}

TEST(AreaLight, NoiseFallsLikeStratifiedSamples) {
    const double tangent = std::tan(2 * kPi / 180);
    const auto at = [&](int samples) {
        return penumbra(sun({0, 1, 0}, 2), 2 * kHeight * tangent, {.area = true, .samples = samples, .noise = 0},
                        [&](double x) { return disk_share(-x / (kHeight * tangent)); });
    };
    const Penumbra coarse = at(64), middle = at(256), fine = at(1024);
    // Independent samples would have an error of 0.047 and gain only a factor of 4.
    EXPECT_LT(coarse.rms, 0.025);
    EXPECT_GT(coarse.rms / fine.rms, 5.5);
    EXPECT_GT(coarse.rms, middle.rms);
    for (const Penumbra* p : {&coarse, &middle, &fine}) {
        // The estimate covers all counted pixels and may be conservative.
        const double own = p->reference.noise * std::sqrt(double(p->reference.counted()) / double(p->partial));
        EXPECT_GT(own, 0.8 * p->rms);
        EXPECT_LT(own, 3 * p->rms);
    }
}

TEST(AreaLight, RefinesOnlyPartlyVisibleLights) {
    const double tangent = std::tan(0.5 * kPi / 180);
    const auto share = [&](double x) { return disk_share(-x / (kHeight * tangent)); };
    const auto at = [&](double noise) {
        return penumbra(sun({0, 1, 0}, 0.5), 10 * kHeight * tangent, {.area = true, .samples = 1024, .noise = noise},
                        share);
    };
    const Penumbra coarse = at(1), target = at(0.008), fine = at(0);
    const auto per_pixel = [](const Penumbra& p) {
        return double(p.reference.rays) / double(p.reference.counted()) - 1;
    };
    // A tenth of the pixels is in the penumbra and gets 64 samples at least, the others 8.
    EXPECT_NEAR(per_pixel(coarse), 0.9 * 8 + 0.1 * 64, 3);
    EXPECT_GT(per_pixel(target), 1.2 * per_pixel(coarse));
    EXPECT_LT(per_pixel(target), 0.95 * per_pixel(fine)) << "some pixels were good enough";
    EXPECT_NEAR(per_pixel(fine), 0.9 * 8 + 0.1 * 1024, 3);
    EXPECT_LT(fine.rms, 0.6 * coarse.rms);
    EXPECT_LT(target.rms, 0.008);
    EXPECT_NEAR(double(target.reference.partial), double(target.partial), 0.1 * double(target.partial));
}

TEST(AreaLight, EndsForAnyNumberOfFirstSamples) {
    const double tangent = std::tan(2 * kPi / 180);
    for (const int first : {1, 7, 63, 64, 200}) {
        const Penumbra p = penumbra(sun({0, 1, 0}, 2), 2 * kHeight * tangent,
                                    {.area = true, .samples = 256, .first_samples = first, .noise = 0.005},
                                    [&](double x) { return disk_share(-x / (kHeight * tangent)); });
        EXPECT_LT(p.rms, 0.01) << first;
    }
}

TEST(AreaLight, ReportsSamplesAndUncertainty) {
    const double tangent = std::tan(0.5 * kPi / 180);
    const auto at = [&](int samples, double noise = 0) {
        return penumbra(sun({0, 1, 0}, 0.5), 10 * kHeight * tangent, {.area = true, .samples = samples, .noise = noise},
                        [&](double x) { return disk_share(-x / (kHeight * tangent)); })
            .reference;
    };
    for (const int few : {1, 2, 3}) {
        const Reference one = at(few);
        EXPECT_TRUE(std::isnan(one.noise)) << "a single sample varies from nothing";
        EXPECT_EQ(one.noise_unknown, one.counted());
        EXPECT_TRUE(std::all_of(one.standard_error.data.begin(), one.standard_error.data.end(),
                                [](float e) { return std::isnan(e); }));
        EXPECT_EQ(one.samples.most, few) << "no group of four";
        const std::string text = few == 1 ? "1 sample a pixel" : std::to_string(few) + " samples a pixel";
        EXPECT_NE(noise_text(one).find("noise unknown, " + text), std::string::npos) << noise_text(one);
    }
    const Reference fine = at(1000);
    EXPECT_EQ(fine.noise_unknown, 0u);
    EXPECT_EQ(fine.samples.least, 8) << "what sees all of the light or none";
    // A tenth of the pixels is in the penumbra.
    EXPECT_EQ(fine.samples.most, 1000);
    EXPECT_NEAR(fine.samples.mean, 8 * 0.9 + 0.1 * 1000, 3);
    EXPECT_EQ(at(1024, 1).samples.most, 256) << "a caster's edge crosses the light, but all samples agree";
    EXPECT_EQ(fine.standard_error.data[0], 0) << "wholly lit";
    EXPECT_EQ(fine.standard_error.data[399], 0) << "wholly dark";
    EXPECT_GT(fine.standard_error.data[200], 0) << "half";
    const Reference hard = penumbra(sun({0, 1, 0}), 1, {}, [](double x) { return x < 0 ? 1.0 : 0.0; }).reference;
    EXPECT_TRUE(hard.standard_error.data.empty());
    EXPECT_EQ(hard.noise, 0);
    EXPECT_EQ(noise_text(hard), "");
}

TEST(AreaLight, ErrorOfEachPixelHoldsForAnyDivisionOfSamples) {
    const double tangent = std::tan(2 * kPi / 180);
    const auto share = [&](double x) { return disk_share(-x / (kHeight * tangent)); };
    // Grids of five by five and seven by seven leave a row and a column outside the squares of two by two.
    for (const int samples : {16, 25, 49, 64}) {
        const Penumbra p =
            penumbra(sun({0, 1, 0}, 2), 2 * kHeight * tangent, {.area = true, .samples = samples, .noise = 0}, share);
        double ratio = 0;
        for (std::size_t i = 0; i < p.reference.state.size(); ++i) {
            const double x = 2 * kHeight * tangent * (2 * (double(i % 400) + 0.5) / 400 - 1);
            const double expected = share(x), error = p.reference.visibility.data[i] - expected;
            if (expected > 0 && expected < 1) ratio += error * error - std::pow(p.reference.standard_error.data[i], 2);
        }
        // In the mean the squared estimate equals the squared error, or is conservative.
        EXPECT_LT(ratio / double(p.partial), 0.3 * p.rms * p.rms) << samples;
        EXPECT_GT(ratio / double(p.partial), -8 * p.rms * p.rms) << samples;
    }
}

// A strip of a disk that a thin bar hides, as the difference of what both of its edges hide.
TEST(AreaLight, FindsBarsThatHideFewHundredthsOfTheLight) {
    const double radius_deg = 2, radius_m = kHeight * std::tan(radius_deg * kPi / 180);
    for (const double width : {0.02, 0.1, 0.5}) {
        const double half_m = 0.5 * width * radius_m;
        const Scene scene =
            test::grey_scene({{"floor", make_plane(8, 8)}, {"bar", make_plane(2 * half_m, 200), moved(0, kHeight, 0)}});
        const auto geometry = geometry_of(scene);
        Receivers receivers{.width = 400, .height = 20, .pixels = {}};
        for (int y = 0; y < receivers.height; ++y)
            for (int x = 0; x < receivers.width; ++x)
                receivers.pixels.push_back(
                    test::floor_receiver({4 * radius_m * (2 * (x + 0.5) / receivers.width - 1), 0, 0.1 * y}, 8));
        const ReferenceQuery query = query_for(scene, sun({0, 1, 0}, radius_deg), {.area = true});
        const Reference reference = trace_visibility(ReferenceScene(geometry), receivers, query, {});
        double squares = 0, largest = 0;
        for (std::size_t i = 0; i < receivers.pixels.size(); ++i) {
            const double x = receivers.pixels[i].position_ws.x;
            const double hidden = disk_share((half_m - x) / radius_m) - disk_share((-half_m - x) / radius_m);
            const double error = reference.visibility.data[i] - (1 - hidden);
            squares += error * error;
            largest = std::max(largest, std::abs(error));
        }
        EXPECT_LT(std::sqrt(squares / double(receivers.pixels.size())), query.options.noise) << width;
        EXPECT_LT(largest, 0.04) << width;
    }
}

TEST(AreaLight, SamplesOfAnyRunAreOneInEachCellOfEachGrid) {
    const Emitter light = sun({0.3, 1, 0.2}, 3);
    for (const std::uint64_t pixel : {0u, 1u, 77u, 921599u}) {
        const LightSamples samples(light, {1, 2, 3}, pixel);
        for (const int digits : {2, 5, 8, 11})
            for (int across = 0; across <= digits; ++across) {
                const int down = digits - across;
                std::vector<int> count(std::size_t{1} << digits, 0);
                for (std::uint32_t k = 0; k < count.size(); ++k) {
                    const LightCell cell = samples.cell(k);
                    ++count[std::size_t(cell.y >> (16 - down)) << across | std::size_t(cell.x >> (16 - across))];
                }
                EXPECT_EQ(std::ranges::count(count, 1), std::ptrdiff_t(count.size())) << pixel << " " << across;
            }
        double cosine = 1;
        glm::dvec3 sum(0);
        for (std::uint32_t k = 0; k < 1024; ++k) {
            const LightRay ray = samples.ray(k);
            EXPECT_NEAR(glm::length(ray.direction), 1, 1e-12);
            cosine = std::min(cosine, glm::dot(ray.direction, light.to_light));
            sum += ray.direction;
        }
        EXPECT_GE(cosine, std::cos(3 * kPi / 180) - 1e-12) << "all on the light";
        EXPECT_LT(glm::distance(glm::normalize(sum), light.to_light), 1e-3) << "around its middle";
    }
}

TEST(AreaLight, PlacesAreWhereRaysCrossTheDisksPlane) {
    const glm::dvec3 point(40, -2, 7), centre(43, 9, 6);
    Emitter sunlight = sun(glm::normalize(glm::dvec3(0.3, 1, -0.2)), 25), spot = sunlight, sphere = sunlight;
    spot.type = LightType::Spot;
    sphere.type = LightType::Point;
    for (Emitter* e : {&spot, &sphere}) {
        e->position_ws = centre;
        e->size = 2.7;
    }
    constexpr std::uint32_t kPoints = 1500;
    std::vector<std::uint32_t> points(kPoints);
    for (std::uint32_t k = 0; k < kPoints; ++k) points[k] = kPoints - 1 - k;
    std::vector<float> x(kPoints), y(kPoints);
    for (const Emitter* light : {&sunlight, &spot, &sphere}) {
        const LightSamples samples(*light, point, 5);
        const std::optional<LightDisk> disk = samples.disk();
        ASSERT_TRUE(disk);
        samples.find_places(points, x, y);
        double farthest = 0;
        for (std::uint32_t i = 0; i < kPoints; ++i) {
            const LightRay ray = samples.ray(points[i]);
            const glm::dvec3 along = glm::transpose(disk->axes) * ray.direction;
            EXPECT_NEAR(x[i], along.x / along.z, 1e-6);
            EXPECT_NEAR(y[i], along.y / along.z, 1e-6);
            farthest = std::max(farthest, glm::distance(glm::dvec2(x[i], y[i]), disk->centre));
            if (light == &sunlight) continue;
            EXPECT_GE(ray.length_m * along.z, disk->near_m - 1e-9);
            EXPECT_LE(ray.length_m * along.z, disk->far_m + 1e-9);
        }
        EXPECT_LT(farthest, disk->radius + 1e-6);
        EXPECT_GT(farthest, 0.98 * disk->radius);
    }
    EXPECT_FALSE(LightSamples(sun({0, 1, 0}, 61), point, 5).disk()) << "too wide";
    EXPECT_FALSE(LightSamples(sphere, centre + 1.0, 5).disk()) << "within the light";
    EXPECT_FALSE(LightSamples(spot, centre + 9.0 * spot.to_light, 5).disk()) << "behind the light";
}

TEST(AreaLight, FindsAHundredthOfTheLightBehindAnEdge) {
    constexpr double kRadiusDeg = 0.1, kHidden = 0.01;
    const double radius_m = kHeight * std::tan(kRadiusDeg * kPi / 180);
    double low = -1, high = 1;
    for (int step = 0; step < 50; ++step) (disk_share(0.5 * (low + high)) > kHidden ? high : low) = 0.5 * (low + high);
    const auto geometry = geometry_of(half_plane());
    // Pairs of pixels beside a hard edge, too far from each other to be neighbours.
    Receivers receivers{.width = 2, .height = 300, .pixels = {}};
    receivers.pixels.assign(600, Receiver());
    for (std::size_t i = 0; i < receivers.pixels.size(); i += 6) {
        receivers.pixels[i] = test::floor_receiver({low * radius_m, 0, 0.01 * double(i) - 3}, 8);
        receivers.pixels[i + 1] = test::floor_receiver({1, 0, 0.01 * double(i) - 3}, 8);
    }
    const ReferenceQuery query = query_for(half_plane(), sun({0, 1, 0}, kRadiusDeg), {.area = true});
    const Reference reference = trace_visibility(ReferenceScene(geometry), receivers, query, {});
    int missed = 0;
    for (std::size_t i = 0; i < receivers.pixels.size(); i += 6) {
        missed += reference.visibility.data[i] == 1;
        EXPECT_NEAR(reference.visibility.data[i], 1 - kHidden, 1.01 * kHidden) << i;
        EXPECT_EQ(reference.visibility.data[i + 1], 0) << i;
    }
    EXPECT_LE(missed, 5) << "of 100, of which 64 samples alone miss 39";
}

TEST(AreaLight, HardEdgesTakeEightSamplesAPixel) {
    const Penumbra p = penumbra(sun({0, 1, 0}, 1e-4), 2, {.area = true}, [](double x) { return x < 0 ? 1.0 : 0.0; });
    EXPECT_EQ(p.largest, 0);
    // A hard ray and 8 samples in each pixel: no caster's edge crosses the light.
    EXPECT_EQ(p.reference.rays, 4u * 400 * (1 + 8));
}

TEST(AreaLight, SizeZeroGivesHardShadows) {
    const Penumbra p = penumbra(sun({0.3, 1, 0}, 0), 2, {.area = true, .samples = 64},
                                [](double x) { return x + 0.3 * kHeight < 0 ? 1.0 : 0.0; });
    EXPECT_EQ(p.reference.visibility.data, p.reference.hard().data);
    EXPECT_EQ(p.reference.noise, 0) << "nothing is estimated";
    EXPECT_LT(p.largest, 1e-6);
}

TEST(AreaLight, GrazingSunCountsOnlyPartsAboveTheHorizon) {
    // Half of this sun is below the floor's horizon; the floor hides nothing of the rest.
    const Penumbra p =
        penumbra(sun({-1, 0.001, 0}, 3), 0.5, {.area = true, .samples = 256, .noise = 0}, [](double) { return 1.0; });
    EXPECT_EQ(p.reference.counted(), p.reference.state.size());
    EXPECT_EQ(p.largest, 0);
}

}  // namespace
}  // namespace si
