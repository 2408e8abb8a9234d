// Compares the taps that kernels record on the GPU with the closed-form weights of each kernel's definition, and with
// the kernel's result.
#include <algorithm>
#include <glm/common.hpp>
#include <optional>
#include <set>

#include "renderer/bias/light_receiver.h"
#include "renderer/inspect/texel_usage.h"
#include "renderer/scenes/shapes.h"
#include "renderer/settings/depth_compare.h"
#include "renderer/settings/filters.h"
#include "tests/gl/frame_fixture.h"
#include "tests/support/hard_case.h"
#include "tests/support/sets.h"
#include "tests/support/square_kernels.h"
#include "tests/support/traits.h"

namespace si {
namespace {

/// Returns the share of a distribution about 0 between two places, of its density by Simpson's rule.
template <class Density>
double area(Density density, double lo, double hi) {
    if (hi <= lo) return 0;
    double sum = 0;
    const int n = 200;
    for (int i = 0; i < n; ++i) {
        const double a = lo + (hi - lo) * i / n, b = lo + (hi - lo) * (i + 1) / n;
        sum += (b - a) / 6 * (density(a) + 4 * density(0.5 * (a + b)) + density(b));
    }
    return sum;
}

/// Kernels that closed_form() defines. Other rows are tested by their recorded taps alone.
constexpr std::string_view kDefinedKernels[] = {"hard", "hw2x2", "pcf", "tent3", "tent", "castano5", "gauss"};

/// Returns the weight of the column (or row) `texel` for a kernel centred at `centre`, in texels from the map's corner:
/// the area of the kernel's shape above the texel, by its definition.
/// @returns nothing for kernels that are not among kDefinedKernels
std::optional<double> closed_form(const Settings& s, int texel, double centre) {
    const std::string_view kernel = filter_of(s).key;
    const int n = taps_across(filter_of(s), s);
    const double lo = texel - centre, hi = lo + 1, half = 0.5 * n;
    const auto nearest = [&](int across, auto weight) {  // texels with taps one texel apart
        const int at = texel - int(std::floor(centre - 0.5 * (across - 1)));
        return at < 0 || at >= across ? 0.0 : weight(at);
    };
    const auto box = [&](double width) {
        return std::max(std::min(hi, 0.5 * width) - std::max(lo, -0.5 * width), 0.0) / width;
    };
    if (kernel == "hard") return nearest(1, [](int) { return 1.0; });
    if (kernel == "tent3" && s.filter.bilinear) return std::max(2 - std::abs(lo + 0.5), 0.0) / 4;
    if (kernel == "tent3") return nearest(3, [](int i) { return i == 1 ? 0.5 : 0.25; });
    if (kernel == "hw2x2") return box(1);
    if (kernel == "pcf" && s.filter.point) return nearest(n, [&](int) { return 1.0 / n; });
    if (kernel == "pcf") return box(n);
    if (kernel == "tent") {
        const auto tent = [&](double x) { return (1 - std::abs(x) / half) / half; };
        return area(tent, std::max(lo, -half), std::min(hi, 0.0)) + area(tent, std::max(lo, 0.0), std::min(hi, half));
    }
    if (kernel == "castano5") {
        constexpr double kWeights[] = {4, 3, 1, 0, 0};
        const double away = std::min(std::abs(lo + 0.5), 3.0);
        const int at = int(away);
        return (kWeights[at] + (away - at) * (kWeights[at + 1] - kWeights[at])) / 12;
    }
    if (kernel == "gauss") {
        const double end = 0.5 * (n + 1), deviation = 0.4 * end;
        const auto at = [&](double off) {
            const auto bell = [&](double x) { return std::exp(-x * x / (2 * deviation * deviation)); };
            return std::max(bell(off) - bell(end), 0.0);
        };
        double all = 0;
        for (int i = -n - 2; i <= n + 2; ++i) all += at(lo + 0.5 + i);
        return at(lo + 0.5) / all;
    }
    return {};
}

class TapsTest : public FrameTest {
protected:
    const FrameRequest picture{.width = 160, .height = 120};
};

TEST(ClosedForms, ExistForSquareKernels) {
    for (const std::string_view key : kDefinedKernels) {
        const auto row = std::ranges::find(filters(), key, &Filter::key);
        ASSERT_NE(row, filters().end()) << key;
        EXPECT_TRUE(row->square()) << key;
        Settings s = test::texel_settings(key, 128, 0.7);
        EXPECT_TRUE(closed_form(s, 3, 3.4)) << key;
    }
}

SI_TESTS_ARE(Repeated, TapsTest);
SI_TESTS_ARE(Repeated, EachSquareKernel);
class EachSquareKernel : public TapsTest, public testing::WithParamInterface<test::SizedKernel> {};

SI_TEST_IS(Later, EachSquareKernel, WeighsEachTexelOnceByItsDefinition);
TEST_P(EachSquareKernel, WeighsEachTexelOnceByItsDefinition) {
    const Scene scene = test::floor_and_box(10, {1.5, 1, 2}, 0.4);
    Settings s = test::texel_settings(GetParam().key, 128, 0.7);
    s.bias.normal = 0.5;
    s.filter.size = GetParam().size;
    s.filter.point = GetParam().point;
    s.filter.bilinear = GetParam().bilinear;
    const Filter& filter = filter_of(s);
    const int across = taps_across(filter, s);
    const bool bilinear = is_bilinear(filter, s);
    for (const auto& [method, size] : {std::pair{"gather", MapSize(128)},
                                       {"sampler", MapSize(128)},
                                       {"gather", MapSize(128, 48)},
                                       {"sampler", MapSize(40, 160)}}) {
        SCOPED_TRACE(kernel_label(s) + " " + method + " " + std::to_string(size.width));
        set_setting(s, "filter.method", method);
        FrameRequest request = picture;
        request.map_size = size;
        int checked = 0;
        for (int y = 20; y < 110; y += 43)
            for (int x = 13; x < 150; x += 47) {
                const Probe p = renderer.probe(scene, s, request, x, y);
                if (!p.hit || p.lights[0].account.receiver.n_dot_l <= 0) continue;
                const Probe::PerLight& l = p.lights[0];
                const glm::dvec2 centre = glm::dvec2(l.account.receiver.tap) * p.map_size.texels();
                // A nearest texel is chosen in single precision, half a texel off by kernels of an even size.
                const glm::dvec2 f = glm::fract(2.0 * centre);
                if (std::min({f.x, f.y, 1 - f.x, 1 - f.y}) < 2e-3) continue;
                ++checked;
                double sum = 0;
                std::size_t weighing = 0;
                for (const KernelTap& t : l.taps) {
                    sum += t.weight;
                    weighing += t.weight > 0;
                    const auto across_u = closed_form(s, t.texel.x, centre.x);
                    const auto across_v = closed_form(s, t.texel.y, centre.y);
                    if (across_u && across_v) {
                        EXPECT_NEAR(t.weight, *across_u * *across_v, 2e-4) << t.texel.x << ", " << t.texel.y;
                    }
                    const glm::dvec2 off = glm::abs(glm::dvec2(t.texel) + 0.5 - centre);
                    EXPECT_LE(std::max(off.x, off.y), reach_of(s).read + 1e-3);
                    if (t.weight > 0) {
                        EXPECT_LE(std::max(off.x, off.y), reach_of(s).bias + 1e-3) << "kappa of its row";
                    }
                }
                EXPECT_NEAR(sum, 1, 1e-5);
                const int touched = bilinear ? across + 1 : across;
                EXPECT_EQ(weighing, std::size_t(touched * touched)) << "each texel once";
            }
        EXPECT_GT(checked, 3);
    }
}

INSTANTIATE_TEST_SUITE_P(All, EachSquareKernel, testing::ValuesIn(test::square_kernels({2, 3, 8})),
                         [](const auto& row) { return test::test_name(row.param); });

// A bilinear comparison weights 2x2 texels by its position: exactly the row's number of comparisons makes the picture.
TEST_F(TapsTest, BilinearComparisonsEqualWeightedTexels) {
    const Scene scene = test::floor_and_box(10, {1.5, 1, 2}, 0.4);
    for (const char* kernel : {"tent", "gauss", "tent3"})
        for (const int size : {5, 6, 7}) {
            Settings s = test::texel_settings(kernel, 128, 0.7);
            s.filter.size = size;
            s.filter.bilinear = true;
            const int pairs = taps_across(filter_of(s), s) / 2 + 1;
            EXPECT_EQ(kernel_cost(s).sampler_taps, pairs * pairs) << kernel << " " << size;
            std::vector<FloatImage> pictures;
            for (const char* method : {"gather", "sampler"}) {
                set_setting(s, "filter.method", method);
                pictures.push_back(visibility(scene, s, {.width = 96, .height = 72}));
            }
            double worst = 0;
            int soft = 0;
            for (std::size_t i = 0; i < pictures[0].data.size(); ++i) {
                worst = std::max(worst, double(std::abs(pictures[0].data[i] - pictures[1].data[i])));
                soft += pictures[0].data[i] > 0.05 && pictures[0].data[i] < 0.95;
            }
            // Samplers position a comparison to 1/256 of a texel.
            EXPECT_LT(worst, 2.0 / 256) << kernel << " " << size;
            EXPECT_GT(soft, 50);
        }
}

TEST_F(TapsTest, BilinearDisksOfNoRadiusAreOneBilinearComparison) {
    const Scene scene = test::floor_and_box(10, {1.5, 1, 2}, 0.4);
    for (const char* bias : {"constant", "receiver-plane"})
        for (const char* method : {"gather", "sampler"}) {
            Settings s = test::texel_settings("hw2x2", 128, 0.7);
            set_setting(s, "bias.kind", bias);
            set_setting(s, "filter.method", method);
            const FloatImage one = visibility(scene, s, picture);
            for (const char* kernel : {"poisson", "vogel"}) {
                SCOPED_TRACE(fmt::format("{} {} {}", kernel, bias, method));
                set_setting(s, "filter.kernel", kernel);
                s.filter.radius = 0;
                for (const bool bilinear : {true, false}) {
                    s.filter.bilinear = bilinear;
                    const FloatImage disk = visibility(scene, s, picture);
                    int differ = 0;
                    for (std::size_t i = 0; i < one.data.size(); ++i)
                        differ += std::abs(one.data[i] - disk.data[i]) > 2.0 / 256;
                    if (bilinear)
                        EXPECT_EQ(differ, 0);
                    else
                        EXPECT_GT(differ, 50);
                }
            }
        }
}

SI_TEST_IS(Later, TapsTest, BilinearDisksWeighTexelsInReachByGatherAndSampler);
TEST_F(TapsTest, BilinearDisksWeighTexelsInReachByGatherAndSampler) {
    const Scene scene = test::floor_and_box(10, {1.5, 1, 2}, 0.4);
    for (const char* kernel : {"poisson", "vogel", "pcss"}) {
        SCOPED_TRACE(kernel);
        Settings s = test::texel_settings(kernel, 128, 0.7);
        s.filter.bilinear = true;
        s.filter.max_radius = 6;
        const double nearest = [&] {
            Settings other = s;
            other.filter.bilinear = false;
            return reach_of(other).bias;
        }();
        EXPECT_DOUBLE_EQ(reach_of(s).bias, nearest + 0.5);
        std::vector<FloatImage> pictures;
        for (const char* method : {"gather", "sampler"}) {
            set_setting(s, "filter.method", method);
            pictures.push_back(visibility(scene, s, {.width = 96, .height = 72}));
            int checked = 0;
            for (int y = 20; y < 110; y += 43)
                for (int x = 13; x < 150; x += 47) {
                    const Probe p = renderer.probe(scene, s, picture, x, y);
                    if (!p.hit || p.lights[0].account.receiver.n_dot_l <= 0 || p.lights[0].taps.empty()) continue;
                    ++checked;
                    const glm::dvec2 centre = glm::dvec2(p.lights[0].account.receiver.tap) * p.map_size.texels();
                    double sum = 0;
                    for (const KernelTap& t : p.lights[0].taps) {
                        sum += t.weight;
                        const glm::dvec2 off = glm::abs(glm::dvec2(t.texel) + 0.5 - centre);
                        if (t.weight > 0) {
                            EXPECT_LE(std::max(off.x, off.y), reach_of(s).bias + 1e-3);
                        }
                    }
                    EXPECT_NEAR(sum, 1, 1e-5);
                }
            EXPECT_GT(checked, 0);
        }
        double worst = 0;
        for (std::size_t i = 0; i < pictures[0].data.size(); ++i)
            worst = std::max(worst, double(std::abs(pictures[0].data[i] - pictures[1].data[i])));
        EXPECT_LT(worst, 2.0 / 256) << "samplers position a comparison to 1/256 of a texel";
    }
}

SI_TEST_IS(Later, TapsTest, StoreTheMapsDepthsAndFollowTheWrapModeOutside);
TEST_F(TapsTest, StoreTheMapsDepthsAndFollowTheWrapModeOutside) {
    const Scene scene = test::floor_and_box(10, {1.5, 1, 2}, 0.4);
    Settings s = settings_with(test::texel_settings("pcf5", 64, 1), {"light.fit=manual", "light.extent=2"});
    FrameRequest maps = picture;
    maps.outputs.shadow_map = true;
    int inside = 0, beyond = 0;
    for (const char* wrap : {"border", "clamp", "repeat"}) {
        set_setting(s, "map.wrap", wrap);
        const FloatImage map = renderer.read_shadow_map(renderer.render(scene, s, maps), 0, 0);
        for (int y = 10; y < 115; y += 9)
            for (int x = 5; x < 155; x += 11) {
                const Probe p = renderer.probe(scene, s, picture, x, y);
                if (!p.hit || p.lights[0].place == MapPlace::Behind) continue;
                const int n = p.map_resolution;
                for (const KernelTap& t : p.lights[0].taps) {
                    glm::ivec2 at = t.texel;
                    const bool in = at.x >= 0 && at.y >= 0 && at.x < n && at.y < n;
                    ++(in ? inside : beyond);
                    if (std::string_view(wrap) == "repeat") at = ((at % n) + n) % n;
                    if (std::string_view(wrap) == "border" && !in) {
                        EXPECT_EQ(t.stored, 1.0);
                        continue;
                    }
                    at = glm::clamp(at, glm::ivec2(0), glm::ivec2(n - 1));
                    EXPECT_EQ(float(t.stored), map.at(at.x, n - 1 - at.y))
                        << wrap << " " << t.texel.x << ", " << t.texel.y;
                }
            }
    }
    EXPECT_GT(inside, 1000);
    EXPECT_GT(beyond, 200);
}

SI_TEST_IS(Later, TapsTest, TexelsReadAreTheTapsOfAllPixels);
TEST_F(TapsTest, TexelsReadAreTheTapsOfAllPixels) {
    const Scene scene = test::floor_and_box(10, {1.5, 1, 2}, 0.4);
    FrameRequest request{
        .width = 12, .height = 8, .outputs = {.colour = false, .map_coordinates = true, .texels_read = true}};
    for (const char* kernel : {"hard", "tent3", "pcf3", "tent5", "poisson"})
        for (const char* wrap : {"border", "repeat"}) {
            const MapSize size = std::string_view(wrap) == "repeat" ? MapSize(96, 40) : MapSize(96);
            request.map_size = size;
            SCOPED_TRACE(std::string(kernel) + " " + wrap);
            Settings s = test::texel_settings(kernel, 96, 0.7);
            set_setting(s, "map.wrap", wrap);
            set_all(s, {"light.fit=manual", "light.extent=4"});
            const FrameResult frame = renderer.render(scene, s, request);
            EXPECT_EQ(renderer.render(scene, s, request).pass("texels read")->state, PassState::Cached);
            const FloatImage read = renderer.read_float(frame.texels_read, 1);
            const FloatImage at = renderer.read_float(frame.map_coordinates, 4);
            const glm::ivec2 n = frame.map_size.sides();
            std::set<std::pair<int, int>> expected, found;
            for (int y = 0; y < n.y; ++y)
                for (int x = 0; x < n.x; ++x)
                    if (read.at(x, y) == 1) found.emplace(x, n.y - 1 - y);
            for (int y = 0; y < request.height; ++y)
                for (int x = 0; x < request.width; ++x) {
                    const Probe p = renderer.probe(
                        scene, s, {.width = request.width, .height = request.height, .map_size = size}, x, y);
                    if (!p.hit || !faces_light(p.lights[0].account.receiver.n_dot_l)) continue;
                    for (const KernelTap& t : p.lights[0].taps) {
                        glm::ivec2 texel = t.texel;
                        if (std::string_view(wrap) == "repeat") texel = ((texel % n) + n) % n;
                        if (texel.x >= 0 && texel.y >= 0 && texel.x < n.x && texel.y < n.y)
                            expected.emplace(texel.x, texel.y);
                    }
                }
            EXPECT_GT(expected.size(), 20u);
            EXPECT_EQ(found, expected);
            const double share = double(found.size()) / (n.x * n.y), bound = texel_usage(at, s, size).utilisation();
            EXPECT_LE(share, bound + 1e-9) << "a rectangle a pixel holds all that it reads";
            if (std::string_view(kernel) == "poisson") {
                EXPECT_LT(share, 0.8 * bound);
            }
        }
}

/// The surfaces that a bias by derivatives has read serve every other bias, and not the reverse.
TEST_F(TapsTest, ImagesOfTheSurfacesAreKeptForABiasThatReadsFewer) {
    const Scene scene = test::floor_and_box(10, {1.5, 1, 2}, 0.4);
    FrameRequest request{.width = 48, .height = 32, .outputs = {.colour = false, .texels_read = true}};
    Settings plain = test::texel_settings("pcf3", 96, 0.7), derivatives = plain;
    set_setting(derivatives, "bias.kind", "receiver-plane-derivatives");
    const auto surfaces = [&](const Settings& s) {
        const FrameResult frame = renderer.render(scene, s, request);
        Renderer other;
        const FrameResult alone = other.render(scene, s, request);
        EXPECT_EQ(renderer.read_float(frame.texels_read, 1).data, other.read_float(alone.texels_read, 1).data);
        return frame.pass("visible surfaces")->state;
    };
    EXPECT_EQ(surfaces(plain), PassState::Drawn);
    EXPECT_EQ(surfaces(derivatives), PassState::Drawn) << "more images";
    EXPECT_EQ(surfaces(plain), PassState::Cached);
    EXPECT_EQ(surfaces(derivatives), PassState::Cached);
    request.force = true;
    EXPECT_EQ(surfaces(plain), PassState::Drawn);
    request.force = false;
    EXPECT_EQ(surfaces(derivatives), PassState::Drawn) << "the forced frame drew fewer";
    EXPECT_EQ(surfaces(plain), PassState::Cached);
    plain.camera.azimuth += 1;
    EXPECT_EQ(surfaces(plain), PassState::Drawn);
}

/// A bias without normal offset leaves the normal's source without effect, but reads the same images as others.
TEST_F(TapsTest, ImagesOfTheSurfacesAreKeptWhereTheNormalHasNoEffect) {
    const Scene scene = test::floor_and_box(10, {1.5, 1, 2}, 0.4);
    const FrameRequest request{.width = 48, .height = 32, .outputs = {.colour = false, .texels_read = true}};
    Settings s = test::texel_settings("pcf3", 96, 0.7);
    set_setting(s, "bias.kind", "constant");
    s.bias.normal = 0;
    const auto surfaces = [&] { return renderer.render(scene, s, request).pass("visible surfaces")->state; };
    EXPECT_EQ(surfaces(), PassState::Drawn);
    s.bias.normal = 2;
    EXPECT_EQ(surfaces(), PassState::Cached) << "the normal's source has an effect now";
    s.bias.normal = 0;
    EXPECT_EQ(surfaces(), PassState::Cached);
    set_setting(s, "bias.normal_source", "shading");
    EXPECT_EQ(surfaces(), PassState::Drawn) << "one more image";
}

}  // namespace
}  // namespace si
