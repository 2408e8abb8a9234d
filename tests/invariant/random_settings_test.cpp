// Tests random settings: all numbers are finite, the driver reports no message, visibility lies within 0 to 1, and
// shadows make nothing brighter. docs/lab/property-runs.md describes longer runs.
#include "tests/support/random_settings.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <memory>

#include "app/context/headless_context.h"
#include "app/session/presets.h"
#include "app/session/session.h"
#include "renderer/base/error.h"
#include "renderer/measure/measured_error.h"
#include "renderer/render/renderer.h"
#include "renderer/settings/param.h"
#include "tests/support/environment_number.h"
#include "tests/support/requested_driver.h"
#include "tests/support/sets.h"
#include "tests/support/traits.h"

namespace si::test {
namespace {

constexpr unsigned kParts = 12;  ///< parts of the run, one test each
constexpr unsigned kUsualSeeds = 300, kUsualSeedsAProgram = 12;
constexpr unsigned kSeedsPerRenderer = 150;  ///< limit of programs in memory
constexpr int kPixels = 64;                  ///< side of the picture
constexpr int kRounding = 1;                 ///< steps of 255 between two programs' roundings of a colour
constexpr int kMaxReducedFailures = 3;       ///< reduced failures per part

/// Fault of a case; empty: none.
struct Verdict {
    std::string kind, text;
    bool good() const { return kind.empty(); }
};

class RandomSettings : public testing::Test {
protected:
    HeadlessContext context;
    std::unique_ptr<Renderer> renderer = std::make_unique<Renderer>();

    void SetUp() override { expect_requested_driver(); }

    FrameResult draw(const Scene& scene, const Settings& s, bool health) {
        FrameRequest request{.width = kPixels, .height = kPixels, .outputs = {.overlay = health, .health = health}};
        ReferenceCache references;
        trace_sources(*renderer, scene, s, request, references);
        return renderer->render(scene, s, request);
    }

    Verdict check(const RandomCase& of) {
        const Scene& scene = small_scene(of.scene);
        try {
            const FrameResult frame = draw(scene, of.settings, true);
            const auto health = renderer->numeric_health(frame);
            if (!health->sound()) return {"number", health_text(*health)};
            // The picture alone is compared; other overlays and panes would hide it.
            Settings plain = of.settings;
            plain.view.overlay = 0;
            plain.view.panes = Panes::One;
            plain.view.slabs = Slabs::None;
            const FrameResult shadowed = plain == of.settings ? frame : draw(scene, plain, true);
            const ByteImage a = renderer->read_colour(shadowed.colour);
            for (int i = 0; i < kMaxLights; ++i) {
                set_setting(plain, fmt::format("light.{}.source", i), "none");
                plain.lights[std::size_t(i)].contact = 0;
            }
            const FrameResult lit = draw(scene, plain, true);
            const ByteImage b = renderer->read_colour(lit.colour);
            // A camera that looks through a light follows the light's fit, which may not exist.
            if (lit.camera == shadowed.camera)
                if (Verdict v = compare(a, b); !v.good()) return v;
        } catch (const Error& e) {
            // An error must be a sentence that names the setting.
            const bool refused = std::string_view(e.what()).find("light_map.resolution") != std::string_view::npos;
            if (!refused) return {"error", e.what()};
        } catch (const std::exception& e) {
            return {"error", e.what()};
        }
        if (const auto messages = renderer->take_gl_messages(); !messages.empty()) return {"driver", messages[0]};
        return {};
    }

    static Verdict compare(const ByteImage& shadowed, const ByteImage& lit) {
        for (std::size_t i = 0; i < lit.data.size(); ++i)
            if (i % 4 != 3 && shadowed.data[i] > lit.data[i] + kRounding)
                return {"brighter", fmt::format("pixel {}, {} is {} of 255 in shadow, and {} without", i / 4 % kPixels,
                                                i / 4 / kPixels, shadowed.data[i], lit.data[i])};
        return {};
    }

    /// Resets settings that do not matter, row by row.
    RandomCase shrunk(RandomCase of, const std::string& kind) {
        for (int round = 0; round < 2; ++round)
            for (const SettingRef& ref : changed_settings(of.settings)) {
                RandomCase less = of;
                set_value(less.settings, ref, default_value(ref));
                if (check(less).kind == kind) of = std::move(less);
            }
        return of;
    }

