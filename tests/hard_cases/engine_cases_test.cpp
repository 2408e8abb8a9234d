// Tests hard cases 47 to 49: numbers of engines at grazing angles, after the map was fitted again, and for cascades
// that share a map. Each profile with conversions is tested.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "renderer/profiles/engine_profile.h"
#include "renderer/view/fits/engine_facts.h"
#include "tests/support/hard_view.h"
#include "tests/support/stability.h"
#include "tests/support/tilted_plane.h"

namespace si::test {
namespace {

constexpr int kEngineWidth = 160, kEngineHeight = 120;

/// Tilted plane under the settings that a profile fixes, drawn without further bias.
struct EnginePlane {
    const EngineProfile& profile;
    TiltedPlane plane;
    Settings settings;
    Shot bare;
    MapFacts facts;

    EnginePlane(const EngineProfile& of, double theta_deg, double around_deg, const Sets& sets = {})
        : profile(of), plane(LightType::Directional, theta_deg, around_deg), settings(plane.settings) {
        set_all(settings, sets);
        apply_forced_settings(profile, settings);
        bare = draw_shot(plane.scene, settings, kEngineWidth, kEngineHeight);
        facts = map_facts(&bare.light(), settings, bare.frame.map_size);
        facts.angle_deg = theta_deg;
    }

    /// Returns the least bias of the seen part of the plane, texels.
    double needed_texels() const {
        Settings none = settings;
        none.bias = no_bias();
        double most = 0;
        for (const auto& [x, y, origin, dir] : pixel_rays(bare)) {
            const glm::dvec3 point =
                origin + dir * (glm::dot(plane.at - origin, plane.normal) / glm::dot(dir, plane.normal));
            const BiasBreakdown a = breakdown_at(bare.frame, none, hard_renderer().driver(), point, plane.normal);
            most = std::max(most, a.amount(a.least.total()).texels);
        }
        return most;
    }

    /// Converts a bias to the engine's numbers for some facts of a map.
    WrittenValues written(double constant_texels, double normal_texels, const MapFacts& of) const {
        Settings s = settings;
        s.bias.constant = constant_texels;
        s.bias.normal = normal_texels;
        return write_engine_values(profile, s, of);
    }

