// Tests what fixes are for: of random wrong pixels, those that some change of an independent list puts right get a fix,
// and each fix, applied as it is printed, puts its pixel right and makes nothing worse.
#include <algorithm>
#include <map>
#include <random>

#include "renderer/advise/fixes.h"
#include "renderer/measure/axes.h"
#include "renderer/reference/artefact_picture.h"
#include "renderer/settings/biases.h"
#include "renderer/settings/filters.h"
#include "renderer/settings/fits.h"
#include "tests/gl/frame_fixture.h"
#include "tests/support/combinations.h"
#include "tests/support/environment_number.h"
#include "tests/support/hard_case.h"
#include "tests/support/traits.h"

namespace si {
namespace {

constexpr std::size_t kPixels = 10;  ///< of each case

/// Frame with wrong pixels.
struct WrongFrame {
    const char* scene;
    Sets sets;
};

const std::vector<WrongFrame>& wrong_frames() {
    static const Sets kNoBias = {"bias.kind=constant", "bias.constant=0", "bias.normal=0"};
    static const auto with = [](Sets sets) {
        Sets all = kNoBias;
        all.insert(all.end(), sets.begin(), sets.end());
        return all;
    };
    static const std::vector<WrongFrame> kFrames = {
        {"boxes", with({"map.resolution=512"})},
        {"boxes", with({"map.resolution=512", "caster.cull=front", "filter.kernel=pcf3"})},
        {"boxes", {"map.resolution=256", "bias.kind=constant", "bias.constant=30", "bias.normal=0"}},
        {"boxes", {"map.resolution=512", "bias.kind=constant", "bias.normal=40"}},
        {"boxes", {"map.resolution=1024", "filter.kernel=vsm"}},
        {"boxes", {"light.type=spot", "map.resolution=512", "filter.kernel=pcf7"}},
        {"boxes", {"light.type=point", "map.resolution=256", "bias.kind=constant", "bias.constant=0.2"}},
        {"stage", with({"filter.kernel=pcf5"})},
        {"stage", {"map.resolution=512", "filter.kernel=hard"}},
        {"stage", {"bias.kind=constant", "bias.raster_slope=40", "bias.normal=0", "bias.constant=0"}},
        {"stage", {"light.elevation=12", "filter.kernel=gauss"}},
        {"stage", {"caster.cull=front", "light.azimuth=72"}},
        {"teapot", with({"map.resolution=256", "filter.kernel=pcf3"})},
        {"teapot", {"filter.kernel=esm", "map.resolution=512"}},
        {"teapot", {"light.0.contact=0.5", "map.resolution=512"}},
        {"figures", {"map.resolution=256", "filter.kernel=tent"}},
        {"figures", {"light.fit=manual", "light.extent=3", "map.resolution=512"}},
        {"landscape", {"light.fit=scene", "light.cascades=1", "map.resolution=512", "light.elevation=20"}},
        {"landscape", {"light.fit=stabilised", "light.cascades=4", "map.resolution=512", "light.elevation=10"}},
        {"relief", with({"map.format=d16", "map.resolution=512"})},
    };
    return kFrames;
}

/// Lists single changes without the knowledge of the program's own list: every row of the bias table on a grid of
/// strengths, every kernel, resolution, culling side and fit.
std::vector<Settings> independent_changes(const Settings& base) {
    std::vector<Settings> out;
    const auto add = [&](const Sets& sets) { out.push_back(settings_with(base, sets)); };
    const Sets none = {"bias.normal=0", "bias.constant=0", "bias.slope=0", "bias.raster_slope=0",
                       "bias.raster_units=0"};
    const auto bias = [&](Sets sets) {
        sets.insert(sets.begin(), none.begin(), none.end());
        add(sets);
    };
    for (const Choice& kind : bias_choices()) bias({"bias.kind=" + std::string(kind.key)});
    for (const double strength : {0.05, 0.1, 0.25, 0.5, 1.0, 2.0, 4.0, 8.0, 16.0, 32.0, 64.0, 128.0}) {
        const std::string text = std::to_string(strength);
        bias({"bias.kind=constant", "bias.constant=" + text});
        bias({"bias.kind=slope", "bias.constant=0.1", "bias.slope=" + text});
        bias({"bias.kind=constant", "bias.constant=0.1", "bias.normal=" + std::to_string(std::min(strength, 99.0))});
        bias({"bias.kind=constant", "bias.raster_slope=" + std::to_string(std::min(strength, 99.0))});
    }
    for (const std::string_view kernel : sweep_kernels()) add({"filter.kernel=" + std::string(kernel)});
    for (const double factor : {0.5, 2.0, 4.0})
        add({"map.resolution=" + std::to_string(int(base.map.resolution * factor))});
    for (const char* side : {"none", "front", "back"}) add({"caster.cull=" + std::string(side)});
    add({"light.near_far=fitted"});
    for (const FitRow& fit : fits())
        if (fit.key != "manual") add({"light.fit=" + std::string(fit.key)});
    return out;
}

/// Draws wrong pixels of a frame: one of each cause in turn, at random within a cause, until there are kPixels.
std::vector<std::size_t> random_wrong_pixels(const std::vector<ClassifiedPixel>& classified, unsigned seed) {
    std::map<Artefact, std::vector<std::size_t>> of_cause;
    for (std::size_t i = 0; i < classified.size(); ++i)
        if (classified[i].artefact != Artefact::None) of_cause[classified[i].artefact].push_back(i);
    std::mt19937 random(seed);
    std::vector<std::size_t> drawn;
    for (auto& [cause, pixels] : of_cause) std::ranges::shuffle(pixels, random);
    for (std::size_t turn = 0, before = kPixels; drawn.size() < kPixels && drawn.size() != before; ++turn) {
        before = drawn.size();
        for (const auto& [cause, pixels] : of_cause)
            if (turn < pixels.size() && drawn.size() < kPixels) drawn.push_back(pixels[turn]);
    }
    return drawn;
}

class FixPurposeTest : public FrameTest {
protected:
    static constexpr int kWidth = 240, kHeight = 135;
    ReferenceCache cache;
    std::vector<std::pair<Settings, MeasuredSettings>> known;
    TrialMeter meter;