    /// Writes the preset that shows the fault. @returns how to open it
    static std::string keep(const RandomCase& of, unsigned seed, const Verdict& verdict) {
        const auto folder = std::filesystem::path(SI_TEST_OUTPUT_DIR) / "random-settings";
        std::filesystem::create_directories(folder);
        const auto file = folder / fmt::format("seed-{}.json", seed);
        save_preset({.title = fmt::format("Random settings {}", seed),
                     .about = verdict.text,
                     .scene = of.scene,
                     .settings = of.settings},
                    file);
        return fmt::format("{} render {} --preset {} -o seed-{}.png --size {}x{} --check-numeric{}", SI_PROGRAM,
                           of.scene, file.string(), seed, kPixels, kPixels,
                           verdict.kind == "brighter" ? "   (and the same with --set light.source=none)" : "");
    }
};

/// Reduced settings of faults that earlier runs found.
SI_TEST_IS(Later, RandomSettings, EarlierFaultsStayFixed);
TEST_F(RandomSettings, EarlierFaultsStayFixed) {
    struct Found {
        const char* scene;
        Sets sets;
    };
    const Found all[] = {
        // Triangles seen edge-on wrote depths far outside their range.
        {"figures", {"map.format=colour", "light.azimuth=270", "light.elevation=14.899059362498523"}},
        {"figures",
         {"map.format=colour", "light.azimuth=-90", "light.elevation=5.392082575150003", "light.fit=scene",
          "map.resolution=512"}},
        // At this distance near and far were one number to shaders.
        {"teapot", {"light.target_z=62172591.68624878", "map.resolution=64"}},
        {"teapot", {"light.target_x=84523618.22128296", "light.fit=lispsm", "map.resolution=64"}},
        // Shares of a blur's averages were flushed to zero.
        {"figures", {"filter.kernel=evsm4", "filter.exponent=76", "map.resolution=512"}},
        {"figures",
         {"filter.kernel=esm", "filter.exponent=88", "filter.blur=8", "filter.blur_shape=gaussian",
          "map.resolution=256"}},
        // With near a small share of far, rounding at the far plane moved depths out of their range.
        {"figures", {"filter.kernel=evsm2", "light.projection=perspective", "light.stretch=1e5", "map.resolution=256"}},
    };
    for (const Found& found : all) {
        RandomCase of{.scene = found.scene, .settings = {}};
        set_all(of.settings, found.sets);
        const Verdict verdict = check(of);
        EXPECT_TRUE(verdict.good()) << found.scene << " " << found.sets[0].first << ": " << verdict.text;
    }
    // In a depth buffer they were at the near plane.
    Settings s = settings_with({}, {"light.azimuth=270", "light.elevation=14.899059362498523"});
    FrameRequest request{.width = kPixels, .height = kPixels, .outputs = {.shadow_map = true}};
    const FloatImage map = renderer->read_shadow_map(renderer->render(small_scene("figures"), s, request), 0, 0);
    EXPECT_GT(*std::min_element(map.data.begin(), map.data.end()), 0);
}

class RandomSeeds : public RandomSettings, public testing::WithParamInterface<unsigned> {};

SI_TEST_IS(Later, RandomSeeds, GiveFinitePicturesAndNoBrighterShadows);
TEST_P(RandomSeeds, GiveFinitePicturesAndNoBrighterShadows) {
    const unsigned first = environment_number("SI_RANDOM_FIRST", 0),
                   seeds = environment_number("SI_RANDOM_SEEDS", kUsualSeeds);
    // Parts are whole groups that share programs. Without a requested number of seeds each group is drawn in part, for
    // more variety.
    const unsigned each = std::getenv("SI_RANDOM_SEEDS") ? kSeedsPerProgram : kUsualSeedsAProgram;
    const unsigned groups = (seeds + each - 1) / each;
    int failures = 0;
    const unsigned from = groups * GetParam() / kParts * each;
    const unsigned to = std::min(groups * (GetParam() + 1) / kParts * each, seeds);
    for (unsigned i = from; i < to; ++i) {
        const unsigned seed = first + i / each * kSeedsPerProgram + i % each;
        if (i > from && seed % kSeedsPerRenderer == 0) {
            renderer.reset();
            renderer = std::make_unique<Renderer>();
        }
        const RandomCase of = random_case(seed);
        const Verdict verdict = check(of);
        if (verdict.good()) continue;
        renderer->take_gl_messages();
        if (++failures > kMaxReducedFailures) {
            ADD_FAILURE() << "seed " << seed << ": " << verdict.kind << ": " << verdict.text;
            continue;
        }
        const RandomCase least = shrunk(of, verdict.kind);
        std::string settings;
        for (const SettingRef& ref : changed_settings(least.settings))
            settings +=
                fmt::format(" --set {}={}", setting_key(ref), value_text(*ref.param, get_value(least.settings, ref)));
        ADD_FAILURE() << "seed " << seed << ": " << verdict.kind << ": " << check(least).text << "\nscene "
                      << least.scene << settings << "\n"
                      << keep(least, seed, verdict);
        renderer->take_gl_messages();
    }
}

INSTANTIATE_TEST_SUITE_P(Part, RandomSeeds, testing::Range(0u, kParts));

}  // namespace
}  // namespace si::test
