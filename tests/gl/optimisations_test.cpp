// Tests all optimisations at once: forced frames draw the same bytes, and counts show that the optimisations acted.
#include "renderer/optimisations/optimisations.h"

#include <algorithm>
#include <cstdlib>

#include "renderer/base/error.h"
#include "renderer/inspect/effects.h"
#include "renderer/view/cameras/make_camera.h"
#include "tests/gl/frame_fixture.h"
#include "tests/support/missing_reason.h"
#include "tests/support/shared_models.h"
#include "tests/support/traits.h"

namespace si {
namespace {

class OptimisationsTest : public FrameTest {
protected:
    OptimisationSet made;  ///< optimisations that acted in the drawn frames

    const FrameResult& note_made(const Scene& scene, const Settings& s, const FrameResult& frame,
                                 OptimisationSet forced = {}) {
        for (const Effect& effect : frame_effects(scene, s, frame, forced))
            if (effect.optimisation && !forced.contains(*effect.optimisation)) made.add(*effect.optimisation);
        return frame;
    }
    /// Expects equal pictures from a frame with optimisations and from a frame that forces a row.
    void expect_one_picture(const Scene& scene, const Settings& s, const std::string& what) {
        FrameRequest cold{.width = 160, .height = 90}, maps = cold;
        // Some optimisations act on cached maps; forced frames draw every map again.
        maps.outputs = {.colour = false, .shadow_map = true};
        renderer.render(scene, s, maps);
        const ByteImage saved = renderer.read_colour(note_made(scene, s, renderer.render(scene, s, cold)).colour);
        for (std::size_t row = 0; row < kOptimisations; ++row) {
            FrameRequest request = cold;
            request.forced = {Optimisation(row)};
            const FrameResult frame = note_made(scene, s, renderer.render(scene, s, request), request.forced);
            EXPECT_EQ(different_pixels(saved, renderer.read_colour(frame.colour)), 0u)
                << what << ", " << optimisation_rows()[row].key << " forced";
        }
    }
    /// Draws from the scene's first view, and from near one of its corners, where much is out of sight.
    void expect_one_picture(const Scene& scene, const Sets& extra, const std::string& what) {
        Settings s = settings_for(scene, extra);
        expect_one_picture(scene, s, what);
        s.camera = manual_camera(scene, s);
        const glm::dvec3 corner = glm::mix(scene.bounds.centre(), scene.bounds.hi, 0.6);
        s.camera.target_x = corner.x;
        s.camera.target_z = corner.z;
        s.camera.distance *= 0.3;
        expect_one_picture(scene, s, what + ", near a corner");
    }
    /// Expects each of these to have acted; otherwise nothing was compared.
    void expect_made(std::initializer_list<Optimisation> some) {
        for (const Optimisation saving : some)
            EXPECT_TRUE(made.contains(saving)) << row_of(saving).key << " never acted";
    }
};

/// Returns settings of lights, kernels and maps that decide which optimisations can act.
const std::vector<Sets>& cases() {
    static const std::vector<Sets> all = {
        {},
        {"light.type=spot"},
        {"light.type=point", "filter.kernel=pcf3"},
        {"light.cascades=4", "filter.kernel=pcf5"},
        {"filter.kernel=pcss", "filter.taps=32", "filter.blocker_taps=32"},
        {"filter.kernel=vsm"},
        {"map.virtual=true"},
        {"shading.separate_visibility=true", "light.cast=false"},
        {"filter.kernel=pcss", "light.size=0"},
        {"filter.kernel=smrt", "light.size=0"},
    };
    return all;
}

SI_TESTS_ARE(DriverIndependent, OptimisationsTest);
SI_TESTS_ARE(Repeated, OptimisationsTest);
SI_TEST_IS(Slow, OptimisationsTest, ForcedOrNotDrawTheSameBytesOfRealModels);
SI_TEST_IS(Slow, OptimisationsTest, ForcedOrNotDrawTheSameBytesInBuiltInScenes);
TEST_F(OptimisationsTest, ForcedOrNotDrawTheSameBytesInBuiltInScenes) {
    std::size_t next = 1;
    for (const BuiltinScene& row : builtin_scenes()) {
        const Scene scene = load_scene(std::string(row.key));
        expect_one_picture(scene, cases()[0], std::string(row.key));
        // Scenes and cases alternate: each scene meets two cases, and each case meets several scenes.
        for (int i = 0; i < 2; ++i, next = next % (cases().size() - 1) + 1)
            expect_one_picture(scene, settings_for(scene, cases()[next]),
                               std::string(row.key) + ", " + cases()[next][0].second);
    }
    expect_made({Optimisation::DeadPasses, Optimisation::BlockerSearch, Optimisation::EarlyOut,
                 Optimisation::BackFacingReceivers, Optimisation::DepthOrder, Optimisation::FrustumCulling,
                 Optimisation::FusedVisibility, Optimisation::CasterBackFaces, Optimisation::CasterCulling,
                 Optimisation::UnreadViews, Optimisation::CasterFragments});
}

// All scenes under all cases take an hour.
TEST_F(OptimisationsTest, ForcedOrNotDrawTheSameBytesOfRealModels) {
    const std::vector<test::SharedModel> models = test::shared_models();
    if (models.empty()) GTEST_SKIP() << test::kMissingReason << "../shared/models";
    const bool all = std::getenv("SI_LONG");
    constexpr std::string_view kSome[] = {"godot_room",           "kaykit_graveyard",  "khr_SimpleInstancing",
                                          "gen_mirrored_sheared", "gen_leaf_mask_uv1", "gen_far_from_origin"};
    std::size_t next = 0;
    for (const test::SharedModel& model : models) {
        const std::string name = model.file.string();
        if (!all && std::ranges::none_of(kSome, [&](auto some) { return name.find(some) != name.npos; })) continue;
        try {
            const Scene scene = load_scene(name);
            expect_one_picture(scene, cases()[0], name);
            for (std::size_t i = 0; i < (all ? cases().size() - 1 : 2); ++i, next = (next + 1) % (cases().size() - 1))
                expect_one_picture(scene, cases()[next + 1], name + ", " + cases()[next + 1][0].second);
        } catch (const Error& e) {
            EXPECT_TRUE(model.may_be_refused) << e.what();
        }
    }
    expect_made({Optimisation::DeadPasses, Optimisation::BackFacingReceivers, Optimisation::DepthOrder,
                 Optimisation::FrustumCulling, Optimisation::FusedVisibility, Optimisation::CasterBackFaces,
                 Optimisation::CasterCulling, Optimisation::UnreadViews, Optimisation::CasterFragments});
}

}  // namespace
}  // namespace si