    /// Makes a meter that measures each settings once and whose clock counts bytes, so that results do not depend on
    /// the machine.
    void use(const Scene& scene) {
        known.clear();
        meter.measure = [&, drawn = renderer_trial_meter({renderer, scene, kWidth, kHeight, cache},
                                                         {.reference = ReferenceOptions{}})](const Settings& s,
                                                                                             int light) {
            const auto at = std::ranges::find(known, s, &std::pair<Settings, MeasuredSettings>::first);
            if (at != known.end()) return at->second;
            return known.emplace_back(s, drawn.measure(s, light)).second;
        };
        meter.time = [&](const Settings& a, const Settings& b) {
            const auto work = [&](const Settings& s) { return 1e-6 * double(meter.measure(s, 0).work.bytes_touched); };
            return CostChange{work(b) - work(a), 1e-9};
        };
    }

    /// Returns why a change is no fix of a pixel by the definition of FixTable::rows; empty: it is one.
    std::string fault(const Settings& base, const Settings& with, std::size_t pixel) {
        const MeasuredSettings a = meter.measure(base, 0), b = meter.measure(with, 0);
        const ErrorMetrics &was = a.frame->metrics, &is = b.frame->metrics;
        const ClassifiedPixel& p = b.frame->classified[pixel];
        if (p.artefact != Artefact::None) return "wrong";
        if (std::abs(p.visibility - b.frame->traced.reference->visibility.data[pixel]) > 0.25) return "half wrong";
        if (wrong_pixels(is) > wrong_pixels(was)) return "more wrong pixels";
        if (is.mae > was.mae + 1e-12) return "more error";
        if (is.any_acne > was.any_acne + 1e-12) return "more acne";
        if (is.any_leak > was.any_leak + 1e-12) return "more leaks";
        if (b.work.map_bytes > 2 * a.work.map_bytes) return "more bytes";
        Settings unshadowed = base;
        unshadowed.lights[0].cast = false;
        if (meter.time(base, with).value > meter.time(unshadowed, base).value + 3e-9) return "more time";
        if (!(a.camera == b.camera)) return "another camera";
        if (with.lights[0].source != base.lights[0].source) return "another source";
        return {};
    }
};

SI_TESTS_ARE(DriverIndependent, FixPurposeTest);
SI_TEST_IS(Minutes, FixPurposeTest, APixelThatSomeChangePutsRightGetsAFixThatHolds);
TEST_F(FixPurposeTest, APixelThatSomeChangePutsRightGetsAFixThatHolds) {
    const unsigned seed = test::environment_number("SI_FIX_SEED", 1);
    const auto first = std::size_t(test::environment_number("SI_FIX_FIRST", 0));
    const auto last = std::min(std::size_t(test::environment_number("SI_FIX_LAST", 1000)), wrong_frames().size() - 1);
    std::size_t pixels = 0, curable = 0, fixed = 0;
    std::map<Artefact, std::size_t> causes;
    for (std::size_t n = first; n <= last; ++n) {
        const WrongFrame& frame = wrong_frames()[n];
        const Scene scene = load_scene(frame.scene);
        const Settings base = measured_settings(settings_for(scene, frame.sets));
        SCOPED_TRACE(testing::Message() << frame.scene << ", case " << n);
        use(scene);
        const MeasuredSettings before = meter.measure(base, 0);
        const std::vector<std::size_t> wrong = random_wrong_pixels(before.frame->classified, seed);
        EXPECT_FALSE(wrong.empty());
        const std::vector<Settings> changes = independent_changes(base);
        const FixFacts facts = fix_facts(*before.frame, base, renderer.driver());
        // The whole list follows where the short one has no fix, as in find_fixes().
        std::vector<Candidate> list = fix_candidates(base, facts, FixList::Short);
        const std::size_t shorter = list.size();
        std::ranges::move(fix_candidates(base, facts, FixList::Whole), std::back_inserter(list));
        for (const std::size_t pixel : wrong) {
            const glm::ivec2 at(int(pixel) % kWidth, int(pixel) / kWidth);
            SCOPED_TRACE(testing::Message() << "pixel " << at.x << "," << at.y << " seed " << seed);
            ++pixels;
            ++causes[before.frame->classified[pixel].artefact];
            const FixTable table = search_fixes(base, before, list, meter, {.pixel = at}, {}, {}, shorter);
            const Trial* const fix = table.fix();
            if (!fix) {
                const auto cures = [&](const Settings& s) { return fault(base, s, pixel).empty(); };
                const auto cure = std::ranges::find_if(changes, cures);
                if (cure == changes.end()) continue;
                ++curable;
                std::string text;
                for (const SettingRef& ref : differing_settings(base, *cure))
                    text += " " + setting_key(ref) + "=" + value_text(*ref.param, get_value(*cure, ref));
                std::printf("no fix: %s %d,%d:%s\n", frame.scene, at.x, at.y, text.c_str());
                continue;
            }
            ++curable;
            ++fixed;
            Settings with = base;
            for (const auto& [key, value] : fix->changes) set_setting(with, key, value);
            EXPECT_EQ(fault(base, measured_settings(with), pixel), "") << fix->candidate.name;
        }
        std::printf("case %zu (%s), %zu trials: of %zu pixels so far %zu can be put right, %zu have a fix\n", n,
                    frame.scene, known.size(), pixels, curable, fixed);
        std::fflush(stdout);
    }
    std::printf("%zu pixels of %zu causes: %zu can be put right, %zu have a fix\n", pixels, causes.size(), curable,
                fixed);
    for (const ArtefactStyle& style : artefact_styles())
        if (causes.contains(style.artefact))
            std::printf("  %zu of %s\n", causes[style.artefact], std::string(style.key).c_str());
    if (first == 0 && last + 1 == wrong_frames().size()) {
        constexpr std::size_t kLeastOfCause = 15;
        EXPECT_GE(std::ranges::count_if(causes, [](const auto& c) { return c.second >= kLeastOfCause; }), 8);
        EXPECT_GE(pixels, 19 * kPixels);
    }
    EXPECT_GE(double(fixed), 0.9 * double(curable));
}

}  // namespace
}  // namespace si
