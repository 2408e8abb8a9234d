// Tests that hidden objects are absent from picture, map and reference, and return unchanged.
#include <algorithm>

#include "app/session/session.h"
#include "app/sweep/case_sessions.h"
#include "renderer/reference/reference_geometry.h"
#include "renderer/reference/reference_picture.h"
#include "renderer/render/reference_frames.h"
#include "tests/gl/frame_fixture.h"

namespace si {
namespace {

class HiddenTest : public FrameTest {
protected:
    struct Drawn {
        std::vector<std::uint8_t> colour;
        std::vector<float> visibility, reference;
        bool operator==(const Drawn&) const = default;
    };
    Drawn draw(const Scene& scene, const Settings& settings) {
        FrameRequest request{.width = 160, .height = 90, .outputs = {.visibility = true, .error = true}};
        ReferenceCache cache;
        const FrameResult frame = render_with_reference(renderer, scene, settings, request, cache);
        return {renderer.read_colour(frame.colour).data, renderer.read_float(frame.visibility, 1).data,
                request.reference->traced.reference->visibility.data};
    }
    static Session stage(const std::vector<std::string>& sets) {
        std::vector<std::string> all{"map.resolution=256"};
        all.insert(all.end(), sets.begin(), sets.end());
        return open_session({.scene = "stage", .sets = all});
    }
};

TEST_F(HiddenTest, HiddenObjectsAreAbsentFromPictureMapAndReference) {
    const Session whole = stage({}), hidden = stage({"object.Stage/Wall.shown=false"});
    Scene without = whole.scene;
    std::erase_if(without.objects,
                  [&](const Object& o) { return without.nodes[std::size_t(o.node)].path == "Stage/Wall"; });
    ASSERT_EQ(without.objects.size() + 1, whole.scene.objects.size());
    const Bounds before = without.bounds;
    refresh(without);
    ASSERT_EQ(without.bounds.lo, before.lo) << "the wall ends nowhere where the scene does";
    ASSERT_EQ(without.bounds.hi, before.hi);
    const Drawn expected = draw(without, whole.settings);
    EXPECT_NE(draw(whole.scene, whole.settings), expected);
    EXPECT_EQ(draw(hidden.scene, hidden.settings), expected);
    Scene again = hidden.scene;
    hide_objects(again, {});
    EXPECT_EQ(draw(again, whole.settings), draw(whole.scene, whole.settings));
}

TEST_F(HiddenTest, SweepsCanHideAndShowObjects) {
    CaseSessions cases(plan_session({.scene = "boxes"}));
    const Session boxes = open_session({.scene = "boxes"});
    const std::string path = boxes.scene.nodes[std::size_t(boxes.scene.objects.back().node)].path;
    const std::size_t all = boxes.scene.objects.size();
    EXPECT_EQ(cases.prepare({{"object." + path + ".shown", "false"}}).scene.objects.size(), all - 1);
    EXPECT_EQ(cases.prepare({{"object." + path + ".shown", "true"}}).scene.objects.size(), all);
}

}  // namespace
}  // namespace si
