// Tests that effects report what a frame did: making the change that a reason names must change the effect's state.
#include "renderer/inspect/effects.h"

#include <algorithm>
#include <cctype>

#include "tests/gl/frame_fixture.h"
#include "tests/support/traits.h"

namespace si {
namespace {

class EffectsTest : public FrameTest {
protected:
    std::vector<Effect> effects(const Scene& scene, const Sets& sets, FrameRequest request = small_request()) {
        const Settings s = settings_for(scene, sets);
        const FrameResult frame = renderer.render(scene, s, request);
        last = frame;
        return frame_effects(scene, s, frame, request.forced);
    }
    FrameResult last;
};

bool has_effect(const std::vector<Effect>& effects, std::string_view name) {
    return std::ranges::find(effects, name, &Effect::name) != effects.end();
}

EffectState state_of_effect(const std::vector<Effect>& effects, std::string_view name) {
    return effect_named(effects, name).state;
}

std::string reason_of(const std::vector<Effect>& effects, std::string_view name) {
    return effect_named(effects, name).reason;
}

/// Returns the clause of an effect that is missing or is no written sentence; empty: none.
std::string fault_of(const Effect& effect) {
    const std::string& text = effect.reason;
    if (text.empty()) return "no reason";
    if (text.back() != '.') return "no full stop";
    const std::string first = text.substr(0, text.find(' '));
    const bool key = first.find('.') != std::string::npos;
    if (!key && std::islower(static_cast<unsigned char>(text[0]))) return "no capital letter";
    if (text.find("  ") != std::string::npos || text.find("..") != std::string::npos) return "two spaces or stops";
    return {};
}

const std::vector<Sets>& varied() {
    static const std::vector<Sets> all = {
        {},
        {{"light.type", "point"}, {"light.contact", "0.4"}},
        {{"light.cascades", "4"}, {"filter.kernel", "pcss"}, {"light.depth_bounds", "sdsm"}},
        {{"filter.kernel", "vsm"}, {"filter.mips", "true"}, {"map.samples", "4"}},
        {{"filter.kernel", "savsm"}, {"map.blur_texels", "2"}},
        {{"map.virtual", "true"}},
        {{"light.source", "volumes-zfail"}, {"view.overlay", "visibility"}},
        {{"light.source", "blob"}, {"bias.raster_slope", "1"}},
        {{"light.cast", "false"}, {"shading.separate_visibility", "true"}},
        {{"light.source", "none"}, {"view.slabs", "both"}},
        {{"view.panes", "two"}, {"view.overlay_2", "n-dot-l"}, {"view.slabs", "both"}},
    };
    return all;
}

SI_TEST_IS(DriverIndependent, EffectsTest, EveryPassIsAnEffectAndEveryReasonASentence);
SI_TEST_IS(Repeated, EffectsTest, EveryPassIsAnEffectAndEveryReasonASentence);
SI_TEST_IS(Slow, EffectsTest, EveryPassIsAnEffectAndEveryReasonASentence);
TEST_F(EffectsTest, EveryPassIsAnEffectAndEveryReasonASentence) {
    FrameRequest request = small_request();
    request.outputs.shadow_map = request.outputs.surface_ids = request.outputs.texels_read = true;
    for (const char* name : {"stage", "boxes", "plane", "figures"}) {
        const Scene scene = load_scene(name);
        for (const Sets& sets : varied()) {
            const std::vector<Effect> all = effects(scene, sets, request);
            for (const PassInfo& pass : last.passes) {
                const Effect own = effect_named(all, pass.name);
                EXPECT_EQ(own.pass, pass.name);
                EXPECT_FALSE(own.part) << pass.name;
                EXPECT_EQ(own.state == EffectState::Drawn, pass.state == PassState::Drawn) << pass.name;
                EXPECT_EQ(own.state == EffectState::Cached, pass.state == PassState::Cached) << pass.name;
            }
            for (const Effect& e : all) EXPECT_EQ(fault_of(e), "") << e.name << ": " << e.reason;
            for (std::size_t i = 0; i < all.size(); ++i)
                for (std::size_t j = i + 1; j < all.size(); ++j) EXPECT_NE(all[i].name, all[j].name);
        }
    }
}

/// Effect that the settings do not need, the text that its reason must name, and the change that it requests.
struct ReasonedChange {
    const char* effect;
    Sets before;
    const char* reason;
    Sets after;
};

TEST_F(EffectsTest, TheChangeThatAReasonNamesDrawsTheEffect) {
    const ReasonedChange all[] = {
        {"shadow map 0 (directional)", {{"light.cast", "false"}}, "light.cast", {}},
        {"shadow map 0 (directional)", {{"light.source", "none"}}, "light.source", {{"light.source", "map"}}},
        {"contact shadows of light 0", {}, "light.contact", {{"light.contact", "0.5"}}},
        {"depth blur", {}, "map.blur_texels", {{"map.blur_texels", "2"}}},
        {"moments", {}, "filter.kernel", {{"filter.kernel", "vsm"}}},
        {"blur of the moments",
         {{"filter.kernel", "vsm"}, {"filter.blur", "0"}},
         "filter.blur",
         {{"filter.kernel", "vsm"}, {"filter.blur", "3"}}},
        {"several samples a texel",
         {{"filter.kernel", "vsm"}},
         "map.samples",
         {{"filter.kernel", "vsm"}, {"map.samples", "4"}}},
        {"blocker search", {}, "Kernel", {{"filter.kernel", "pcss"}}},
        {"light's size", {}, "Kernel", {{"filter.kernel", "pcss"}}},
        {"blocker search",
         {{"filter.kernel", "pcss"}, {"light.size", "0"}},
         "light.size is 0",
         {{"filter.kernel", "pcss"}, {"light.size", "1"}}},
        {"blocker search",
         {{"filter.kernel", "dpcf"}, {"light.size", "0"}},
         "light.size is 0",
         {{"filter.kernel", "dpcf"}, {"light.size", "1"}}},
        {"light's size",
         {{"filter.kernel", "smrt"}, {"light.size", "0"}},
         "light.size is 0",
         {{"filter.kernel", "smrt"}, {"light.size", "1"}}},
        {"look-ups of light 0", {{"camera.source", "manual"}, {"camera.target_x", "500"}}, "camera sees nothing", {}},
        {"look-ups of light 0",
         {{"camera.source", "manual"}, {"camera.target_x", "500"}, {"map.virtual", "true"}},
         "No pixel requests a page",
         {{"map.virtual", "true"}}},
        {"overlay values", {}, "overlay", {{"view.overlay", "visibility"}}},
        {"stored-depth quads", {}, "view.slabs", {{"view.slabs", "both"}}},
        {"visibility", {}, "shading", {{"shading.separate_visibility", "true"}}},
    };
    const Scene scene = load_scene("boxes");
    FrameRequest cold = small_request();
    cold.force = true;
    for (const ReasonedChange& r : all) {
        const std::vector<Effect> before = effects(scene, r.before, cold);
        EXPECT_EQ(state_of_effect(before, r.effect), EffectState::NotNeeded) << r.effect;
        EXPECT_NE(reason_of(before, r.effect).find(r.reason), std::string::npos) << reason_of(before, r.effect);
        EXPECT_EQ(state_of_effect(effects(scene, r.after, cold), r.effect), EffectState::Drawn) << r.effect;
    }
    EXPECT_EQ(state_of_effect(effects(scene, {}), "pages of shadow maps"), EffectState::NotNeeded);
    EXPECT_EQ(state_of_effect(effects(scene, {{"map.virtual", "true"}}), "pages of shadow maps"), EffectState::Drawn);
}

/// A reason that names one of two missing things would not be a fix.
TEST_F(EffectsTest, ViewsThatAreNotShownAreReportedAsUnused) {
    const Scene scene = load_scene("boxes");
    const std::vector<Effect> all = effects(scene, {});
    const auto says = [&](const std::vector<Effect>& list, const char* name, const char* what) {
        EXPECT_NE(reason_of(list, name).find(what), std::string::npos) << name << ": " << reason_of(list, name);
    };
    for (const char* name : {"error metrics", "pixels compared", "causes found"})
        says(all, name, "needs the reference");
    says(all, "drawn depth range", "closed");
    says(all, "unfiltered map", "map as drawn");
    FrameRequest request = small_request();
    request.outputs.shadow_map = request.outputs.error = true;
    const std::vector<Effect> asked = effects(scene, {}, request);
    says(asked, "error metrics", "not traced");
    says(asked, "drawn depth range", "view.map_fit");
    EXPECT_EQ(state_of_effect(effects(scene, {{"view.map_fit", "true"}}, request), "drawn depth range"),
              EffectState::Drawn);
}

TEST_F(EffectsTest, MasksCountOnlyInScenesThatHaveThem) {
    EXPECT_EQ(state_of_effect(effects(load_scene("boxes"), {}), "alpha test in maps of light 0"),
              EffectState::NotNeeded);
    const Scene stage = load_scene("stage");
    EXPECT_EQ(state_of_effect(effects(stage, {}), "alpha test in maps of light 0"), EffectState::Drawn);
    Scene opaque = stage;
    for (Material& m : opaque.materials) m.alpha = AlphaMode::Opaque;
    EXPECT_EQ(state_of_effect(effects(opaque, {}), "alpha test in maps of light 0"), EffectState::NotNeeded);
}

TEST_F(EffectsTest, EachFaceAndCascadeIsAnEffect) {
    const Scene scene = load_scene("boxes");
    const auto count = [](const std::vector<Effect>& all, const char* what) {
        return std::count_if(all.begin(), all.end(), [&](const Effect& e) { return e.name.starts_with(what); });
    };
    EXPECT_EQ(count(effects(scene, {{"light.type", "point"}}), "face "), 6);
    EXPECT_EQ(count(effects(scene, {{"light.cascades", "3"}}), "cascade "), 3);
}

TEST_F(EffectsTest, CachedResultsAreReportedAsCached) {
    const Scene scene = load_scene("boxes");
    effects(scene, {});
    const std::vector<Effect> again = effects(scene, {{"camera.azimuth", "80"}});
    EXPECT_EQ(state_of_effect(again, "shadow map 0 (directional)"), EffectState::Cached);
    EXPECT_EQ(state_of_effect(again, "alpha test in maps of light 0"), EffectState::NotNeeded);
    EXPECT_EQ(state_of_effect(effects(scene, {{"light.azimuth", "80"}}), "shadow map 0 (directional)"),
              EffectState::Drawn);
}

TEST_F(EffectsTest, AForcedEffectIsDrawn) {
    const Scene scene = load_scene("boxes");
    const Sets sets = {{"light.cast", "false"}, {"shading.separate_visibility", "true"}};
    const Effect skipped = effect_named(effects(scene, sets), "look-ups of light 0");
    EXPECT_EQ(skipped.state, EffectState::NotNeeded);
    EXPECT_EQ(skipped.optimisation, Optimisation::DeadPasses);
    const std::uint64_t draws = last.pass("visibility")->draws;
    FrameRequest request = small_request();
    request.forced = {Optimisation::DeadPasses};
    const std::vector<Effect> forced = effects(scene, sets, request);
    EXPECT_EQ(state_of_effect(forced, "look-ups of light 0"), EffectState::Drawn);
    EXPECT_GT(last.pass("visibility")->draws, draws) << "it is reported as drawn, and nothing more is drawn";
}

TEST_F(EffectsTest, PartsSkippedByOptimisationsNameThemAndAreDrawnWhenForced) {
    const Scene scene = load_scene("boxes");
    const Sets sets = {{"filter.kernel", "pcss"}, {"light.size", "0"}};
    const std::pair<const char*, Optimisation> all[] = {
        {"visibility", Optimisation::FusedVisibility},
        {"look-ups where light does not arrive", Optimisation::BackFacingReceivers},
        {"search for a penumbra of light 0", Optimisation::BlockerSearch},
        {"shading of what is hidden", Optimisation::DepthOrder}};
    const std::vector<Effect> before = effects(scene, sets);
    for (const auto& [name, saving] : all) {
        EXPECT_EQ(state_of_effect(before, name), EffectState::NotNeeded) << name;
        EXPECT_EQ(effect_named(before, name).optimisation, saving) << name;
        FrameRequest request = small_request();
        request.forced = {saving};
        const std::vector<Effect> forced = effects(scene, sets, request);
        EXPECT_EQ(state_of_effect(forced, name), EffectState::Drawn) << name;
        EXPECT_EQ(effect_named(forced, name).optimisation, saving) << name << ": it could not be released again";
        for (const Effect& e : forced) EXPECT_EQ(fault_of(e), "") << e.name << ": " << e.reason;
    }
    const std::vector<Effect> sized = effects(scene, {{"filter.kernel", "pcss"}, {"light.size", "1"}});
    EXPECT_FALSE(has_effect(sized, "search for a penumbra of light 0")) << "one opens: it is searched for";
    EXPECT_FALSE(has_effect(effects(scene, {{"light.cast", "false"}}), "look-ups where light does not arrive"));
}

TEST_F(EffectsTest, BlockerSearchesFollowTheKernelUnderEachLight) {
    const Scene scene = load_scene("boxes");
    const std::vector<Effect> rays = effects(scene, {{"filter.kernel", "smrt"}, {"light.size", "1"}});
    EXPECT_EQ(state_of_effect(rays, "blocker search"), EffectState::Drawn);
    EXPECT_NE(reason_of(rays, "blocker search").find("marches rays"), std::string::npos);
    EXPECT_FALSE(has_effect(rays, "search for a penumbra of light 0"));
    const Sets no_size = {{"filter.kernel", "smrt"}, {"light.size", "0"}};
    const std::vector<Effect> skipped = effects(scene, no_size);
    EXPECT_NE(reason_of(skipped, "blocker search").find("no penumbra opens"), std::string::npos);
    EXPECT_EQ(effect_named(skipped, "search for a penumbra of light 0").optimisation, Optimisation::BlockerSearch);
    FrameRequest request = small_request();
    request.forced = {Optimisation::BlockerSearch};
    EXPECT_EQ(state_of_effect(effects(scene, no_size, request), "search for a penumbra of light 0"),
              EffectState::Drawn);
    EXPECT_EQ(
        state_of_effect(effects(scene, {{"filter.kernel", "pcss"}, {"light.size", "0"}}, request), "blocker search"),
        EffectState::Drawn)
        << "all places are looked at";
    EXPECT_FALSE(has_effect(effects(scene, {{"filter.kernel", "dpcf"}, {"light.size", "0"}}),
                            "search for a penumbra of light 0"))
        << "its taps compare whatever the light's size: nothing is skipped";
    const std::vector<Effect> two =
        effects(scene, {{"filter.kernel", "pcss"}, {"light.count", "2"}, {"light.0.size", "1"}, {"light.1.size", "0"}});
    for (const char* name : {"blocker search", "light's size"}) {
        EXPECT_EQ(state_of_effect(two, name), EffectState::Drawn);
        EXPECT_NE(reason_of(two, name).find("light.1.size is 0"), std::string::npos) << reason_of(two, name);
    }
    EXPECT_FALSE(has_effect(two, "search for a penumbra of light 0"));
    EXPECT_TRUE(has_effect(two, "search for a penumbra of light 1"));
    for (const std::vector<Effect>* all : {&rays, &skipped, &two})
        for (const Effect& e : *all) EXPECT_EQ(fault_of(e), "") << e.name << ": " << e.reason;
}

TEST_F(EffectsTest, TexelsOfLookUpsAreAnUpperBound) {
    const Scene scene = load_scene("boxes");
    const Sets no_size = {
        {"filter.kernel", "pcss"}, {"filter.taps", "20"}, {"filter.blocker_taps", "10"}, {"light.size", "0"}};
    EXPECT_EQ(reason_of(effects(scene, no_size), "look-ups of light 0"),
              "Kernel PCSS fetches up to 21 texels a look-up.");
    FrameRequest request = small_request();
    request.forced = {Optimisation::BlockerSearch};
    EXPECT_EQ(reason_of(effects(scene, no_size, request), "look-ups of light 0"),
              "Kernel PCSS fetches up to 30 texels a look-up.");
    EXPECT_EQ(reason_of(effects(scene, {{"filter.kernel", "hard"}}), "look-ups of light 0"),
              "Kernel Hard (nearest) fetches up to 1 texel a look-up.");
}

TEST_F(EffectsTest, WithoutALookUpThereIsNoSearch) {
    const Scene scene = load_scene("boxes");
    Sets away = {{"filter.kernel", "pcss"}, {"camera.source", "manual"}, {"camera.target_x", "500"}};
    for (const bool separate : {false, true}) {
        if (separate) away.emplace_back("shading.separate_visibility", "true");
        const std::vector<Effect> all = effects(scene, away);
        for (const char* name : {"look-ups of light 0", "blocker search", "light's size"})
            EXPECT_EQ(state_of_effect(all, name), EffectState::NotNeeded) << name << ": " << reason_of(all, name);
        for (const Effect& e : all) EXPECT_EQ(fault_of(e), "") << e.name << ": " << e.reason;
    }
}

TEST(SharedOptimisations, CountTheEffectsThatNameThem) {
    const std::vector<Effect> all = {{.name = "a", .optimisation = Optimisation::UnreadViews},
                                     {.name = "b"},
                                     {.name = "c", .optimisation = Optimisation::CasterCulling},
                                     {.name = "d", .optimisation = Optimisation::UnreadViews},
                                     {.name = "e"}};
    EXPECT_EQ(sharing_optimisation_count(all, all[0]), 2u);
    EXPECT_EQ(sharing_optimisation_count(all, all[1]), 1u) << "an effect that no optimisation skips is alone";
    EXPECT_EQ(sharing_optimisation_count(all, all[2]), 1u);
}

TEST_F(EffectsTest, EmptyScenesAndFarLightsHaveEffects) {
    Scene empty;
    finalise(empty);
    for (const Effect& e : effects(empty, {})) EXPECT_EQ(fault_of(e), "") << e.name << ": " << e.reason;
    const std::vector<Effect> none = effects(load_scene("boxes"), {{"light.count", "0"}});
    EXPECT_EQ(state_of_effect(none, "shadow maps"), EffectState::NotNeeded);
    const std::vector<Effect> many =
        effects(load_scene("boxes"), {{"light.count", "3"}, {"light.1.cast", "false"}, {"light.2.type", "point"}});
    EXPECT_EQ(state_of_effect(many, "look-ups of light 0"), EffectState::Drawn);
    EXPECT_EQ(state_of_effect(many, "look-ups of light 1"), EffectState::NotNeeded);
    EXPECT_EQ(
        std::count_if(many.begin(), many.end(),
                      [](const Effect& e) { return e.name.starts_with("face ") && e.name.ends_with(" of light 2"); }),
        6);
}

TEST(PassParts, ReportedByPassesAreEffectsWithTheirOptimisation) {
    Scene scene;
    finalise(scene);
    FrameResult frame;
    PassInfo pass{.name = "shadow map 0 (spot)", .state = PassState::Drawn, .reason = "its inputs changed", .light = 0};
    pass.parts.push_back({.name = "casters of light 0",
                          .state = PassState::Drawn,
                          .reason = "they lie outside the light's reach",
                          .left_out = 7,
                          .unit = "casters",
                          .by = Optimisation::DeadPasses});
    frame.passes.push_back(pass);
    const std::vector<Effect> all = frame_effects(scene, {}, frame);
    const Effect part = effect_named(all, "casters of light 0");
    EXPECT_EQ(part.reason, "They lie outside the light's reach. 7 casters are left out.");
    EXPECT_EQ(part.optimisation, Optimisation::DeadPasses);
    EXPECT_TRUE(part.part);
    EXPECT_EQ(part.pass, pass.name);
    EXPECT_EQ(part.state, EffectState::Drawn);
}

TEST(Sentences, KeepKeysAndFullStops) {
    EXPECT_EQ(as_sentence("nothing reads it"), "Nothing reads it.");
    EXPECT_EQ(as_sentence("map.virtual is off"), "map.virtual is off.");
    EXPECT_EQ(as_sentence("Done."), "Done.");
    EXPECT_EQ(as_sentence(""), "");
}

}  // namespace
}  // namespace si
