// Tests that presets of earlier versions draw the bytes of the same settings set one by one.
#include <gtest/gtest.h>

#include <string>

#include "app/session/presets.h"
#include "tests/gl/frame_fixture.h"

namespace si {
namespace {

class EarlierVersionsTest : public FrameTest {
protected:
    /// Returns the settings of a preset of version 2. @param settings text of the members of "settings"
    static Settings version_2(const std::string& settings) {
        const std::string text = R"({"format":"shadow-inspector-preset","version":2,"settings":{)" + settings + "}}";
        return parse_preset(text, "a.json").settings;
    }
    const Scene scene = load_scene("figures");
};

TEST_F(EarlierVersionsTest, PresetOfVersion2DrawsItsBias) {
    const Settings read = version_2(R"("map.resolution":512)");
    const Sets sets = {"map.resolution=512", "bias.kind=slope", "bias.unit=texels",
                       "bias.constant=0.1",  "bias.slope=0",    "bias.normal=3"};
    const ByteImage drawn = picture(scene, read);
    EXPECT_TRUE(drawn.data == picture(scene, settings_with({}, sets)).data);
    EXPECT_GT(different_pixels(drawn, picture(scene, settings_with({}, {"map.resolution=512"}))), 20u)
        << "the present default draws another picture";
}

TEST_F(EarlierVersionsTest, PresetOfVersion2DrawsItsOtherSettings) {
    const Settings read = version_2(R"("map.resolution":256,"bias.kind":"receiver-plane","bias.constant":0.5)");
    const Sets sets = {"map.resolution=256", "bias.kind=receiver-plane", "bias.constant=0.5", "bias.normal=3"};
    const ByteImage drawn = picture(scene, read);
    EXPECT_TRUE(drawn.data == picture(scene, settings_with({}, sets)).data);
    EXPECT_GT(different_pixels(drawn, picture(scene, settings_with(read, {"bias.normal=0"}))), 20u)
        << "the offset is seen";
}

}  // namespace
}  // namespace si
