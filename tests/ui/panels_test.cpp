// Tests of every panel for every choice of every row, and of the widgets' behaviour by mouse.
#include <gtest/gtest.h>
#include <imgui.h>
#include <imgui_internal.h>

#include <cmath>
#include <map>
#include <set>

#include "renderer/settings/param.h"
#include "tests/support/combinations.h"
#include "tests/support/traits.h"
#include "tests/ui/screen.h"
#include "tests/ui/ui_harness.h"
#include "ui/widgets/setting_widgets.h"
#include "ui/widgets/text.h"

namespace si::test {
namespace {

// Positions at 1280 x 720: the search field, and the first row below its group's heading.
constexpr glm::vec2 kSearch{1040, 83}, kFirstLabel{965, 142}, kFirstValue{1170, 142}, kPicture{200, 250};
constexpr float kCheckbox = 1091;  // left end of the column of values, which checkboxes use too

const std::string kObjectPath = "Root/Box";

/// Returns every value of a row's widget: each choice, both states, or the ends and the middle.
std::vector<Value> values_of(const SettingRef& ref) {
    const Param& p = *ref.param;
    const Value preset = default_value(ref);
    std::vector<Value> values;
    if (std::holds_alternative<bool>(preset)) return {false, true};
    if (p.choices) {
        for (int i = 0; i < int(p.choices().size()); ++i) values.emplace_back(i);
        return values;
    }
    if (is_text(p)) return {"", "key"};
    for (const double v : {p.min, 0.5 * (p.min + p.max), p.max})
        if (std::holds_alternative<int>(preset))
            values.emplace_back(int(v));
        else
            values.emplace_back(v);
    return values;
}

std::vector<SettingRef> every_setting() {
    std::vector<SettingRef> all;
    for (const Param& p : params()) {
        all.emplace_back();
        all.back().param = &p;
        if (p.scope == Scope::Object) all.back().object = kObjectPath;
    }
    return all;
}

TEST(Panels, SettingsAreFoundByTermsOfOtherEngines) {
    const std::pair<const char*, const char*> kWords[] = {
        {"normal bias", "bias.normal"},            // Unity, Godot, Filament
        {"normalBias", "bias.normal"},             // three.js
        {"depth bias", "bias.constant"},           // Unity
        {"shadow bias", "bias.constant"},          // Unreal
        {"slope bias", "bias.slope"},              // Unreal
        {"slope scale", "bias.raster_slope"},      // Direct3D
        {"glPolygonOffset", "bias.raster_units"},  // OpenGL
        {"softness", "filter.radius"},
        {"soft shadows", "filter.kernel"},
        {"mapSize", "map.resolution"},     // three.js
        {"shadow distance", "light.fit"},  // Unity
        {"cascade", "light.cascades"},
        {"cascade border", "light.cascade_blend"},        // Unity
        {"distribution exponent", "light.split_lambda"},  // Unreal
        {"source angle", "light.size"},                   // Unreal
        {"angular size", "light.size"},                   // Godot
        {"shadowSide", "caster.cull"},                    // three.js
        {"castShadow", "object.cast"},                    // three.js
        {"energy", "light.intensity"},                    // Godot
        {"attenuation radius", "light.range"},            // Unreal
        {"CLIP start", "light.near"},                     // Blender
        {"normal   offset\t", "bias.normal"},
        {"offset normal", "bias.normal"},
        {"shadow strength", "shading.ambient"},  // Unity
        {"shadow color", "shading.ambient"},
        {"split distance", "light.split_1"},   // Unity
        {"orthographicSize", "light.extent"},  // Unity
        {"ortho size", "camera.height"},       // Blender
        {"pancake", "light.near_far"},
        {"CastShadows", "light.cast"},  // Unreal
        {"CastShadows", "object.cast"},
        {"anti-aliasing", "view.smooth"},
        {"MSAA", "view.smooth"},
        {"tone mapping", "shading.curve"},
        {"shadow_normal_bias", "bias.normal"},             // Godot
        {"shadow_reverse_cull_face", "caster.cull"},       // Godot
        {"directional_shadow_max_distance", "light.fit"},  // Godot
        {"directional_shadow_pancake_size", "light.near_far"},
        {"light_angular_distance", "light.size"},        // Godot
        {"shadow.normalBias", "bias.normal"},            // three.js
        {"PCFSoftShadowMap", "filter.kernel"},           // three.js
        {"polygonOffsetFactor", "bias.raster_slope"},    // three.js
        {"shadowBulbRadius", "light.size"},              // Filament
        {"screenSpaceContactShadows", "light.contact"},  // Filament
        {"cube size", "map.resolution"},                 // Blender
        {"bleed bias", "filter.bleed"},                  // Blender
        {"shadowNormalBias", "bias.normal"},             // Unity
        {"depthBiasSlopeScale", "bias.raster_slope"},    // WebGPU
        {"r.Shadow.CSMDepthBias", "bias.constant"},      // Unreal
        {"vsmBias", "filter.min_variance"},              // PlayCanvas
        {"shadowPancaking", "light.near_far"},
        {"cullFace", "caster.cull"},
        {"usePoissonSampling", "filter.kernel"},             // Babylon
        {"contactHardeningLightSizeUVRatio", "light.size"},  // Babylon
        {"frustumEdgeFalloff", "map.outside"},               // Babylon
        {"SampleCount", "filter.taps"},
        {"foliage", "caster.blend"},
        {"terminator", "bias.normal_source"},
        {"terminator", "view.overlay"},
        {"pcss", "filter.kernel"},
        {"lispsm", "light.fit"},
    };
    for (const auto& [words, key] : kWords) {
        SettingRef ref =
            *find_setting(std::string_view(key).starts_with("object.") ? "object.Root/Box" + std::string(key).substr(6)
                                                                       : std::string(key));
        EXPECT_TRUE(setting_matches(ref, words)) << words << " does not find " << key;
    }
    EXPECT_FALSE(setting_matches(*find_setting("bias.normal"), "normal cascade"));
}

SI_TEST_IS(Product, Panels, DrawForEveryChoiceOfEveryRow);
TEST(Panels, DrawForEveryChoiceOfEveryRow) {
    UiHarness ui(kWidth, kHeight);
    int drawn = 0;
    // A choice meets one tab by default, and all tabs in the full product.
    std::size_t choice = 0;
    std::vector<Page> pages;
    for (const PageRow& row : kPageTable) pages.push_back(row.page);
    for (const SettingRef& ref : every_setting()) {
        for (const Value& value : values_of(ref)) {
            ui.state.settings = Settings{};
            set_value(ui.state.settings, ref, value);
            sanitise(ui.state.settings);
            for (const Page page : test::portion(pages, pages.size(), choice++)) {
                ui.state.window.open_page = page;
                ui.state.probe_pixel = glm::ivec2(3, 4);
                ui.frames(2);
                ASSERT_TRUE(ui.state.shows(page));
                ++drawn;
            }
            EXPECT_GT(ImGui::GetDrawData()->TotalVtxCount, 2000) << setting_key(ref);
        }
    }
    EXPECT_GT(drawn, 300);
}

TEST(Panels, DrawWithoutAFrameAndWithoutLights) {
    UiHarness ui(kWidth, kHeight);
    ui.with_facts = false;
    const EditorRequests requests = ui.frames(3);
    EXPECT_GT(requests.scene_width, 300);
    EXPECT_GT(requests.scene_height, 200);
    ui.with_facts = true;
    ui.state.settings.light_count = 0;
    ui.frames(3);
}

TEST(Panels, NothingIsCutOffAtAnySize) {
    for (const auto& [w, h, scale] :
         {std::tuple{1280, 720, 1.0f}, {1920, 1080, 1.0f}, {3840, 2160, 2.0f}, {700, 480, 1.0f}}) {
        UiHarness ui(w, h, scale);
        const EditorRequests requests = ui.frames(4);
        EXPECT_GT(requests.scene_width, w / 6) << w;
        EXPECT_LT(requests.scene_width, w) << w;
        EXPECT_GT(requests.scene_height, h / 4) << w;
        EXPECT_LT(requests.scene_height, h) << w;
    }
}

// ImGui identifies a widget by its ID: two widgets of one ID take each other's clicks. Each ID may cover only one
// stretch of the column of values.
SI_TEST_IS(Later, Panels, NoIdIsUsedTwiceInTheSettings);
TEST(Panels, NoIdIsUsedTwiceInTheSettings) {
    UiHarness ui(kWidth, 6000);  // tall enough to hold all rows
    ui.state.settings.light_count = 3;
    ui.state.settings_panel.search.assign(1, '.');  // a dot matches every key: all groups open
    ui.frames(3);
    std::set<unsigned> closed;
    unsigned last = 0;
    for (float y = 75; y < 5990; y += 5) {
        ui.move({kCheckbox, y});
        ui.frame();
        const unsigned id = ui.hovered();
        if (id == last) continue;
        EXPECT_FALSE(id != 0 && closed.count(id)) << "at y = " << y;
        if (last != 0) closed.insert(last);
        last = id;
    }
    std::size_t rows = 0;
    for (const Param& p : params()) rows += p.scope != Scope::Object;
    EXPECT_GE(closed.size(), rows);
}

/// Returns positions at which the last frame drew in this colour, whatever its opacity.
std::vector<ImRect> drawn_in(const ImVec4& colour) {
    constexpr ImU32 kOpacity = IM_COL32_A_MASK;
    const ImU32 wanted = ImGui::ColorConvertFloat4ToU32(colour) & ~kOpacity;
    std::vector<ImRect> out;
    for (int i = 0; i < ImGui::GetDrawData()->CmdListsCount; ++i) {
        bool before = false;
        for (const ImDrawVert& v : ImGui::GetDrawData()->CmdLists[i]->VtxBuffer) {
            const bool is = (v.col & ~kOpacity) == wanted;
            if (is && !before) out.emplace_back(v.pos, v.pos);
            if (is) out.back().Add(v.pos);
            before = is;
        }
    }
    return out;
}

TEST(Panels, SliderMarkLeavesItsNumberFree) {
    for (const double share : {0.0, 0.45, 0.5, 0.55, 1.0}) {
        UiHarness ui(1280, 900);
        for (const SettingRef& ref : every_setting()) {
            const double most = ref.param->slider_max > 0 ? ref.param->slider_max : ref.param->max;
            if (std::holds_alternative<double>(default_value(ref)) && !ref.param->key.starts_with("camera."))
                set_value(ui.state.settings, ref, ref.param->min + share * (most - ref.param->min));
        }
        ui.frames(3);
        const std::vector<ImRect> marks = drawn_in(ImGui::GetStyle().Colors[ImGuiCol_SliderGrab]);
        EXPECT_GE(marks.size(), 5u);
        for (const ImRect& mark : marks)
            for (const DrawnText::Letter& l : ui.letters())
                EXPECT_FALSE(mark.Overlaps({l.lo, l.hi})) << char(l.letter) << " at " << l.lo.x << ", " << l.lo.y;
    }
}

TEST(Panels, MissingDriverFeaturesHaveNoEffect) {
    Settings s;
    s.bias.raster_slope = 1;
    DriverInfo driver;
    driver.polygon_offset_clamp = true;
    ImGui::CreateContext();
    const SettingFacts facts{.driver = &driver};
    use_setting_facts(&facts);
    EXPECT_TRUE(without_effect(s, *find_setting("bias.raster_clamp")).empty());
    driver.polygon_offset_clamp = false;
    EXPECT_NE(without_effect(s, *find_setting("bias.raster_clamp")).find("driver"), std::string_view::npos);
    EXPECT_TRUE(without_effect(s, *find_setting("bias.raster_slope")).empty());
    ImGui::DestroyContext();
}

TEST(Panels, LightSizeHasTheUnitOfItsType) {
    UiHarness ui(1280, 900);
    ui.state.settings_panel.search = "light.size";
    ui.frames(3);
    EXPECT_TRUE(ui.drawn().find(U"0.27°"));
    ui.state.settings.lights[0].type = LightType::Point;
    ui.frames(3);
    EXPECT_TRUE(ui.drawn().find(U"0.27m"));
}

TEST(Panels, AutomaticValuesShowTheirResult) {
    UiHarness ui(1280, 900);
    ui.state.settings_panel.search = "light.near";
    ui.frames(3);
    EXPECT_TRUE(ui.drawn().find(U"auto"));
    const std::u32string shown = ui.printed();
    const auto at = shown.find(U"auto");
    ASSERT_NE(at, shown.npos);
    EXPECT_TRUE(shown[at + 4] >= U'0' && shown[at + 4] <= U'9') << "and the metres of the fit";
    ui.state.settings.lights[0].near = 2.5;
    ui.frames(3);
    EXPECT_TRUE(ui.drawn().find(U"2.5m"));
}

TEST(Panels, TexelBiasIsUsefulOverItsWholeSlider) {
    UiHarness ui(kWidth, kHeight);
    ui.state.settings_panel.search = "bias.constant";
    ui.frames(3);
    const auto at = [&](float share) {
        const float wide = 2 * (kWidth - kFirstValue.x);  // kFirstValue is the slider's centre, its end is the window's
        ui.move(kFirstValue), ui.press(true), ui.frames(2);
        ui.move(kFirstValue + glm::vec2((share - 0.5f) * wide * 0.8f, 0));
        ui.frames(2);
        ui.press(false);
        ui.frames(2);
        return ui.state.settings.bias.constant;
    };
    const double quarter = at(0.25f), middle = at(0.5f), three = at(0.75f);
    EXPECT_NEAR(middle, 10, 2.5);
    EXPECT_NEAR(middle - quarter, three - middle, 0.5) << "equal ways are equal steps";
    EXPECT_GT(middle - quarter, 3);
}

TEST(Panels, StatusBarShowsMapMemoryAndReads) {
    UiHarness ui(1600, 900);
    set_setting(ui.state.settings, "filter.kernel", "hard");
    ui.frames(3);
    EXPECT_TRUE(ui.drawn().shows("MiB,1tap"));
    set_setting(ui.state.settings, "filter.kernel", "pcf");
    ui.frames(3);
    EXPECT_TRUE(ui.drawn().shows("taps"));
}

TEST(Panels, TooltipHidesNoOtherSetting) {
    UiHarness ui(kWidth, kHeight);
    ui.state.settings_panel.search = "bias.constant";
    ui.frames(3);
    ui.move(kFirstLabel);
    ui.frames(5);
    const ImGuiWindow *tip = nullptr, *settings = nullptr;
    for (const ImGuiWindow* w : ImGui::GetCurrentContext()->Windows) {
        const std::string_view name(w->Name);
        if (w->WasActive && (w->Flags & ImGuiWindowFlags_Tooltip)) tip = w;
        if (name.starts_with("editor/inspector_")) settings = w;
    }
    ASSERT_TRUE(tip && settings);
    EXPECT_LE(tip->Pos.x + tip->Size.x, settings->Pos.x);
    EXPECT_GE(tip->Pos.x, 0);
}

TEST(Panels, DepthBiasHasNoTrailingZeros) {
    UiHarness ui(kWidth, kHeight);
    ui.state.settings.bias.unit = BiasUnit::Depth;
    ui.state.settings_panel.search = "bias.constant";
    const auto shows = [&](double value, const char32_t* text) {
        ui.state.settings.bias.constant = value;
        ui.frames(3);
        return ui.drawn().shows(std::u32string_view(text));
    };
    EXPECT_TRUE(shows(0, U"0depth"));
    EXPECT_FALSE(shows(0, U".000000depth"));
    EXPECT_TRUE(shows(1000, U"1000depth"));
    EXPECT_FALSE(shows(1000, U".000000depth"));
    EXPECT_TRUE(shows(0.005, U"0.005depth"));
    EXPECT_TRUE(shows(0.000015, U"0.000015depth")) << "no exponent";
    ui.state.settings.bias.constant = 0.005;
    ui.frames(3);
    ui.drag(kFirstValue, kFirstValue + glm::vec2(20, 0));
    const double dragged = ui.state.settings.bias.constant * 1e6;
    EXPECT_NE(dragged, 5000);
    EXPECT_NEAR(dragged, std::round(dragged), 1e-6) << "six digits after the point";
}

/// Labels are free texts: authors of commands and presets find the key in the tooltip.
SI_TEST_IS(Later, Panels, TooltipOfEverySettingShowsItsKey);
TEST(Panels, TooltipOfEverySettingShowsItsKey) {
    UiHarness ui(kWidth, 6000);                     // tall enough to hold all rows
    ui.state.settings_panel.search.assign(1, '.');  // a dot matches every key: all groups open
    ui.frames(3);
    std::string tips;
    for (float y = 75; y < 5990; y += 9) {
        ui.move({kFirstLabel.x - 22, y});  // short labels, too
        ui.frames(2);
        for (const ImGuiWindow* w : ImGui::GetCurrentContext()->Windows) {
            if (!w->Active || !(w->Flags & ImGuiWindowFlags_Tooltip)) continue;
            for (const DrawnText::Letter& l : ui.letters())
                if (w->Rect().Contains(ImVec2(0.5f * (l.lo.x + l.hi.x), 0.5f * (l.lo.y + l.hi.y))))
                    tips += l.letter < 128 ? char(l.letter) : '?';
        }
        tips += '\n';
    }
    int found = 0;
    int drawn = 0;
    for (const SettingRef& ref : every_setting()) {
        if (ref.param->scope == Scope::Object) continue;
        ++drawn;
        const bool shown = tips.find(setting_key(ref) + "default") != std::string::npos;
        EXPECT_TRUE(shown) << setting_key(ref);
        found += shown;
    }
    EXPECT_GT(drawn, 150);
    EXPECT_GT(found, 0);
}

TEST(Panels, TooltipsDoNotWrapKeys) {
    UiHarness ui(kWidth, kHeight);
    ui.frames(3);
    const float room = ImGui::CalcTextSize("filter.kernel=hard map.res").x;
    EXPECT_EQ(broken_at_spaces("filter.kernel=hard map.resolution=512", room),
              "filter.kernel=hard\nmap.resolution=512");
    EXPECT_EQ(broken_at_spaces("a b\nmap.resol filter.kernel=hard", room), "a b\nmap.resol\nfilter.kernel=hard");
    EXPECT_EQ(broken_at_spaces("a  b ", room), "a  b ");
    EXPECT_EQ(broken_at_spaces("", room), "");
}

TEST(Panels, OneIsSingular) {
    UiHarness ui(1280, 900);
    const auto shows = [&](const char* text) {
        ui.frames(3);
        return ui.drawn().find(std::u32string(text, text + std::string_view(text).size())).has_value();
    };
    ui.state.settings_panel.search = "light.cascades";
    EXPECT_TRUE(shows("1map"));
    EXPECT_FALSE(shows("1maps"));
    ui.state.settings.lights[0].cascades = 2;
    EXPECT_TRUE(shows("2maps"));
    ui.state.settings_panel.search = "bias.normal";
    ui.state.settings.bias.normal = 1;
    EXPECT_TRUE(shows("1texel"));
    EXPECT_FALSE(shows("1texels"));
    ui.state.settings_panel.search = "scene.time";
    ui.state.settings.scene.time = 1;
    EXPECT_TRUE(shows("1s")) << "a second";
}

TEST(Panels, GroupsWithTheSearchedNameComeFirst) {
    UiHarness ui(1280, 1200);
    const auto above = [&](const char* search, const char32_t* first, const char32_t* second) {
        ui.state.settings_panel.search = search;
        ui.frames(3);
        const auto a = ui.drawn().find(first, 0), b = ui.drawn().find(second, 0);
        return a && (!b || a->y < b->y);  // otherwise the second is scrolled out of view
    };
    EXPECT_TRUE(above("light", U"Azimuth", U"Slopebias"));
    EXPECT_TRUE(above("camera", U"Scene'scamera", U"Splitlambda"));
}

TEST(Panels, SliderDragIsOneUndoStep) {
    UiHarness ui(kWidth, kHeight);
    ui.state.settings_panel.search = "bias.constant";
    ui.frames(3);
    const double before = ui.state.settings.bias.constant;
    ui.drag(kFirstValue, kFirstValue + glm::vec2(60, 0));
    const double after = ui.state.settings.bias.constant;
    EXPECT_NE(after, before);
    ASSERT_TRUE(ui.state.history.can_undo());
    EXPECT_EQ(ui.state.history.undo().bias.constant, before);
    EXPECT_FALSE(ui.state.history.can_undo()) << "the drag took more than one step";
}

TEST(Panels, UndoAndRedoByKeyboard) {
    UiHarness ui(kWidth, kHeight);
    ui.frames(2);
    ui.state.settings.bias.constant = 7;
    ui.frame();
    ImGui::GetIO().KeyCtrl = true;
    ui.key('Z');
    EXPECT_EQ(ui.state.settings.bias.constant, Settings{}.bias.constant);
    ui.key('Y');
    EXPECT_EQ(ui.state.settings.bias.constant, 7);
}

TEST(Panels, CtrlClickAcceptsAnyValueInRange) {
    UiHarness ui(kWidth, kHeight);
    ui.state.settings_panel.search = "map.resolution";
    ui.frames(3);
    ImGui::GetIO().KeyCtrl = true;
    ui.click(kFirstValue);
    ImGui::GetIO().KeyCtrl = false;
    ui.type("777");
    ui.click(kPicture + glm::vec2(0, 300));  // another place
    EXPECT_EQ(ui.state.settings.map.resolution, 777);
}

TEST(Panels, ResolutionDragFindsPowersOfTwo) {
    UiHarness ui(kWidth, kHeight);
    ui.state.settings_panel.search = "map.resolution";
    ui.frames(3);
    ui.drag(kFirstValue, kFirstValue + glm::vec2(-40, 0));
    const int n = ui.state.settings.map.resolution;
    EXPECT_NE(n, Settings{}.map.resolution);
    EXPECT_EQ(n & (n - 1), 0) << n;
}

TEST(Panels, RightClickResetsASetting) {
    UiHarness ui(kWidth, kHeight);
    ui.state.settings_panel.search = "bias.constant";
    ui.state.settings.bias.constant = 9;
    ui.frames(3);
    for (const glm::vec2 at : {kFirstLabel, kFirstValue}) {
        ui.state.settings.bias.constant = 9;
        ui.click(at, 1);
        ui.click(at + glm::vec2(20, 16));  // the menu's first line
        EXPECT_EQ(ui.state.settings.bias.constant, Settings{}.bias.constant);
    }
}

TEST(Panels, ClickProbesAndDragOrbitsTheCamera) {
    UiHarness ui(kWidth, kHeight);
    ui.frames(3);
    ui.click(kPicture);
    EXPECT_TRUE(ui.state.probe_pixel);
    EXPECT_TRUE(ui.state.shows(Page::Pixel));
    EXPECT_EQ(ui.state.settings.camera.source, CameraSource::Automatic) << "a click moved the camera";
    const auto probed = ui.state.probe_pixel;
    ui.drag(kPicture, kPicture + glm::vec2(60, 25));
    EXPECT_EQ(ui.state.settings.camera.source, CameraSource::Manual);
    EXPECT_EQ(ui.state.probe_pixel, probed) << "a drag probed";
    const CameraSettings turned = ui.state.settings.camera;
    ui.drag(kPicture, kPicture + glm::vec2(60, 25), 2);
    EXPECT_NE(ui.state.settings.camera.target_x, turned.target_x);
    EXPECT_EQ(ui.state.settings.camera.azimuth, turned.azimuth);
    const LightSettings light = ui.state.settings.lights[0];
    ImGui::GetIO().KeyCtrl = true;
    ui.drag(kPicture, kPicture + glm::vec2(60, 25));
    ImGui::GetIO().KeyCtrl = false;
    EXPECT_NE(ui.state.settings.lights[0].azimuth, light.azimuth);
    EXPECT_EQ(ui.state.settings.camera.azimuth, turned.azimuth);
}

TEST(Panels, WheelTurnIsOneUndoStep) {
    UiHarness ui(kWidth, kHeight);
    ui.frames(3);
    ui.move(kPicture);
    ui.frames(2);
    for (int i = 0; i < 5; ++i) {
        ImGui::GetIO().MouseWheel = 1;
        ui.frames(3);
    }
    EXPECT_FALSE(ui.state.history.can_undo()) << "recorded in the middle of the gesture";
    ui.frames(60);
    ASSERT_TRUE(ui.state.history.can_undo());
    ui.state.history.undo();
    EXPECT_FALSE(ui.state.history.can_undo());
}

TEST(Panels, SplittersKeepTheirPlaces) {
    UiHarness ui(kWidth, kHeight);
    const int before = ui.frames(3).scene_width;
    float x = 0;
    for (float probe = 500; probe < 600 && x == 0; probe += 2) {  // the splitter between scene and map
        ui.move({probe, 300});
        ui.frames(2);
        if (ImGui::GetMouseCursor() == ImGuiMouseCursor_ResizeEW) x = probe;
    }
    ASSERT_GT(x, 0);
    ui.drag({x, 300}, {x - 100, 300});
    const int after = ui.frames(3).scene_width;
    EXPECT_NEAR(before - after, 100, 6);
    EXPECT_EQ(ui.frames(30).scene_width, after);
}

/// Drags by `by` from the points of a grid until something happened.
bool drag_somewhere(UiHarness& ui, glm::vec2 from, glm::vec2 to, glm::vec2 by, const auto& happened) {
    for (float y = from.y; y < to.y; y += 5)
        for (float x = from.x; x < to.x; x += 5) {
            ui.drag({x, y}, glm::vec2(x, y) + by);
            if (happened()) return true;
        }
    return false;
}

TEST(Panels, GreyScaleEndsAreDraggedInTheHistogram) {
    UiHarness ui(kWidth, kHeight);
    DepthHistogram histogram;
    histogram.counts.assign(100, 5);
    ui.map_facts = MapPlots{{}, histogram};
    ui.state.settings.view.map_fit = true;
    ui.state.history.reset(ui.state.settings);
    ui.frames(3);
    ViewSettings& v = ui.state.settings.view;
    // Black's marker stands at the left end of the plot under the map.
    ASSERT_TRUE(drag_somewhere(ui, {562, 400}, {590, 440}, {30, 0}, [&] { return v.map_black > 0; }));
    EXPECT_LT(v.map_black, v.map_white);
    EXPECT_FALSE(v.map_fit) << "dragged by hand";
    EXPECT_TRUE(ui.state.history.can_undo());
    EXPECT_EQ(ui.state.history.undo().view.map_black, 0);
    EXPECT_FALSE(ui.state.history.can_undo()) << "a drag is one step";
}

TEST(Panels, LostCastersAreNamedAndKeptByAButton) {
    UiHarness ui(kWidth, kHeight);
    ui.lost_casters = {{.object = 2, .by = LostBy::Culling, .cull = Cull::Front, .triangles = 2}};
    ui.state.window.open_page = Page::Objects;
    ui.frames(5);
    const std::string path = ui.scene.nodes[std::size_t(ui.scene.objects[2].node)].path;
    ui.click(ui.find("objects_", "", "Cast from both sides"));
    const auto own = ui.state.settings.objects.find(path);
    ASSERT_NE(own, ui.state.settings.objects.end());
    EXPECT_EQ(own->second.cull, ObjectCull::None);
}

TEST(Panels, BlendedCastersAreNamedAndCastByAButton) {
    UiHarness ui(kWidth, kHeight);
    ui.lost_casters = {{.object = 2, .by = LostBy::Blending, .triangles = 2}};
    ui.state.window.open_page = Page::Objects;
    ui.frames(5);
    ui.click(ui.find("objects_", "", "Blended ones cast"));
    EXPECT_EQ(ui.state.settings.caster.blend, BlendCasters::Mask);
    EXPECT_TRUE(ui.state.settings.objects.empty()) << "culling loses nothing";
}

TEST(Panels, ObjectListEditsOneObjectAtATime) {
    UiHarness ui(kWidth, kHeight);
    ui.state.window.open_page = Page::Objects;
    ui.frames(3);
    ui.state.window.maximised = Panel::Inspector;  // all columns have room
    const std::string other = ui.scene.nodes[std::size_t(ui.scene.objects[1].node)].path;
    ui.state.settings.objects[other].cull = ObjectCull::Back;
    ui.frames(3);
    const Settings before = ui.state.settings;
    // Checkboxes are at the right of the list: a click changes one, another click restores it.
    std::set<std::string> changed;
    for (float y = 80; y < 240; y += 12)
        for (float x = 1140; x < 1270; x += 10) {
            ui.click({x, y});
            const Settings after = ui.state.settings;
            if (after == before) continue;
            const std::vector<SettingRef> differing = differing_settings(before, after);
            ASSERT_EQ(differing.size(), 1u) << "more than what was clicked";
            ASSERT_EQ(differing[0].param->scope, Scope::Object);
            changed.insert(std::string(differing[0].param->key) + " of " + differing[0].object);
            ui.click({x, y});
            ASSERT_EQ(ui.state.settings, before)
                << setting_key(differing[0]) << ": back at its default it is no override";
        }
    EXPECT_GE(changed.size(), 4u);
}

TEST(Panels, UnchangedObjectsLeaveNoTraceInTheSettings) {
    UiHarness ui(kWidth, kHeight);
    ui.state.window.open_page = Page::Objects;
    ui.frames(5);
    EXPECT_TRUE(ui.state.settings.objects.empty());
}

TEST(SettingsPanel, ShowsOnlySettingsOfTheSelectedKernel) {
    UiHarness ui(1280, 1600);
    const auto shows = [&](std::u32string_view label) {  // as printed, without spaces
        ui.frames(3);
        return ui.printed().find(label) != std::u32string::npos;
    };
    EXPECT_TRUE(shows(U"Normaloffset"));
    EXPECT_FALSE(shows(U"Rotateperpixel"));
    set_setting(ui.state.settings, "filter.kernel", "poisson");
    EXPECT_TRUE(shows(U"Rotateperpixel"));
    EXPECT_FALSE(shows(U"Blockertaps"));
    set_setting(ui.state.settings, "filter.kernel", "pcss");
    EXPECT_TRUE(shows(U"Blockertaps"));
    set_setting(ui.state.settings, "filter.kernel", "vsm");
    EXPECT_FALSE(shows(U"Blockertaps"));
    EXPECT_TRUE(shows(U"Light-bleedreduction"));
    // A search by name shows the setting under every kernel, greyed.
    ui.state.settings_panel.search = "blocker";
    EXPECT_TRUE(shows(U"Blockertaps"));
}

}  // namespace
}  // namespace si::test
