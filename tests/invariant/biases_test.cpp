// Tests invariants of every bias: a loop over the rows of the bias table and their settings, under every light, with
// alternating kernels, formats, fits and positions.
#include "renderer/settings/biases.h"

#include <algorithm>
#include <cmath>

#include "renderer/bias/account.h"
#include "renderer/inspect/probe.h"
#include "renderer/scenes/shapes.h"
#include "renderer/settings/filters.h"
#include "renderer/settings/fits.h"
#include "renderer/settings/param.h"
#include "renderer/view/lights/kernel_reach.h"
#include "tests/support/hard_case.h"
#include "tests/support/sets.h"

namespace si::test {
namespace {

/// Bias with the setting that raises it, and the conditions of its test.
struct BiasCase {
    std::string bias, key;
    LightType light;
    MapFormat format;
    bool reversed;
    std::string kernel, fit;
    Place place;
};

/// Returns settings with only this kind of bias.
Settings unbiased(const Bias& row) {
    Settings s = hard_settings();
    s.bias = no_bias();
    set_all(s, {"bias.unit=texels", "bias.plane_clamp=0"});
    if (row.stage == BiasStage::Compare) set_setting(s, "bias.kind", row.key);
    return s;
}

/// Returns the settings that raise a row's bias: its own, and bias.constant for rows that compare.
std::vector<std::string> amounts_of(const Bias& row) {
    std::vector<std::string> keys(row.settings.begin(), row.settings.end());
    if (row.stage == BiasStage::Compare) keys.emplace_back("bias.constant");
    const BiasInput sample{
        .curve = {.near = 1, .far = 9}, .texel_m = 0.1, .n_dot_l = 0.5, .per_texel = {0.01, 0.02}, .quantum = 1e-5};
    std::erase_if(keys, [&](const std::string& key) {
        Settings s = unbiased(row);
        const double none = row.amount(s.bias, sample);
        const SettingRef ref = *find_setting(key);
        set_value(s, ref, std::min(2.0, ref.param->max));
        return !(row.amount(s.bias, sample) > none);
    });
    return keys;
}

/// Returns the settings of a row; for a row without numbers only its choice.
std::vector<std::string> amounts_to_raise(const Bias& row) {
    std::vector<std::string> keys = amounts_of(row);
    return keys.empty() ? std::vector<std::string>{"bias.kind"} : keys;
}

std::vector<BiasCase> bias_cases() {
    std::vector<BiasCase> out;
    std::size_t turn = 0, format = 0;
    for (const Bias& row : biases())
        for (const std::string& key : amounts_to_raise(row))
            for (const LightType light : kLightTypes) {
                const std::size_t k = turn++ * 5 % filters().size();
                for (const Place& place : kPlaces) {
                    out.push_back({std::string(row.key), key, light, MapFormat(format % 4), format % 3 == 0,
                                   std::string(filters()[k].key), std::string(fits()[format % fits().size()].key),
                                   place});
                    ++format;
                }
            }
    return out;
}

std::string bias_name(const testing::TestParamInfo<BiasCase>& info) {
    const BiasCase& c = info.param;
    return identifier(c.bias + "_by_" + c.key.substr(5) + "_" + light_name(c.light) + "_" + format_name(c.format) +
                      "_" + c.kernel + "_" + c.fit + "_" + std::to_string(info.index));
}

class EachBias : public testing::TestWithParam<BiasCase> {
protected:
    const BiasCase& c = GetParam();
    const Bias& row = *std::ranges::find(biases(), c.bias, &Bias::key);

    /// Sets the setting to `value`, and the row's other settings to a tenth of it: a slope alone is zero under a
    /// vertical light.
    void set_amount(Settings& s, double value) const {
        for (const std::string& key : amounts_of(row)) {
            const SettingRef ref = *find_setting(key);
            set_value(s, ref, std::min(key == c.key ? value : 0.1 * value, ref.param->max));
        }
    }
    Settings settings(double value) const {
        Settings s = unbiased(row);
        s.map.resolution = 256;
        s.map.format = c.format;
        s.map.reversed_z = c.reversed;
        set_setting(s, "filter.kernel", c.kernel);
        place_light(s, c.light, c.place);
        s.lights[0].size = c.light == LightType::Directional ? 0.5 : 0.05;
        set_setting(s, "light.fit", c.fit);
        s.camera.elevation = 35;  // sees below the cover
        set_amount(s, value);
        return s;
    }

