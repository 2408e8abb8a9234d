// Presets of version 1 draw what they drew: the same bytes as all that version 1 took for granted, spelled out.
#include "tests/support/version_1.h"

#include <gtest/gtest.h>

#include "app/base/output.h"
#include "app/session/presets.h"
#include "renderer/scenes/builtin.h"
#include "renderer/settings/earlier.h"
#include "tests/support/hard_case.h"

namespace si::test {
namespace {

struct DrawnAs {
    std::vector<std::uint8_t> colour;
    std::vector<float> visibility;
    double texel_m = 0;
};

DrawnAs draw(const Scene& scene, const Settings& settings) {
    FrameRequest request{.width = 160, .height = 90};
    request.outputs = {.colour = true, .visibility = true};
    const FrameResult frame = hard_renderer().render(scene, settings, request);
    DrawnAs d;
    d.colour = hard_renderer().read_colour(frame.colour).data;
    if (frame.visibility.texture) d.visibility = hard_renderer().read_float(frame.visibility, 1).data;
    if (!frame.lights.empty() && !frame.lights[0].views.empty())
        d.texel_m = frame.lights[0].views[0].texel_size(1, settings.map.resolution);
    return d;
}

TEST(PresetsOfVersionOne, DrawTheirOldBytes) {
    int others = 0;
    for (const auto& file : version_1_presets()) {
        SCOPED_TRACE(file);
        const Preset preset = parse_preset(read_text_file(file), file.string());
        const Scene scene = load_scene(preset.scene);
        const DrawnAs read = draw(scene, preset.settings), spelled = draw(scene, version_1_settings(file));
        EXPECT_TRUE(read.colour == spelled.colour);
        EXPECT_TRUE(read.visibility == spelled.visibility);
        EXPECT_FALSE(read.colour.empty());
        // That the defaults of today would draw something else is what makes this worth asking.
        Settings today = preset.settings;
        for (LightSettings& light : today.lights) light.fit = LightSettings().fit;
        others += preset.settings != today && draw(scene, today).texel_m != read.texel_m;
    }
    if (defaults_of_version(1) != Settings()) {
        EXPECT_GT(others, 10);
    }
}

}  // namespace
}  // namespace si::test
