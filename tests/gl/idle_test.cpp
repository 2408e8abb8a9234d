// Tests that idle settings change no pixel and active ones show at once, over pictures of many states with each
// setting at other values.
#include <fmt/format.h>

#include "renderer/scenes/shapes.h"
#include "renderer/settings/idle_reason.h"
#include "tests/gl/frame_fixture.h"
#include "tests/support/combinations.h"
#include "tests/support/traits.h"

namespace si {
namespace {

const std::vector<Sets>& states() {
    static const std::vector<Sets> list = {
        {},
        {"light.type=spot"},
        {"light.type=spot", "light.cone=175"},
        {"light.type=point", "view.face=3"},
        {"light.fit=manual"},
        {"light.fit=manual", "light.projection=perspective"},
        {"light.cascades=3"},
        {"light.cascades=3", "camera.source=manual", "camera.orthographic=true"},
        {"light.cascades=3", "light.fit=manual"},
        {"light.cascades=3", "camera.source=light"},
        {"light.cast=false"},
        {"light.cast=false", "camera.source=light"},
        {"light.cast=false", "camera.source=light", "light.type=point"},
        {"camera.source=light"},
        {"camera.source=manual", "camera.orthographic=true"},
        {"camera.source=manual"},
        {"light.count=2", "light.1.type=spot", "light.1.cast=false", "view.light=1", "camera.source=light"},
        {"light.count=0"},
        {"map.format=colour"},
        {"map.wrap=repeat", "map.far_guard=false"},
        {"map.wrap=clamp", "map.far_guard=false"},
        {"bias.kind=slope", "bias.constant=5", "bias.slope=2"},
        {"shading.specular=0"},
        {"view.map=bands"},
        {"view.map_fit=true"},
        {"view.panes=two", "view.overlay_2=visibility"},
        {"view.panes=four", "view.overlay_4=normals"},
        {"view.overlay=normals", "bias.kind=slope", "bias.constant=5"},
        {"view.overlay=depth-difference", "view.overlay_range=manual"},
        {"view.slabs=both"},
        {"view.slabs=both", "light.cast=false"},
        {"map.virtual=true"},
        {"map.virtual=true", "filter.kernel=vsm"},
        {"map.virtual=true", "map.virtual_levels=1", "light.type=spot"},
    };
    return list;
}

std::vector<Value> others(const SettingRef& ref, const Value& present) {
    const Param& p = *ref.param;
    std::vector<Value> values = {default_value(ref)};
    if (std::holds_alternative<bool>(present)) {
        values.emplace_back(!std::get<bool>(present));
    } else if (is_text(p)) {
        if (!p.file) values.emplace_back("key");  // a file of that name does not exist
    } else if (p.choices) {
        for (std::size_t i = 0; i < p.choices().size() && i < 4; ++i) values.emplace_back(int(i));
    } else if (std::holds_alternative<int>(present)) {
        values.emplace_back(int(std::min(p.min + 2, p.max)));
    } else {
        values.emplace_back(std::min(p.max, std::max(p.min, 0.37)));
        values.emplace_back(std::min(p.max, 7.0));
    }
    std::erase(values, present);
    return values;
}

/// Bytes of all pictures of a frame, one picture after the other.
using Bytes = std::vector<std::uint8_t>;

/// Compares the pictures of two frames. A directional light's map may move along its axis, which rounds depths
/// differently: one step of the scale is no effect.
std::string difference(const Bytes& a, const Bytes& b) {
    if (a.size() != b.size()) return "other pictures";
    std::size_t differ = 0;
    int most = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        const int d = std::abs(int(a[i]) - int(b[i]));
        differ += d > 1;
        most = std::max(most, d);
    }
    return differ == 0 ? "" : fmt::format("{} of {} bytes differ, by {} at most", differ, a.size(), most);
}

class IdleTest : public FrameTest {
protected:
    Bytes pictures(const Scene& scene, const Settings& s, bool force = false) {
        FrameRequest request{.width = 64, .height = 48, .outputs = {.shadow_map = true}, .force = force};
        const FrameResult frame = renderer.render(scene, s, request);
        Bytes out;
        for (const Pane& pane : frame.panes) {
            const ByteImage p = renderer.read_colour(pane.picture);
            out.insert(out.end(), p.data.begin(), p.data.end());
        }
        if (frame.map_view.texture) {
            const ByteImage map = renderer.read_colour(frame.map_view);
            out.insert(out.end(), map.data.begin(), map.data.end());
        }
        return out;
    }
};

SI_TESTS_ARE(DriverIndependent, IdleTest);
SI_TESTS_ARE(Repeated, IdleTest);
SI_TEST_IS(Slow, IdleTest, IdleSettingsChangeNoPixel);
TEST_F(IdleTest, IdleSettingsChangeNoPixel) {
    const Scene scene = load_scene("boxes");
    std::size_t compared = 0;
    for (const Sets& sets : states()) {
        Settings s = settings_for(scene, {"map.resolution=64", "filter.kernel=hard"});
        std::string what;
        for (const auto& [key, value] : sets) {
            set_setting(s, key, value);
            what += key + "=" + value + " ";
        }
        const Bytes before = pictures(scene, s);
        for (const SettingRef& ref : all_settings(s)) {
            if (ref.light > 1 || idle_reason(s, ref).empty()) continue;
            for (const Value& value : others(ref, get_value(s, ref))) {
                Settings other = s;
                set_value(other, ref, value);
                if (idle_reason(other, ref).empty() || !sanitise(other).empty()) continue;
                EXPECT_EQ(difference(pictures(scene, other), before), "")
                    << what << "\n"
                    << setting_key(ref) << "=" << value_text(*ref.param, value) << ": " << idle_reason(s, ref);
                ++compared;
            }
        }
    }
    EXPECT_GT(compared, 500u);
}

/// Returns states in which every pass has work.
const std::vector<Sets>& busy_states() {
    static const std::vector<Sets> list = {
        {"light.count=2",
         "light.1.type=spot",
         "light.1.elevation=60",
         "filter.kernel=vsm",
         "map.blur_texels=1",
         "bias.raster_slope=1",
         "bias.kind=slope",
         "bias.constant=0.1",
         "bias.slope=2",
         "bias.normal=3",
         "view.panes=four",
         "view.overlay=depth-difference",
         "view.overlay_range=manual",
         "view.overlay_2=visibility",
         "view.slabs=both",
         {"object.Boxes/Floor.receive", "true"}},
        {"light.cascades=3", "filter.kernel=pcss", "bias.kind=receiver-plane", "map.format=colour", "caster.cull=front",
         "view.face=1", "view.map=bands", "view.panes=two", "view.overlay_2=least-bias", "view.overlay_range=fitted"},
        {"light.type=point", "light.source=volumes-zfail", "camera.source=manual", "view.map_source=camera",
         "view.map_fit=true", "shading.separate_visibility=true"},
        {"map.virtual=true", "map.page_size=16", "map.resolution=256", "bias.raster_slope=1", "view.face=7",
         "view.panes=two", "view.overlay=stored-depth", "view.overlay_2=page-level"},
    };
    return list;
}

/// Makes a scene of few materials, because each needs programs of its own for every setting and compiling dominates
/// this test. The ball's normals differ from those of its triangles.
Scene boxes_and_ball() {
    Scene scene = load_scene("boxes");
    add_object(scene, "ball", -1, add_mesh(scene, "ball", make_sphere(0.6, 12, 8), 0), moved(1.5, 0.8, 1.5));
    finalise(scene);
    return scene;
}

class BusyStates : public IdleTest, public testing::WithParamInterface<std::size_t> {};

SI_TESTS_ARE(Product, BusyStates);
SI_TESTS_ARE(Repeated, BusyStates);
SI_TESTS_ARE(DriverIndependent, BusyStates);
// Results cached from frame to frame never belong to other settings. Each picture is compared with the same picture
// drawn without caches, right after one that shares nothing with it.
SI_TEST_IS(Later, BusyStates, NoChangeOfASettingLeavesAStalePicture);
TEST_P(BusyStates, NoChangeOfASettingLeavesAStalePicture) {
    const Scene scene = boxes_and_ball();
    const Settings apart = settings_for(scene, {"map.resolution=32", "light.azimuth=200", "camera.source=light",
                                                "view.slabs=both", "view.slabs_texels=4", "view.map_fit=true"});
    const auto drawn_again = [&](const Settings& s) {
        pictures(scene, apart, true);
        return pictures(scene, s, true);
    };
    Settings s = settings_for(scene, {"map.resolution=64"});
    for (const auto& [key, value] : busy_states()[GetParam()]) set_setting(s, key, value);
    const Bytes before = drawn_again(s);
    std::size_t seen = 0;
    // Each of the four states changes a quarter of the settings; the full product changes all in each.
    for (const SettingRef& ref : test::portion(all_settings(s), busy_states().size(), GetParam())) {
        // The last of several lights is changed: states with one light cover the first.
        const bool of_light = ref.param->key.starts_with("light.X");
        if (of_light && ref.light != s.light_count - 1) continue;
        const std::vector<Value> values = others(ref, get_value(s, ref));
        if (values.empty()) continue;
        Settings changed = s;
        set_value(changed, ref, values.front());
        // The default would take longer than everything else.
        if (ref.param->key == "map.resolution") changed.map.resolution = 96;
        const std::string what = setting_key(ref) + " = " + value_text(*ref.param, get_value(changed, ref));
        const Bytes now = pictures(scene, changed);
        const bool fresh = now == drawn_again(changed);  // EXPECT_EQ would print all bytes
        EXPECT_TRUE(fresh) << what;
        seen += now != before;
        const bool back = pictures(scene, s) == before;
        EXPECT_TRUE(back) << "back from " << what;
    }
    EXPECT_GT(seen, 7u) << "settings whose change shows";
}

// One instance per state, so that several run at a time.
INSTANTIATE_TEST_SUITE_P(Each, BusyStates, testing::Range(std::size_t(0), busy_states().size()));

}  // namespace
}  // namespace si
