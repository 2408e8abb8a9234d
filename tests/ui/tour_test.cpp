// Tour of the editor's states with the real renderer, each saved as a picture (tour_STATE_SIZE.png). Popups are inside
// the window, no error is reported, and the subject of each state is visible.
#include <gtest/gtest.h>
#include <imgui.h>
#include <imgui_internal.h>

#include <algorithm>
#include <filesystem>
#include <memory>

#include "app/base/output.h"
#include "renderer/gltf/gltf.h"
#include "renderer/scenes/builtin.h"
#include "renderer/settings/param.h"
#include "tests/support/traits.h"
#include "tests/ui/test_editor.h"
#include "ui/scene_view/camera_steering.h"
#include "ui/scene_view/light_handles.h"

namespace si::test {
namespace {

class Tour : public testing::TestWithParam<std::pair<int, int>> {
protected:
    int width() const { return GetParam().first; }
    int height() const { return GetParam().second; }
    float em() const { return 15 * screenshot_scale(height()); }

    void open(const std::string& scene, const std::vector<std::string>& sets = {}) {
        editor_.reset();  // one OpenGL context at a time
        editor_ = std::make_unique<TestEditor>(editor_options(scene, sets, {width(), height()}));
    }
    EditorState& state() { return editor_->state(); }
    EditorFrame facts() { return editor_->facts(); }
    void frames(int count) { editor_->frames(count); }
    void keep(const std::string& name) {
        write_png(std::filesystem::path(SI_TEST_OUTPUT_DIR) /
                      ("tour_" + name + "_" + std::to_string(width()) + "x" + std::to_string(height()) + ".png"),
                  editor_->picture());
        expect_calm(*editor_);
    }
    /// Expects the window whose name holds `part` on the screen and wide enough for its content.
    void expect_window(const std::string& part) {
        for (const ImGuiWindow* w : ImGui::GetCurrentContext()->Windows) {
            if (!w->WasActive || std::string_view(w->Name).find(part) == std::string_view::npos) continue;
            EXPECT_GE(w->Pos.x, 0) << part;
            EXPECT_GE(w->Pos.y, 0) << part;
            EXPECT_LE(w->Pos.x + w->Size.x, float(width())) << part;
            EXPECT_LE(w->Pos.y + w->Size.y, float(height())) << part;
            EXPECT_EQ(w->ScrollMax.x, 0) << part;
            return;
        }
        ADD_FAILURE() << "no window " << part;
    }
    /// Returns the centre of the scene picture.
    glm::vec2 middle() const {
        const PictureView& v = *editor_->model().state.viewport.view;
        return glm::vec2(v.origin + 0.5 * v.size);
    }

