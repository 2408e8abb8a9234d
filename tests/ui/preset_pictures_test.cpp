// Tests of the small pictures of presets: drawn in the background while they are wanted, and kept.
#include "app/editor/preset_pictures.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/ui/test_editor.h"

namespace si::test {
namespace {

TEST(PresetPictures, AreDrawnForTheOpenGalleryAndKept) {
    TestEditor editor(editor_options("boxes"));
    const auto picture_of = [&](const std::string& key) {
        const auto presets = editor.facts().presets;
        return std::ranges::find(presets, key, &PresetEntry::key)->picture;
    };
    EXPECT_EQ(picture_of("acne"), 0u) << "nothing wants it";
    EditorRequests requests = editor.requests();
    requests.want_pictures = {"acne"};
    editor.model().fulfil(requests);
    EXPECT_TRUE(editor.model().measuring());
    editor.model().finish_measuring();
    editor.model().fulfil(requests);
    const unsigned texture = picture_of("acne");
    EXPECT_NE(texture, 0u);
    editor.settle();
    EXPECT_EQ(picture_of("acne"), texture) << "it stays when the gallery is closed";
    Renderer renderer;
    const ByteImage image = draw_preset_picture(renderer, "acne");
    EXPECT_EQ(image.width, kPresetPictureWidth);
    EXPECT_EQ(image.height, kPresetPictureHeight);
    const auto [least, most] = std::ranges::minmax(image.data);
    EXPECT_GT(most - least, 50) << "it shows something";
    EXPECT_THROW(draw_preset_picture(renderer, "no such preset"), std::exception);
}

}  // namespace
}  // namespace si::test
