// Tests that shaders read the same bits of a frame's numbers from uniform blocks and from images of the same buffers.
#include "renderer/frame/blocks.h"

#include "renderer/settings/filters.h"
#include "tests/gl/frame_fixture.h"
#include "tests/support/traits.h"

namespace si {
namespace {

class BlocksTest : public FrameTest {
protected:
    void expect_one_picture(const Scene& scene, const Sets& sets, const std::string& what) {
        FrameRequest request{.width = 96, .height = 64, .outputs = {.visibility = true}, .force = true};
        const Settings s = settings_for(scene, sets);
        request.blocks_as_images = false;
        const FrameResult plain = renderer.render(scene, s, request);
        const ByteImage colour = renderer.read_colour(plain.colour);
        const FloatImage visibility = renderer.read_float(plain.visibility, 1);
        request.blocks_as_images = true;
        const FrameResult images = renderer.render(scene, s, request);
        EXPECT_EQ(different_pixels(colour, renderer.read_colour(images.colour)), 0u) << what;
        EXPECT_EQ(visibility.data, renderer.read_float(images.visibility, 1).data) << what;
    }
};

SI_TESTS_ARE(Repeated, BlocksTest);
SI_TEST_IS(Later, BlocksTest, BuffersAndImagesGiveTheSameBits);
TEST_F(BlocksTest, BuffersAndImagesGiveTheSameBits) {
    if (!renderer.driver().blocks_as_images) GTEST_SKIP() << "this driver reads uniform blocks";
    static const std::vector<Sets> cases = {
        {"shading.shininess=20"},
        {"filter.kernel=pcss", "bias.kind=slope", "light.type=spot"},
        {"filter.kernel=pcf3", "light.type=point", "light.range=30"},
        {"filter.kernel=evsm4", "light.cascades=3", "light.cascade_blend=0.2"},
        {"filter.kernel=vogel", "bias.kind=receiver-plane", "map.virtual=true"},
        {"filter.kernel=poisson", "filter.taps=48"},
        {"light.fit=lispsm", "map.format=linear", "light.count=3", "bias.normal=2"},
    };
    const Scene scene = load_scene("boxes");
    for (const Sets& sets : cases) expect_one_picture(scene, sets, sets[0].first + " " + sets[0].second);
}

}  // namespace
}  // namespace si
