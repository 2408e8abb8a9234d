// The taps that kernels make on the GPU: recorded while they run, held against the weights that each kernel's
// definition gives in closed form, and against what the kernel found.
#include <set>

#include "renderer/bias/light_receiver.h"
#include "renderer/inspect/texel_usage.h"
#include "renderer/scenes/shapes.h"
#include "renderer/settings/filters.h"
#include "tests/gl/frame_fixture.h"
#include "tests/support/hard_case.h"

namespace si {
namespace {

/// Weight of the column (or row) `texel` for a kernel centred at `centre`, in texels from the map's corner.
double closed_form(std::string_view kernel, int texel, double centre) {
    const auto nearest = [&](std::initializer_list<double> weights) {
        const int at = texel - (int(std::floor(centre)) - int(weights.size()) / 2);
        return at < 0 || at >= int(weights.size()) ? 0 : *(weights.begin() + at);
    };
    const auto bilinear = [&](int n) {  // the box of n texels about the centre, by how much of each texel it covers
        const double lo = std::max(centre - 0.5 * n, double(texel)), hi = std::min(centre + 0.5 * n, texel + 1.0);
        return std::max(hi - lo, 0.0) / n;
    };
    if (kernel == "hard") return nearest({1});
    if (kernel == "pcf3_nearest") return nearest({1 / 3.0, 1 / 3.0, 1 / 3.0});
    if (kernel == "pcf5_nearest") return nearest({0.2, 0.2, 0.2, 0.2, 0.2});
    if (kernel == "tent3") return nearest({0.25, 0.5, 0.25});
    if (kernel == "hw2x2") return bilinear(1);
    if (kernel == "pcf3") return bilinear(3);
    if (kernel == "pcf5") return bilinear(5);
    if (kernel == "pcf7") return bilinear(7);
    if (kernel == "pcf9") return bilinear(9);
    ADD_FAILURE() << kernel << " has no closed form here";
    return 0;
}

class TapsTest : public FrameTest {
protected:
    const FrameRequest picture{.width = 160, .height = 120};
};

TEST_F(TapsTest, WeighWhatEachKernelsDefinitionSays) {
    const Scene scene = test::floor_and_box(10, {1.5, 1, 2}, 0.4);
    for (const Filter& filter : filters())
        for (const char* method : {"gather", "sampler"}) {
            if (!filter.square) continue;
            Settings s = test::texel_settings(filter.key, 128, 0.7);
            s.bias.normal = 0.5;
            set_setting(s, "filter.method", method);
            int checked = 0;
            for (int y = 20; y < 110; y += 29)
                for (int x = 13; x < 150; x += 31) {
                    const Probe p = renderer.probe(scene, s, picture, x, y);
                    if (!p.hit || p.lights[0].n_dot_l <= 0) continue;
                    SCOPED_TRACE(std::string(filter.key) + " " + method);
                    const Probe::PerLight& l = p.lights[0];
                    const glm::dvec2 centre = glm::dvec2(l.tap) * double(p.map_resolution);
                    // A nearest texel is chosen in single precision.
                    if (const glm::dvec2 f = centre - glm::floor(centre); std::min({f.x, f.y, 1 - f.x, 1 - f.y}) < 1e-3)
                        continue;
                    ++checked;
                    double sum = 0;
                    for (const KernelTap& t : l.taps) {
                        sum += t.weight;
                        EXPECT_NEAR(
                            t.weight,
                            closed_form(filter.key, t.texel.x, centre.x) * closed_form(filter.key, t.texel.y, centre.y),
                            2e-4)
                            << t.texel.x << ", " << t.texel.y;
                        const glm::dvec2 off = glm::abs(glm::dvec2(t.texel) + 0.5 - centre);
                        EXPECT_LE(std::max(off.x, off.y), reach_of(s).bias + 1e-3) << "kappa of its row";
                    }
                    EXPECT_NEAR(sum, 1, 1e-5);
                    const int across = filter.bilinear ? filter.size + 1 : filter.size;
                    EXPECT_EQ(l.taps.size(), std::size_t(across * across)) << "each texel once";
                    EXPECT_EQ(l.taps_size, glm::ivec2(across));
                }
            EXPECT_GT(checked, 8) << filter.key;
        }
}

TEST_F(TapsTest, StoreWhatTheMapHoldsThereAndAnswerBeyondIt) {
    const Scene scene = test::floor_and_box(10, {1.5, 1, 2}, 0.4);
    Settings s = test::texel_settings("pcf5", 64, 1);
    s.lights[0].fit = int(LightFit::Manual);
    s.lights[0].extent = 2;
    int inside = 0, beyond = 0;
    for (const char* wrap : {"border", "clamp", "repeat"}) {
        set_setting(s, "map.wrap", wrap);
        const FloatImage map = renderer.read_shadow_map(renderer.render(scene, s, picture), 0, 0);
        for (int y = 10; y < 115; y += 9)
            for (int x = 5; x < 155; x += 11) {
                const Probe p = renderer.probe(scene, s, picture, x, y);
                if (!p.hit || p.lights[0].where == "behind") continue;
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

TEST_F(TapsTest, TexelsReadAreThoseOfAllPixelsTaps) {
    const Scene scene = test::floor_and_box(10, {1.5, 1, 2}, 0.4);
    FrameRequest request{.width = 12, .height = 8};
    request.outputs = {.colour = false, .map_coordinates = true, .texels_read = true};
    for (const char* kernel : {"hard", "tent3", "pcf3", "poisson"})
        for (const char* wrap : {"border", "repeat"}) {
            SCOPED_TRACE(std::string(kernel) + " " + wrap);
            Settings s = test::texel_settings(kernel, 96, 0.7);
            set_setting(s, "map.wrap", wrap);
            s.lights[0].fit = int(LightFit::Manual);
            s.lights[0].extent = 4;
            const FrameResult frame = renderer.render(scene, s, request);
            EXPECT_EQ(renderer.render(scene, s, request).pass("texels read")->state, PassState::Reused);
            const FloatImage read = renderer.read_float(frame.texels_read, 1);
            const FloatImage at = renderer.read_float(frame.map_coordinates, 4);
            const int n = frame.map_resolution;
            std::set<std::pair<int, int>> expected, found;
            for (int y = 0; y < n; ++y)
                for (int x = 0; x < n; ++x)
                    if (read.at(x, y) == 1) found.emplace(x, n - 1 - y);
            for (int y = 0; y < request.height; ++y)
                for (int x = 0; x < request.width; ++x) {
                    const Probe p = renderer.probe(scene, s, {.width = request.width, .height = request.height}, x, y);
                    if (!p.hit || !faces_light(p.lights[0].n_dot_l)) continue;
                    for (const KernelTap& t : p.lights[0].taps) {
                        glm::ivec2 texel = t.texel;
                        if (std::string_view(wrap) == "repeat") texel = ((texel % n) + n) % n;
                        if (texel.x >= 0 && texel.y >= 0 && texel.x < n && texel.y < n)
                            expected.emplace(texel.x, texel.y);
                    }
                }
            EXPECT_GT(expected.size(), 30u);
            EXPECT_EQ(found, expected);
            const double share = double(found.size()) / (n * n), bound = texel_usage(at, s, n).utilisation();
            EXPECT_LE(share, bound + 1e-9) << "a rectangle a pixel holds all that it reads";
            if (std::string_view(kernel) == "poisson") {
                EXPECT_LT(share, 0.8 * bound);
            }
        }
}

}  // namespace
}  // namespace si