    std::unique_ptr<TestEditor> editor_;
};

TEST_P(Tour, MenusAndDialogs) {
    open("stage");
    editor_->drag({{1.7f * em(), 1.25f * em()}});
    expect_window("##Popup");
    keep("file_menu");
    ImGui::ClosePopupToLevel(0, false);
    frames(2);
    editor_->drag({{21 * em(), 1.25f * em()}});
    expect_window("##Popup");
    keep("presets_menu");
    ImGui::ClosePopupToLevel(0, false);
    editor_->mouse.at = glm::vec2(width() / 2, height() / 2);
    const std::filesystem::path scenes = std::filesystem::path(SI_TEST_OUTPUT_DIR) / "tour_scenes";
    std::filesystem::create_directories(scenes);
    save_gltf(load_scene("boxes"), scenes / "boxes.gltf");
    save_gltf(load_scene("plane"), scenes / "plane.glb");
    open_file_dialog(state().files.dialog, FileDialog::Job::Open, scenes / "x");
    frames(12);  // the background has darkened
    expect_window("Open a model, map, bundle, capture or preset");
    keep("open_dialog");
    ImGui::ClosePopupToLevel(0, false);
    open_file_dialog(state().files.dialog, FileDialog::Job::SavePreset,
                     std::filesystem::path(SI_SOURCE_DIR) / "assets/presets/x.json");
    frames(12);
    expect_window("Save the preset as");
    keep("save_dialog");
    ImGui::ClosePopupToLevel(0, false);
    state().window.show_shortcuts = true;
    frames(4);
    keep("shortcuts");
}

TEST_P(Tour, FrozenCameraCountsItsOwnTexels) {
    open("stage", {"map.resolution=1024"});
    editor_->mouse.at = middle();
    frames(4);
    ASSERT_TRUE(facts().texel_usage);
    const double of_live = facts().texel_usage->utilisation();
    ASSERT_GT(of_live, 0);
    state().frozen = frozen_camera_of(*facts().result, state().settings.camera);
    editor_->mouse.at.reset();
    frames(3);
    ASSERT_TRUE(facts().frozen_usage);
    EXPECT_NEAR(facts().frozen_usage->utilisation(), of_live, 1e-4 * of_live);
    const double of_frozen = facts().frozen_usage->utilisation();
    // A closer view elsewhere: the flying camera reads fewer texels, the frozen one the same as before.
    CameraSettings& camera = state().settings.camera;
    set_setting(state().settings, "camera.source", "manual");
    camera.distance = 60;
    camera.azimuth = 120;
    camera.elevation = 40;
    editor_->settle();
    EXPECT_EQ(facts().frozen_usage->utilisation(), of_frozen);
    keep("frozen");
    editor_->mouse.at = middle();
    frames(4);
    EXPECT_NE(facts().texel_usage->utilisation(), of_live);
    // A smaller map is used better by the same pixels.
    state().settings.map.resolution = 256;
    frames(4);
    EXPECT_GT(facts().frozen_usage->utilisation(), of_live);
    EXPECT_EQ(facts().frozen_usage->size().width, 256);
    state().frozen.reset();
    frames(2);
    EXPECT_FALSE(facts().frozen_usage);
}

TEST_P(Tour, HandlesNumbersAndTooltips) {
    open("boxes");
    const auto handles =
        place_handles(light_pose(state().settings.lights[0], facts().result->lights[0], 0), *state().viewport.view);
    const auto extent =
        std::find_if(handles.begin(), handles.end(), [](const PlacedHandle& h) { return is_extent(h.handle); });
    ASSERT_NE(extent, handles.end());
    editor_->mouse.at = glm::vec2(extent->on_screen);
    frames(3);
    ASSERT_TRUE(state().viewport.hovered_light);
    keep("handle_tooltip");
    editor_->mouse.left = true;
    frames(2);
    *editor_->mouse.at += glm::vec2(2, 1) * em();
    frames(3);
    ASSERT_TRUE(state().viewport.handle_drag);
    keep("handle_drag");
    editor_->mouse.left = false;
    frames(2);
}

TEST_P(Tour, SeveralLightsAndTheViewThroughOne) {
    open("figures", {"light.count=4", "light.1.type=spot", "light.1.azimuth=60", "light.1.distance=6",
                     "light.1.cone=50", "light.2.type=point", "light.2.azimuth=150", "light.2.distance=4",
                     "light.3.azimuth=-120", "view.light=1", "light.0.intensity=0.4", "light.3.intensity=0.3"});
    keep("lights");
    state().settings.camera.source = CameraSource::Light;
    editor_->settle();
    keep("through_spot");
    EXPECT_FALSE(state().viewport.view->camera.orthographic);
}

TEST_P(Tour, SelectionHoverAndPanes) {
    open("stage", {"view.overlay=depth-difference"});
    ASSERT_FALSE(facts().scene->objects.empty());
    state().selection.first = "Stage/Wall";
    state().window.open_page = Page::Objects;
    editor_->mouse.at = middle();
    editor_->settle();
    ASSERT_TRUE(state().viewport.hovered_pixel);
    EXPECT_TRUE(facts().overlay_values);
    keep("selection_hover");
    for (const auto& [key, value] : {std::pair{"view.panes", "four"},
                                     {"view.overlay_2", "visibility"},
                                     {"view.overlay_3", "texels-per-pixel"},
                                     {"view.overlay_4", "n-dot-l"}})
        set_setting(state().settings, key, value);
    editor_->settle();
    keep("panes");
}

TEST_P(Tour, TheMapDownToItsTexels) {
    open("boxes", {"map.resolution=512"});
    state().probe_pixel = glm::ivec2(facts().result->colour.width / 2, facts().result->colour.height / 2);
    state().window.open_page = Page::Pixel;
    editor_->settle();
    ASSERT_TRUE(facts().probe && facts().probe->hit);
    const glm::ivec2 texel = facts().probe->lights[0].texel;
    state().map.window = {512 / 3.0f, (glm::vec2(texel) + 0.5f) / 512.0f};
    editor_->mouse.at = glm::vec2(width() * 0.85f, height() * 0.25f);
    editor_->settle();
    EXPECT_TRUE(state().map.hovered_texel);
    EXPECT_TRUE(facts().map_values);
    keep("texels");
    state().settings.view.map = MapView::Bands;
    editor_->settle();
    keep("texels_bands");
}

TEST_P(Tour, Comparison) {
    open("boxes", {"bias.kind=constant", "bias.constant=3", "bias.normal=3", "map.wrap=repeat", "filter.kernel=hard",
                   "light.azimuth=20"});
    state().window.open_page = Page::Compare;
    state().compare = {CompareKind::Preset, "acne"};
    editor_->settle();
    ASSERT_TRUE(facts().comparison);
    EXPECT_EQ(facts().comparison->problem, "");
    keep("compare");
}

INSTANTIATE_TEST_SUITE_P(Sizes, Tour, testing::Values(std::pair{1280, 720}, std::pair{1600, 900}));
SI_INSTANCE_IS(Long, LargeScreen, Tour);
INSTANTIATE_TEST_SUITE_P(LargeScreen, Tour, testing::Values(std::pair{3840, 2160}));

}  // namespace
}  // namespace si::test
