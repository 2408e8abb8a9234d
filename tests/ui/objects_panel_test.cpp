// Tests of the object tree and the scene's context menu: rows, sorting, multiple selection.
#include <gtest/gtest.h>
#include <imgui.h>
#include <imgui_internal.h>

#include <algorithm>

#include "renderer/scenes/builtin.h"
#include "renderer/settings/param.h"
#include "renderer/view/cameras/make_camera.h"
#include "tests/support/traits.h"
#include "tests/ui/ui_harness.h"
#include "ui/scene_view/pick.h"
#include "ui/state/selection.h"

namespace si::test {
namespace {

class ObjectsPanel : public testing::Test {
protected:
    /// @param width of the inspector, pixels
    explicit ObjectsPanel(float width = 915) : ui(1830, 900) {
        ui.state.window.open_page = Page::Objects;
        ui.state.layout.settings_width = width / 15;
        ui.state.layout.map_place = MapSpot::Hidden;
        ui.frames(4);
    }
    static const ImGuiTable* table() {
        ImGuiContext& g = *ImGui::GetCurrentContext();
        for (int i = 0; i < g.Tables.GetMapSize(); ++i)
            if (const ImGuiTable* t = g.Tables.TryGetMapData(i))
                if (std::string(t->InnerWindow->Name).find("objects") != std::string::npos) return t;
        return nullptr;
    }
    /// Returns the position of a widget by its ID, searched between two sides; nothing if the widget is not visible.
    std::optional<glm::vec2> seek(ImGuiID id, float left, float right, float step) {
        ui.frames(2);
        const ImRect all = table()->OuterRect;
        for (float y = all.Min.y + 5; y < all.Max.y; y += 11)
            for (float x = left; x < right; x += step) {
                ui.move({x, y});
                ui.frame();
                if (ui.hovered() == id) return glm::vec2(x, y);
            }
        return {};
    }
    /// Finds a row's name, or the arrow in front.
    std::optional<glm::vec2> row(const std::string& path) {
        const float left = table()->OuterRect.Min.x + 150;
        return seek(ImHashStr(("###" + path).c_str(), 0, table()->ID), left, left + 1, 10);
    }
    std::optional<glm::vec2> arrow(const std::string& path) {
        const float left = table()->OuterRect.Min.x + 4;
        return seek(ImHashStr(("open " + path).c_str(), 0, table()->ID), left, left + 50, 7);
    }
    void click(const std::string& path, bool ctrl = false, bool shift = false) {
        const auto at = row(path);
        ASSERT_TRUE(at) << path;
        ImGui::GetIO().KeyCtrl = ctrl;
        ImGui::GetIO().KeyShift = shift;
        ui.click(*at);
        ImGui::GetIO().KeyCtrl = ImGui::GetIO().KeyShift = false;
    }
    std::set<std::string> chosen() const { return selected_objects(ui.state); }
    /// Returns which columns are shown, by their position in the table.
    static std::vector<bool> columns() {
        std::vector<bool> shown;
        for (int i = 0; i < table()->ColumnsCount; ++i) shown.push_back(table()->Columns[i].IsEnabled);
        return shown;
    }
    using Paths = std::set<std::string>;
    UiHarness ui;
};

struct ObjectsInNarrowInspector : ObjectsPanel {
    ObjectsInNarrowInspector() : ObjectsPanel(595) {}
};
struct ObjectsInUsualInspector : ObjectsPanel {
    ObjectsInUsualInspector() : ObjectsPanel(24 * 15) {}
};
constexpr float kReadableName = 8 * 15;

// Object, Triangles, Shown, Cull, Casts, Receives.
TEST_F(ObjectsPanel, HasAllColumnsIfTheyFit) {
    EXPECT_EQ(columns(), std::vector<bool>(6, true));
}

TEST_F(ObjectsInNarrowInspector, HideTheTriangleColumnForNames) {
    EXPECT_EQ(columns(), (std::vector<bool>{true, false, true, true, true, true}));
    EXPECT_GE(table()->Columns[0].WidthGiven, kReadableName);
}

TEST_F(ObjectsInUsualInspector, ShowReadableNames) {
    EXPECT_EQ(columns(), (std::vector<bool>{true, false, true, false, true, false}));
    EXPECT_GE(table()->Columns[0].WidthGiven, kReadableName);
    EXPECT_LE(table()->Columns[4].MaxX, table()->OuterRect.Max.x) << "the last one is not cut";
    click("Stage/Ground");
    EXPECT_EQ(chosen(), Paths{"Stage/Ground"});
}

TEST_F(ObjectsPanel, RowsAreSelectedSinglyAddedAndAsRanges) {
    click("Stage/Ground");
    EXPECT_EQ(chosen(), Paths{"Stage/Ground"});
    click("Stage/Plinth", true);
    EXPECT_EQ(chosen(), (Paths{"Stage/Ground", "Stage/Plinth"}));
    click("Stage/Ground", true);
    EXPECT_EQ(chosen(), Paths{"Stage/Plinth"});
    click("Stage/Ground", false, true);
    EXPECT_EQ(chosen(), (Paths{"Stage/Ground", "Stage/Plinth"})) << "all between";
    click("Stage/Fence");
    const Paths fence = chosen();
    EXPECT_GT(fence.size(), 3u) << "what places nothing stands for all below it";
    for (const std::string& path : fence) EXPECT_TRUE(path.starts_with("Stage/Fence/")) << path;
    click("Stage/Fence");
    EXPECT_TRUE(chosen().empty());
}

TEST_F(ObjectsPanel, ClosedNodeHidesItsChildrenAndASearchShowsThem) {
    const std::string below = mesh_nodes_below(ui.scene,
                                               [&] {
                                                   for (std::size_t i = 0; i < ui.scene.nodes.size(); ++i)
                                                       if (ui.scene.nodes[i].path == "Stage/Fence") return int(i);
                                                   return -1;
                                               }())
                                  .front();
    ASSERT_TRUE(row(below));
    const auto at = arrow("Stage/Fence");
    ASSERT_TRUE(at);
    ui.click(*at);
    EXPECT_FALSE(row(below));
    ui.state.objects.search = below;
    EXPECT_TRUE(row(below));
}

TEST_F(ObjectsPanel, SearchHintNamesExistingObjects) {
    const ImRect all = table()->OuterRect;
    bool tip = false;
    for (float y = all.Min.y - 80; y < all.Min.y && !tip; y += 4) {
        ui.move({all.Min.x + 30, y});
        ui.frames(3);
        tip = ui.drawn().shows("All words have to be there");
    }
    EXPECT_TRUE(tip);
    EXPECT_FALSE(ui.drawn().shows("engine"));
}

TEST_F(ObjectsPanel, SelectionInTheSceneScrollsIntoView) {
    ui.state.layout.map_place = MapSpot::AboveSettings;
    ui.state.layout.map_height = 0.78f;  // few rows have room
    ui.state.objects.closed_nodes = {"Stage/Fence"};
    ui.frames(4);
    const auto below_fence = [&](const Object& o) {
        return ui.scene.nodes[std::size_t(o.node)].path.starts_with("Stage/Fence/");
    };
    for (const auto& o : {*std::ranges::find_if(ui.scene.objects, below_fence), ui.scene.objects.back()}) {
        const std::string path = ui.scene.nodes[std::size_t(o.node)].path;
        EXPECT_FALSE(row(path)) << path;
        select_objects(ui.state, std::vector<std::string>{path});
        ui.frames(4);
        EXPECT_TRUE(row(path)) << path;
    }
    EXPECT_TRUE(ui.state.objects.closed_nodes.empty());
    // Selection in the list scrolls nothing.
    ui.state.layout.map_place = MapSpot::Hidden;
    select_objects(ui.state, std::vector<std::string>{"Stage/Ground"});
    ui.frames(4);
    ui.state.objects.closed_nodes = {"Stage/Fence"};
    click("Stage/Fence");
    ui.frames(4);
    EXPECT_GT(chosen().size(), 3u);
    EXPECT_EQ(ui.state.objects.closed_nodes.size(), 1u);
}

TEST_F(ObjectsPanel, HoveredRowIsMarkedInTheScene) {
    const auto at = row("Stage/Plinth");
    ASSERT_TRUE(at);
    EXPECT_EQ(ui.state.objects.hovered, "Stage/Plinth");
    ui.move({20, 200});
    ui.frames(2);
    EXPECT_EQ(ui.state.objects.hovered, "");
}

TEST_F(ObjectsPanel, ChangeOfOneSelectedObjectChangesAll) {
    ui.state.history.reset(ui.state.settings);
    click("Stage/Ground");
    click("Stage/Plinth", true);
    const SettingRef cast = *find_setting("object.Stage/Plinth.cast");
    const float right = table()->OuterRect.Max.x;
    const auto box =
        seek(ImHashStr("##value", 0, ImHashStr(setting_key(cast).c_str(), 0, table()->ID)), right - 300, right, 12);
    ASSERT_TRUE(box);
    ui.click(*box);
    EXPECT_FALSE(ui.state.settings.objects["Stage/Plinth"].cast);
    EXPECT_FALSE(ui.state.settings.objects["Stage/Ground"].cast);
    EXPECT_EQ(ui.state.settings.objects.size(), 2u);
    EXPECT_TRUE(ui.state.history.undo().objects.empty()) << "one step";
}

TEST_F(ObjectsPanel, HeadersSort) {
    const auto header = [&](int column) {
        return glm::vec2(table()->Columns[column].MinX + 12, table()->OuterRect.Min.y + 9);
    };
    const auto above = [&](const char* a, const char* b) {
        const auto first = row(a), second = row(b);
        return first && (!second || first->y < second->y);
    };
    EXPECT_TRUE(above("Stage/Ground", "Stage/Wall")) << "as the file has it";
    for (const Node& node : ui.scene.nodes)
        if (node.path != "Stage") ui.state.objects.closed_nodes.insert(node.path);
    ui.click(header(1));
    ASSERT_EQ(table()->SortSpecsCount, 1);
    ASSERT_EQ(table()->Columns[1].SortDirection, int(ImGuiSortDirection_Descending));
    const auto triangles = [&](const std::string& path) {
        std::size_t n = 0;
        for (const Object& o : ui.scene.objects)
            if (ui.scene.nodes[std::size_t(o.node)].path == path)
                n += ui.scene.meshes[std::size_t(o.mesh)].indices.size() / 3;
        return n;
    };
    ASSERT_GT(triangles("Stage/Plinth"), triangles("Stage/Ground"));
    EXPECT_TRUE(above("Stage/Plinth", "Stage/Ground")) << "the most first";
    ui.click(header(0));
    EXPECT_TRUE(above("Stage/Ground", "Stage/Plinth")) << "by name";
}

TEST(Pick, FindsTheFirstHitOfTheRay) {
    const Scene scene = load_scene("boxes");
    Settings s;
    const Camera camera = make_camera(scene, s, 1.5);
    const PictureView view{camera, {0, 0}, {600, 400}, 1};
    int met = 0, above = 0;
    for (const Object& o : scene.objects) {
        const Bounds b = scene.meshes[std::size_t(o.mesh)].bounds.transformed(o.world);
        // A ray straight down, from above the centre.
        const Ray ray{b.centre() + glm::dvec3(0, 100, 0), {0, -1, 0}, 0};
        const std::string found = object_at(scene, ray);
        ASSERT_FALSE(found.empty());
        met += found == scene.nodes[std::size_t(o.node)].path;
        EXPECT_EQ(object_at(scene, {ray.origin, {0, 1, 0}, 0}), "") << "nothing above";
        if (b.lo.y < 0.01) continue;  // it ends at the floor
        EXPECT_EQ(object_at(scene, {b.centre() - glm::dvec3(0, 100, 0), {0, 1, 0}, 0}), "Boxes/Floor");
        ++above;
    }
    EXPECT_GE(above, 1);
    EXPECT_GE(met, int(scene.objects.size()) - 1) << "but the floor, on which one stands";
    EXPECT_EQ(object_at(scene, view.ray({300, 1})), "") << "the sky";
}

class SceneMenu : public testing::Test {
protected:
    SceneMenu() {
        ui.state.settings.view.frustum = false;
        ui.frames(3);
        ui.state.history.reset(ui.state.settings);
        EXPECT_TRUE(ui.state.viewport.view);
    }
    bool open() const { return ImGui::IsPopupOpen(nullptr, ImGuiPopupFlags_AnyPopup); }
    void click(const char* item) { ui.click(ui.find("##Popup", "", item)); }
    const glm::vec2 at{300, 330};
    UiHarness ui{1280, 720};
};

TEST_F(SceneMenu, RightClickOpensItAndRightDragFlies) {
    const Settings before = ui.state.settings;
    ui.click(at, 1);
    EXPECT_TRUE(open());
    EXPECT_EQ(ui.state.settings, before) << "nothing moved";
    const PictureView& view = *ui.state.viewport.view;
    EXPECT_EQ(ui.state.selection.first, object_at(ui.scene, view.ray({at.x, at.y})));
    ASSERT_FALSE(ui.state.selection.first.empty());
    ui.click({5, 400});
    ASSERT_FALSE(open());
    ui.drag(at, at + glm::vec2(40, 10), 1);
    EXPECT_FALSE(open());
    EXPECT_NE(ui.state.settings.camera, before.camera);
}

TEST_F(SceneMenu, ItemsChangeAllSelectedObjects) {
    ui.click(at, 1);
    const std::string first = ui.state.selection.first;
    click("Casts");
    EXPECT_FALSE(ui.state.settings.objects[first].cast);
    EXPECT_EQ(ui.state.settings.objects.size(), 1u);
    ui.click(at, 1);
    click("Let all cast");
    EXPECT_TRUE(ui.state.settings.objects.empty());
    toggle_object(ui.state, first == "Stage/Wall" ? "Stage/Plinth" : "Stage/Wall");
    ui.click(at, 1);
    click("Let only this cast");
    std::size_t casting = 0;
    for (const Object& o : ui.scene.objects) {
        const auto own = ui.state.settings.objects.find(ui.scene.nodes[std::size_t(o.node)].path);
        casting += own == ui.state.settings.objects.end();
    }
    EXPECT_GE(casting, 2u);
    EXPECT_LT(casting, ui.scene.objects.size());
    for (const std::string& path : selected_objects(ui.state)) EXPECT_FALSE(ui.state.settings.objects.count(path));
    EXPECT_TRUE(ui.state.history.undo().objects.empty());
}

TEST_F(SceneMenu, ObjectsAreHiddenIsolatedAndShownAgain) {
    const auto hidden = [&] {
        std::set<std::string> paths;
        for (const auto& [path, own] : ui.state.settings.objects)
            if (!own.shown) paths.insert(path);
        return paths;
    };
    ui.click(at, 1);
    const std::string first = ui.state.selection.first;
    click("Hide");
    EXPECT_EQ(hidden(), std::set<std::string>{first});
    ui.click(at, 1);
    click("Show all");
    EXPECT_TRUE(ui.state.settings.objects.empty());
    const auto key = [&](bool shift, bool alt) {
        ImGuiIO& io = ImGui::GetIO();
        io.KeyShift = shift;
        io.KeyAlt = alt;
        io.KeysDown['H'] = true;
        ui.frames(2);
        io.KeyShift = io.KeyAlt = io.KeysDown['H'] = false;
        ui.frames(2);
    };
    key(false, false);
    EXPECT_EQ(hidden(), std::set<std::string>{first});
    key(false, true);
    EXPECT_TRUE(ui.state.settings.objects.empty());
    key(true, false);
    EXPECT_FALSE(hidden().contains(first));
    EXPECT_EQ(hidden().size() + 1, mesh_nodes_below(ui.scene, 0).size()) << "all others";
    select_objects(ui.state, {});
    key(false, true);
    key(false, false);
    EXPECT_TRUE(ui.state.settings.objects.empty());
    ASSERT_FALSE(ui.state.log.lines().empty()) << "it says why nothing is hidden";
    EXPECT_NE(ui.state.log.lines().back().text.find("Nothing is selected"), std::string::npos);
}

SI_TEST_IS(Later, ObjectsPanel, HiddenObjectsStayListedAndAButtonShowsThem);
TEST_F(ObjectsPanel, HiddenObjectsStayListedAndAButtonShowsThem) {
    hide(ui.state.settings, {"Stage/Plinth"});
    hide_objects(ui.scene, {"Stage/Plinth"});
    EXPECT_TRUE(row("Stage/Plinth"));
    EXPECT_FALSE(bounds_of(ui.scene, "Stage/Plinth").empty()) << "F frames it";
    ui.click(ui.find("objects_", "", "Show all"));
    EXPECT_TRUE(all_shown(ui.state.settings));
    EXPECT_FALSE(ui.find("objects_", "", "Show all"));
}

TEST_F(SceneMenu, FramesTheObject) {
    ui.click(at, 1);
    const Bounds b = bounds_of(ui.scene, ui.state.selection.first);
    click("Frame");
    EXPECT_NEAR(ui.state.settings.camera.target_x, b.centre().x, 1e-9);
}

}  // namespace
}  // namespace si::test