    BiasBreakdown account(const Hit& hit, const FrameResult& frame, const Settings& s) const {
        return breakdown_at(frame, s, hard_renderer().driver(), hit.position, hit.normal);
    }
    /// Counts of lit pixels of planes turned upwards: those that the settings clear by their account, and those that
    /// rise across the map by much more than rounding.
    struct ClearedPixels {
        std::vector<std::size_t> cleared;
        std::size_t lit = 0, sloped = 0;
    };
    ClearedPixels cleared_pixels(const ReferenceImage& reference, const FrameResult& frame, const Settings& s,
                                 int step) const {
        ClearedPixels out;
        for (std::size_t i = 0; i < reference.states.size(); i += std::size_t(step)) {
            if (reference.states[i] != ReferenceState::Lit || reference.hits[i]->normal.y < 0.5) continue;
            // Moments over the floor's rim mix two surfaces, the floor and empty space: they bound, but do not clear.
            const glm::dvec3 on_floor = reference.hits[i]->position - c.place.at;
            if (filter_of(s).samples() == Samples::Moments && on_floor.y < 1 &&
                std::max(std::abs(on_floor.x), std::abs(on_floor.z)) > 4.4)
                continue;
            ++out.lit;
            const BiasBreakdown a = account(*reference.hits[i], frame, s);
            out.sloped += a.least.kernel > 4 * (a.least.quantum + a.least.rounding);
            if (a.equivalent_depth() >= a.least.total()) out.cleared.push_back(i);
        }
        return out;
    }
};

/// Returns the least value that clears three of four lit pixels, by the theory.
template <class Share>
double least_value(Share share_cleared) {
    constexpr double kEnough = 0.75, most = 1e8;  // a tenth of the maximum of bias.raster_units
    double lo = 0, hi = 1e-3;
    if (share_cleared(0) >= kEnough) return 0;
    while (hi < most && share_cleared(hi) < kEnough) {
        lo = hi;
        hi *= 4;
    }
    hi = std::min(hi, most);
    for (int i = 0; i < 12; ++i) {
        const double middle = 0.5 * (lo + hi);
        (share_cleared(middle) >= kEnough ? hi : lo) = middle;
    }
    return hi;
}

TEST_P(EachBias, LightsAPlaneByTheLeastAmountAndKeepsCoveredFloorsDark) {
    const Scene scene = floor_under_sheet(c.place);
    Settings s = settings(0);
    Settings bare = s;
    if (row.gives_needed_bias) set_setting(bare, "bias.kind", "constant");
    const Shot none = draw_shot(scene, bare);
    const double reach = kernel_reach_in_light(s, none.light(), none.frame.map_resolution).edge + 1;
    const auto reference_within = [&](double texels) { return trace_reference(RayReference(scene), none, texels); };
    ReferenceImage reference = reference_within(reach);
    const double value = least_value([&](double v) {
        set_amount(s, v);
        const ClearedPixels t = cleared_pixels(reference, none.frame, s, 13);
        return double(t.cleared.size()) / double(std::max<std::size_t>(t.lit, 1));
    });
    if (row.stage == BiasStage::LookUp) reference = reference_within(reach + value);  // edges move by as much
    set_amount(s, value * 1.001);
    const Shot least = draw_shot(scene, s);
    const ClearedPixels t = cleared_pixels(reference, least.frame, s, 1);
    const Tolerance& tolerance = filter_of(s).tolerance;
    ASSERT_GT(t.lit, 2000u);
    EXPECT_GT(double(t.cleared.size()), 0.7 * double(t.lit)) << "at " << value;
    std::size_t acne = 0, without = 0, dark = 0, leaks = 0;
    float darkest = 1;
    for (const std::size_t i : t.cleared) {
        darkest = std::min(darkest, least.visibility.data[i]);
        acne += least.visibility.data[i] < 1 - tolerance.lit;
        without += none.visibility.data[i] < 1 - tolerance.lit;
    }
    for (std::size_t i = 0; i < reference.states.size(); ++i) {
        if (reference.states[i] != ReferenceState::Shadow || reference.hits[i]->normal.y < 0.5) continue;
        const BiasBreakdown a = account(*reference.hits[i], least.frame, s);
        if (a.amount(a.depth_shift).metres > 2) continue;  // the cover is 2.25 m above
        ++dark, leaks += least.visibility.data[i] > tolerance.dark;
    }
    EXPECT_EQ(acne, 0u) << "of " << t.cleared.size() << " at " << value << ", down to " << darkest;
    EXPECT_EQ(leaks, 0u) << "of " << dark << " at " << value;
    EXPECT_GT(dark, 100u);
    // A rising plane that nothing else clears shadows itself without bias; otherwise the test would prove little.
    if (filter_of(s).samples() == Samples::Depth && t.sloped > t.lit / 2) {
        EXPECT_GT(without, 20u) << value;
    }
}

TEST_P(EachBias, ChangesNothingWhereNothingCasts) {
    Scene scene = floor_and_box(10, {1.5, 1, 2});
    move_scene(scene, c.place.at);
    for (const double value : {0.0, 3.0}) {
        Settings s = settings(value);
        s.objects["floor"] = s.objects["box"] = {.cast = false};
        for (const float v : draw_shot(scene, s, 64, 48).visibility.data) ASSERT_TRUE(v == 1 || v == 0) << v;
        // The floor does not cast: points away from the box's shadow read an empty map.
        s.objects["box"].cast = true;
        const Shot shot = draw_shot(scene, s, 64, 48);
        const double reach = kernel_reach_in_light(s, shot.light(), shot.frame.map_resolution).edge + 5;
        const ReferenceImage reference = trace_reference(RayReference(scene), shot, reach);
        int lit = 0;
        for (std::size_t i = 0; i < reference.states.size(); ++i) {
            if (reference.states[i] != ReferenceState::Lit ||
                std::abs(reference.hits[i]->position.y - c.place.at.y) > 1e-3)
                continue;
            ++lit;
            ASSERT_GE(shot.visibility.data[i], 1 - filter_of(s).tolerance.lit) << value;
        }
        EXPECT_GT(lit, 300);
    }
}

INSTANTIATE_TEST_SUITE_P(All, EachBias, testing::ValuesIn(bias_cases()), bias_name);

}  // namespace
}  // namespace si::test