    /// Returns the share of the plane's pixels that are dark under an engine's numbers, read for the drawn map.
    double dark_share(const WrittenValues& numbers) const {
        Settings s = settings;
        for (const ConvertedSetting& setting : read_engine_values(profile, numbers.values(), facts))
            if (setting.key.starts_with("bias.")) set_setting(s, setting.key, setting.value);
        const Shot shot = draw_shot(plane.scene, s, kEngineWidth, kEngineHeight);
        const auto dark = std::ranges::count_if(shot.visibility.data, [](float v) { return v < 1 - 1e-3f; });
        return double(dark) / double(shot.visibility.data.size());
    }
};

/// Returns true when the engine accepts no number that is large enough, and the conversion says so.
bool is_out_of_range(const WrittenValues& numbers) {
    return std::ranges::any_of(numbers.parameters, [](const ConvertedParameter& p) {
        return p.parameter->is_bias && p.note.find("outside of the engine's range") != std::string::npos;
    });
}

/// Returns the factor of a bias that a plane tilted along the diagonal of the map needs under a polygon offset, which
/// counts the larger of both slopes alone.
double diagonal_factor(const EngineProfile& profile, const WrittenValues& numbers, double around_deg) {
    const bool by_offset = std::ranges::any_of(numbers.parameters, [](const ConvertedParameter& p) {
        return p.parameter->is_bias && p.texels != 0 && p.parameter->setting.starts_with("bias.raster");
    });
    return around_deg != 0 && (by_offset || profile.hidden_texels) ? std::numbers::sqrt2 : 1;
}

class HardCaseOfEngines : public testing::TestWithParam<std::string_view> {};

std::vector<std::string_view> converted_engines() {
    std::vector<std::string_view> names;
    for (const EngineProfile& profile : engine_profiles())
        if (profile.write_bias) names.push_back(profile.name);
    return names;
}

std::string engine_test_name(const testing::TestParamInfo<std::string_view>& named) {
    std::string name(named.param);
    std::ranges::replace(name, '-', '_');
    return name;
}

class HardCase47 : public HardCaseOfEngines {};

TEST_P(HardCase47, AGrazedPlaneNeedsTheNumberOfItsAngle) {
    const EngineProfile& profile = engine_profile(GetParam());
    for (const double around : {0.0, 45.0}) {
        SCOPED_TRACE(around);
        const EnginePlane grazed(profile, 89, around), steep(profile, 45, around);
        const double needed = grazed.needed_texels(), needed_at_45 = steep.needed_texels();
        EXPECT_GT(needed, 20 * needed_at_45);
        for (const bool by_normal : {false, true}) {
            SCOPED_TRACE(by_normal ? "normal offset" : "constant");
            const auto form = std::size_t(grazed.settings.bias.normal_by);
            const double worth = offset_forms()[form].worth(glm::radians(89.0));
            const auto numbers_for = [&](double texels) {
                return grazed.written(by_normal ? 0 : texels, by_normal ? texels / worth : 0, grazed.facts);
            };
            const double factor = diagonal_factor(profile, numbers_for(needed), around);
            const WrittenValues numbers = numbers_for(factor * needed);
            EXPECT_TRUE(std::isfinite(numbers.given_texels));
            if (numbers.given_texels < factor * needed * (1 - 1e-9)) {
                EXPECT_TRUE(is_out_of_range(numbers)) << numbers.given_texels << " of " << factor * needed;
                continue;
            }
            expect_within_limit(47, grazed.dark_share(numbers));
        }
        // A number that grows with the angle suits both; the others do not.
        const WrittenValues at_45 = steep.written(needed_at_45, 0, steep.facts);
        const bool constant = std::ranges::all_of(at_45.parameters, [](const ConvertedParameter& p) {
            return !p.parameter->is_bias || p.texels == 0 || p.parameter->setting == "bias.constant";
        });
        if (constant && at_45.hidden_texels == 0) expect_fault(47, grazed.dark_share(at_45));
    }
}

INSTANTIATE_TEST_SUITE_P(All, HardCase47, testing::ValuesIn(converted_engines()), engine_test_name);

class HardCase48 : public HardCaseOfEngines {};

TEST_P(HardCase48, NumbersByDepthRangeFollowTheFit) {
    const EngineProfile& profile = engine_profile(GetParam());
    const EnginePlane plane(profile, 60, 0);
    const double needed = plane.needed_texels();
    const WrittenValues present = plane.written(needed, 0, plane.facts);
    EXPECT_GE(present.given_texels, needed * (1 - 1e-9));
    expect_within_limit(48, plane.dark_share(present));
    MapFacts longer = plane.facts;
    longer.depth_m *= 10;
    const WrittenValues before = plane.written(needed, 0, longer);
    // Numbers of a constant in shares of the range are a tenth for ten times the range; others are equal.
    const ConvertedParameter* by_range = nullptr;
    for (const ConvertedParameter& p : present.parameters)
        if (p.parameter->is_bias && p.value != 0 && before.find(p.parameter->key) &&
            std::abs(before.find(p.parameter->key)->value / p.value - 0.1) < 1e-9)
            by_range = &p;
    if (by_range) expect_fault(48, plane.dark_share(before));
}

INSTANTIATE_TEST_SUITE_P(All, HardCase48, testing::ValuesIn(converted_engines()), engine_test_name);

class HardCase49 : public HardCaseOfEngines {};

TEST_P(HardCase49, CascadesThatShareAMapHaveHalfOfItsTexels) {
    const EngineProfile& profile = engine_profile(GetParam());
    const EnginePlane plane(profile, 60, 0,
                            {"light.cascades=2", "light.fit=stabilised", "light.split=manual", "light.split_1=0.999"});
    EXPECT_EQ(plane.facts.cascades, 2);
    const double needed = plane.needed_texels();
    const WrittenValues half = plane.written(needed, 0, plane.facts);
    expect_within_limit(49, plane.dark_share(half));
    for (const ConvertedParameter& p : half.parameters)
        if (p.parameter->setting == "map.resolution") {
            EXPECT_EQ(p.value, (profile.cascades_share_map ? 2 : 1) * plane.facts.texels) << "the map of all cascades";
        }
    if (!profile.cascades_share_map) return;
    MapFacts whole = plane.facts;
    whole.texels *= 2;
    const WrittenValues of_whole = plane.written(needed, 0, whole);
    const bool in_metres = std::ranges::any_of(half.parameters, [&](const ConvertedParameter& p) {
        const ConvertedParameter* const other = of_whole.find(p.parameter->key);
        return p.parameter->is_bias && other && std::abs(other->value - p.value) > 0.1 * std::abs(p.value);
    });
    if (in_metres) expect_fault(49, plane.dark_share(of_whole));
}

INSTANTIATE_TEST_SUITE_P(All, HardCase49, testing::ValuesIn(converted_engines()), engine_test_name);

}  // namespace
}  // namespace si::test
