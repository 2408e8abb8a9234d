// Tests of the panels around presets: strips, menu, comparison, dialogs; nothing is cut off at any size, every button
// works.
#include <gtest/gtest.h>
#include <imgui.h>
#include <imgui_internal.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "app/session/presets.h"
#include "renderer/settings/param.h"
#include "tests/support/process.h"
#include "tests/support/traits.h"
#include "tests/ui/ui_harness.h"

namespace si::test {
namespace {

namespace fs = std::filesystem;

std::vector<PresetEntry> entries(const std::vector<BuiltinPreset>& presets) {
    std::vector<PresetEntry> list;
    for (const BuiltinPreset& p : presets) list.push_back({p.key, p.title, p.topic, p.about});
    return list;
}
std::vector<PresetEntry> guided() {
    return entries(builtin_presets());
}
std::vector<PresetEntry> hard() {
    return entries(hard_case_presets());
}

constexpr auto window_of = UiHarness::window;

/// Clicks along a row of pixels until a request is made. Returns the requests of that frame.
template <class Requested>
std::optional<EditorRequests> click_along(UiHarness& ui, float x0, float x1, float y, Requested requested) {
    for (float x = x0; x < x1; x += 6) {
        ui.move({x, y});
        ui.frames(2);
        if (const EditorRequests requests = ui.click_here(); requested(requests)) return requests;
        if (const EditorRequests requests = ui.frame(); requested(requests)) return requests;
    }
    return {};
}

/// Key codes of the page keys: without an open menu the editor hides them from ImGui.
constexpr int kPageUp = 401, kPageDown = 402;
void map_page_keys() {
    ImGui::GetIO().KeyMap[ImGuiKey_PageUp] = kPageUp;
    ImGui::GetIO().KeyMap[ImGuiKey_PageDown] = kPageDown;
}
/// Presses Enter in a file dialog. Returns the requests of the press, or of the release if the press requests no file.
EditorRequests confirmed(UiHarness& ui) {
    const int enter = ImGui::GetKeyIndex(ImGuiKey_Enter);
    ImGui::GetIO().KeysDown[enter] = true;
    const EditorRequests pressed = ui.frame();
    ImGui::GetIO().KeysDown[enter] = false;
    const EditorRequests released = ui.frame();
    return pressed.open_file || pressed.save_preset ? pressed : released;
}

class PresetPanels : public testing::TestWithParam<std::tuple<int, int, float>> {};

TEST_P(PresetPanels, NothingIsCutOffAndPicturesKeepTheirSpace) {
    const auto [w, h, scale] = GetParam();
    UiHarness ui(w, h, scale);
    const EditorRequests bare = ui.frames(4);
    ui.presets = guided();
    ui.hard_cases = hard();
    ui.lost = LostFacts{"/a/rather/long/folder/name/with/a/scene of many words.glb", "less than a minute ago"};
    std::vector<PresetEntry> all = ui.presets;
    all.insert(all.end(), ui.hard_cases.begin(), ui.hard_cases.end());
    std::optional<int> guided_height;
    for (const PresetEntry& p : all) {
        ui.state.files.guide = {p.key, p.title, p.about};
        const EditorRequests requests = ui.frames(3);
        // The comparison view stays while presets are stepped.
        if (&p < &all[ui.presets.size()]) {
            if (!guided_height) guided_height = requests.scene_height;
            EXPECT_EQ(requests.scene_height, *guided_height) << p.key;
        }
        for (const char* name : {"guide", "lost session"}) {
            const ImGuiWindow* strip = window_of(name);
            ASSERT_TRUE(strip) << p.key << " " << name;
            EXPECT_EQ(strip->ScrollMax.y, 0) << p.key << " is cut off in " << name;
            EXPECT_EQ(strip->ScrollMax.x, 0) << p.key << " is cut off in " << name;
            EXPECT_LE(strip->Pos.x + strip->Size.x, float(w));
        }
        EXPECT_EQ(requests.scene_width, bare.scene_width);
        EXPECT_GT(requests.scene_height, h / 8) << p.key;
    }
    ui.state.files.dialog = {};
    open_file_dialog(ui.state.files.dialog, FileDialog::Job::SavePreset,
                     fs::path(SI_SOURCE_DIR) / "assets/presets/x.json");
    ui.frames(3);
    const ImGuiWindow* dialog = window_of("Save the preset as");
    ASSERT_TRUE(dialog);
    EXPECT_EQ(dialog->ScrollMax.y, 0) << "the dialog is cut off";
    EXPECT_LE(dialog->Pos.y + dialog->Size.y, float(h));
    EXPECT_GE(dialog->Pos.x, 0);
}

INSTANTIATE_TEST_SUITE_P(Sizes, PresetPanels,
                         testing::Values(std::tuple{1280, 720, 1.0f}, std::tuple{1920, 1080, 1.0f},
                                         std::tuple{3840, 2160, 2.0f}, std::tuple{700, 480, 1.0f}));

SI_TEST_IS(Later, PresetStrips, ButtonsWalkHideRestoreAndDiscard);
TEST(PresetStrips, ButtonsWalkHideRestoreAndDiscard) {
    UiHarness ui(1280, 720);
    ui.presets = guided();
    const PresetEntry& second = ui.presets[1];
    ui.state.files.guide = {second.key, second.title, second.about};
    ui.frames(3);
    const auto row = [](const char* name) {
        const ImGuiWindow* w = window_of(name);
        return glm::vec4(w->Pos.x, w->Pos.x + w->Size.x, w->Pos.y + ImGui::GetFrameHeight() * 0.75f, 0);
    };
    const glm::vec4 at = row("guide");
    const auto loads = [](const EditorRequests& a) { return a.load_preset.has_value(); };
    const auto before = click_along(ui, at.x, at.y, at.z, loads);
    ASSERT_TRUE(before);
    EXPECT_EQ(*before->load_preset, ui.presets[0].key);
    const auto loads_third = [&](const EditorRequests& a) { return a.load_preset == ui.presets[2].key; };
    EXPECT_TRUE(click_along(ui, at.x, at.y, at.z, loads_third));
    click_along(ui, at.y - 50, at.y, at.z, [&](const EditorRequests&) { return !ui.state.files.hidden_guide.empty(); });
    EXPECT_EQ(ui.state.files.hidden_guide, second.key);
    ui.frames(2);
    EXPECT_FALSE(window_of("guide")) << "hidden";

    ui.lost = LostFacts{"boxes", "3 minutes ago"};
    ui.frames(3);
    EXPECT_TRUE(ui.drawn().shows("The last session has unsaved changes"));
    const glm::vec4 lost = row("lost session");
    EXPECT_TRUE(click_along(ui, lost.x, lost.y, lost.z, [](const EditorRequests& a) { return a.restore_lost; }));
    EXPECT_TRUE(click_along(ui, lost.x, lost.y, lost.z, [](const EditorRequests& a) { return a.discard_lost; }));

    ui.state.scene_name = "/a/model.glb";
    ui.scene_saved = true;
    ui.frames(3);
    EXPECT_TRUE(ui.drawn().shows("model.glb was saved by another program"));
    const glm::vec4 saved = row("saved scene");
    EXPECT_TRUE(click_along(ui, saved.x, saved.y, saved.z, [](const EditorRequests& a) { return a.reload_scene; }));
    EXPECT_TRUE(click_along(ui, saved.x, saved.y, saved.z, [](const EditorRequests& a) { return a.keep_scene; }));
}

TEST(PresetStrips, FarObjectsAreNamedAndOneClickFramesAll) {
    UiHarness ui(1280, 720);
    ui.frames(3);
    EXPECT_FALSE(window_of("far objects"));
    ui.scene.far_objects = "node 'Rock' reaches 1e+06 m from the rest";
    ui.frames(3);
    EXPECT_TRUE(ui.drawn().shows("node 'Rock' reaches 1e+06 m from the rest"));
    ui.click(ui.find("far objects", "", "Frame all"));
    ui.frames(2);
    EXPECT_EQ(ui.state.settings.camera, (CameraSettings{.index = -1}));
    EXPECT_FALSE(window_of("far objects"));
    ui.state.settings.camera = {};
    ui.frames(3);
    ui.click(ui.find("far objects", "", "Hide"));
    ui.frames(2);
    EXPECT_FALSE(window_of("far objects"));
    EXPECT_EQ(ui.state.settings.camera, CameraSettings{});
}

TEST(PresetStrips, SettingsLostByTheDriverAreSavedAtOnceOrUnderAnotherName) {
    UiHarness ui(1280, 720);
    ui.state.files.preset_path = "mine.json";
    ui.frames(3);
    EXPECT_FALSE(window_of("driver reset"));
    ui.driver_reset = true;
    ui.frames(3);
    const ImGuiWindow* strip = window_of("driver reset");
    ASSERT_TRUE(strip);
    const float left = strip->Pos.x, right = left + strip->Size.x, y = strip->Pos.y + ImGui::GetFrameHeight() * 0.75f;
    const auto saves = [](const EditorRequests& a) { return a.save_preset.has_value(); };
    const auto saved = click_along(ui, left, right, y, saves);
    ASSERT_TRUE(saved);
    EXPECT_EQ(*saved->save_preset, "mine.json");
    click_along(ui, left, right, y, [](const EditorRequests&) { return window_of("Save the preset as") != nullptr; });
    EXPECT_TRUE(window_of("Save the preset as"));
}

TEST(PresetStrips, FileWithoutASentenceShowsNone) {
    UiHarness ui(1280, 720);
    ui.state.files.guide = {"/a/b.json", "Title", ""};
    ui.frames(3);
    EXPECT_FALSE(window_of("guide"));
}

TEST(PresetKeys, PageKeysStepPresetsUnlessAPopupIsOpen) {
    UiHarness ui(1280, 720);
    map_page_keys();
    ui.presets = guided();
    ui.frames(2);
    EXPECT_EQ(ui.key(kPageDown).load_preset, ui.presets.front().key);
    EXPECT_EQ(ui.key(kPageUp).load_preset, ui.presets.back().key) << "from nowhere backwards: the last";
    ui.state.files.guide.key = ui.presets.back().key;
    EXPECT_EQ(ui.key(kPageDown).load_preset, std::nullopt);
    EXPECT_EQ(ui.key(kPageUp).load_preset, ui.presets[ui.presets.size() - 2].key);
    ui.state.window.show_shortcuts = true;
    ui.frames(2);
    EXPECT_EQ(ui.key(kPageUp).load_preset, std::nullopt);
}

TEST(Gallery, ShowsSentencesByTopicAndOpensTheClickedPreset) {
    UiHarness ui(1280, 720);
    ui.presets = guided();
    ui.frames(2);
    click_along(ui, 230, 400, 19, [](const EditorRequests&) { return window_of("##Popup") != nullptr; });
    ui.frames(3);
    const ImGuiWindow* menu = window_of("##Popup");
    ASSERT_TRUE(menu) << "the button was not found";
    EXPECT_LE(menu->Pos.y + menu->Size.y, 720.5f);
    EXPECT_EQ(menu->ScrollMax.x, 0);
    const ImGuiWindow* list = window_of("/list_");
    ASSERT_TRUE(list);
    EXPECT_GT(list->ScrollMax.y, 500) << "forty presets do not fit one screen";
    const auto chosen = click_along(ui, list->Pos.x + 150, list->Pos.x + 180, list->Pos.y + 60,
                                    [](const EditorRequests& a) { return a.load_preset.has_value(); });
    ASSERT_TRUE(chosen);
    EXPECT_EQ(*chosen->load_preset, ui.presets.front().key);
}

/// Opens the gallery of guided presets or hard cases.
void open_gallery(UiHarness& ui, const char* button) {
    ui.click(ui.find("editor/top", "", button));
    ui.frames(3);
    ASSERT_TRUE(window_of("/list_"));
}

TEST(Gallery, SearchListsOnlyWhatHasAllWordsAndEnterOpensTheFirst) {
    UiHarness ui(1280, 720);
    ui.presets = guided();
    ui.hard_cases = hard();
    ui.frames(2);
    ASSERT_NO_FATAL_FAILURE(open_gallery(ui, "Guided presets"));
    ui.type("peter");
    ui.frames(2);
    EXPECT_FALSE(ui.drawn().shows(ui.presets.front().title)) << "acne is another thing";
    EXPECT_EQ(ui.state.gallery.search, "peter") << "the search has the keyboard at once";
    EXPECT_TRUE(ui.key(ImGui::GetKeyIndex(ImGuiKey_Enter)).load_preset.has_value());
    ui.frames(2);
    ASSERT_NO_FATAL_FAILURE(open_gallery(ui, "Guided presets"));
    EXPECT_EQ(ui.state.gallery.search, "") << "it begins with all";
    ui.type("zzzz");
    ui.frames(2);
    EXPECT_TRUE(ui.drawn().shows("Nothing has all these words."));
}

TEST(Gallery, HardCasesArePairsBesideEachOther) {
    UiHarness ui(1600, 900);
    ui.hard_cases = hard();
    ui.frames(2);
    ASSERT_NO_FATAL_FAILURE(open_gallery(ui, "Hard cases"));
    const auto place = [&](const std::string& title) {
        std::u32string text;
        for (const char c : title)
            if (c != ' ') text += char32_t(static_cast<unsigned char>(c));
        return ui.drawn().find(text);
    };
    const auto broken = place(ui.hard_cases[0].title), fixed = place(ui.hard_cases[1].title);
    ASSERT_TRUE(broken && fixed) << ui.hard_cases[0].title << ", " << ui.hard_cases[1].title;
    EXPECT_NEAR(broken->y, fixed->y, 1);
    EXPECT_GT(fixed->x, broken->x + 200);
    ui.move({fixed->x, fixed->y});
    ui.frames(2);
    EditorRequests requests = ui.click_here();
    if (!requests.load_preset) requests = ui.frame();
    EXPECT_EQ(requests.load_preset, ui.hard_cases[1].key);
}

TEST(Gallery, RequestsPicturesOfWhatIsOnTheScreenOnly) {
    UiHarness ui(1280, 720);
    ui.presets = guided();
    EXPECT_TRUE(ui.frames(3).want_pictures.empty()) << "it is closed";
    ASSERT_NO_FATAL_FAILURE(open_gallery(ui, "Guided presets"));
    const std::vector<std::string> wanted = ui.frame().want_pictures;
    ASSERT_FALSE(wanted.empty());
    EXPECT_EQ(wanted.front(), ui.presets.front().key);
    EXPECT_LT(wanted.size(), 20u);
    ui.presets.front().picture = 1;
    EXPECT_EQ(ui.frame().want_pictures.front(), ui.presets[1].key) << "the first has one";
}

TEST(HardCasesMenu, OpensTheClickedCaseAndPageKeysStepOnlyCases) {
    UiHarness ui(1280, 720);
    map_page_keys();
    ui.presets = guided();
    ui.hard_cases = hard();
    ui.frames(2);
    const auto opened = [](const EditorRequests&) { return window_of("##Popup") != nullptr; };
    std::optional<EditorRequests> chosen;
    // To the right of the guided presets: the first popup that lists hard cases.
    for (float x = 380; x < 620 && !(chosen && chosen->load_preset->starts_with("hard/")); x += 24) {
        if (!click_along(ui, x, x + 6, 19, opened)) continue;
        ui.frames(3);
        const ImGuiWindow* menu = window_of("/list_");
        ASSERT_TRUE(menu);
        EXPECT_EQ(menu->ScrollMax.x, 0);
        chosen = click_along(ui, menu->Pos.x + 150, menu->Pos.x + 180, menu->Pos.y + 60,
                             [](const EditorRequests& a) { return a.load_preset.has_value(); });
        ui.frames(2);
    }
    ASSERT_TRUE(chosen) << "the button was not found";
    EXPECT_EQ(*chosen->load_preset, ui.hard_cases.front().key);
    ui.state.files.guide.key = ui.hard_cases[1].key;
    EXPECT_EQ(ui.key(kPageDown).load_preset, ui.hard_cases[2].key);
    ui.state.files.guide.key = ui.hard_cases.back().key;
    EXPECT_EQ(ui.key(kPageDown).load_preset, std::nullopt) << "the walk ends";
}

TEST(Comparison, ListsDifferencesForEveryKindOfSetting) {
    UiHarness ui(1280, 720);
    ui.recent_presets = {"/a/one.json"};
    ui.presets = guided();
    for (const CompareKind kind : {CompareKind::Scene, CompareKind::Defaults, CompareKind::Preset}) {
        ui.state.compare = {kind, kind == CompareKind::Preset ? "/a/one.json" : ""};
        Settings other;
        for (const Param& p : params()) {
            const SettingRef ref{&p, 2, p.scope == Scope::Object ? "Root/Box" : ""};
            const Value v = default_value(ref);
            if (const bool* b = std::get_if<bool>(&v)) set_value(other, ref, !*b);
            if (const int* i = std::get_if<int>(&v)) set_value(other, ref, *i + 1);
            if (const double* d = std::get_if<double>(&v)) set_value(other, ref, *d + 0.5);
            if (is_text(p)) set_value(other, ref, "key");
        }
        ui.comparison = ComparisonFacts{ui.state.compare, other, "plane", {}};
        ui.state.window.open_page = Page::Compare;
        ui.frames(3);
        ASSERT_TRUE(ui.state.shows(Page::Compare));
        EXPECT_EQ(ui.state.settings, Settings{}) << "drawing changed something";
    }
    ui.comparison->problem = "/a/one.json: no such file";
    ui.frames(3);
    ui.comparison.reset();
    ui.frames(3);
}

TEST(FileDialogs, SaveByNameAndOpenByDoubleClick) {
    const fs::path folder = fresh_test_folder();
    fs::create_directory(folder / "below");
    for (const char* name : {"b.json", "A.glb", "notes.txt", ".hidden.json"}) std::ofstream(folder / name) << "x";
    UiHarness ui(1280, 720);
    FileDialog& dialog = ui.state.files.dialog;
    open_file_dialog(dialog, FileDialog::Job::Open, folder / "x.json");
    ASSERT_EQ(dialog.entries.size(), 3u);
    EXPECT_TRUE(dialog.entries[0].folder && dialog.entries[0].name == "below");
    EXPECT_EQ(dialog.entries[1].name, "A.glb");
    EXPECT_EQ(dialog.entries[2].name, "b.json");
    ui.frames(3);
    ui.type("b.json");
    EXPECT_EQ(confirmed(ui).open_file, (fs::weakly_canonical(folder) / "b.json").string());
    ui.frames(3);
    EXPECT_FALSE(window_of("Open a model, map, bundle, capture or preset")) << "it closes";

    open_file_dialog(dialog, FileDialog::Job::SavePreset, folder / "mine", "Look.");
    EXPECT_EQ(dialog.entries.size(), 2u) << "no scenes among presets";
    ui.frames(3);
    const EditorRequests saved = confirmed(ui);
    ASSERT_TRUE(saved.save_preset);
    EXPECT_EQ(*saved.save_preset, (fs::weakly_canonical(folder) / "mine.json").string());
    EXPECT_EQ(saved.save_about, "Look.");
    EXPECT_FALSE(saved.replace);

    open_file_dialog(dialog, FileDialog::Job::Open, folder / "no such folder" / "x.json");
    EXPECT_TRUE(dialog.problem.empty()) << "a folder that is gone: the current one instead";
    EXPECT_EQ(dialog.folder, fs::weakly_canonical(fs::current_path()));
}

TEST(FileDialogs, BundlesAreListedAsFilesAndChosenForTheirSetting) {
    const fs::path folder = fresh_test_folder();
    fs::create_directories(folder / "a.bundle");
    fs::create_directories(folder / "below");
    for (const char* name : {"a.bundle/frame.json", "b.zip", "c.glb", "d.json"}) std::ofstream(folder / name) << "x";
    UiHarness ui(1280, 720);
    FileDialog& dialog = ui.state.files.dialog;
    open_bundle_dialog(dialog, "map.bundle", folder / "x");
    ASSERT_EQ(dialog.entries.size(), 3u);
    EXPECT_TRUE(dialog.entries[0].folder && dialog.entries[0].name == "below");
    EXPECT_TRUE(!dialog.entries[1].folder && dialog.entries[1].name == "a.bundle");
    EXPECT_EQ(dialog.entries[2].name, "b.zip");
    ui.frames(3);
    ui.type("a.bundle");
    EXPECT_FALSE(confirmed(ui).open_file) << "it becomes a setting";
    ui.frames(3);
    EXPECT_EQ(ui.state.settings.map.bundle, (fs::weakly_canonical(folder) / "a.bundle").string());
    EXPECT_FALSE(window_of("Choose a bundle")) << "it closes";

    open_file_dialog(dialog, FileDialog::Job::Open, folder / "x");
    EXPECT_EQ(dialog.entries.size(), 5u);
    ui.frames(3);
    ui.type("a.bundle");
    EXPECT_EQ(confirmed(ui).open_file, (fs::weakly_canonical(folder) / "a.bundle").string()) << "as a scene";
}

TEST(FileDialogs, TypedFolderIsEnteredAndTypingContinues) {
    const fs::path folder = fs::weakly_canonical(fresh_test_folder());
    fs::create_directory(folder / "below");
    std::ofstream(folder / "below" / "b.json") << "x";
    UiHarness ui(1280, 720);
    open_file_dialog(ui.state.files.dialog, FileDialog::Job::Open, folder / "x.json");
    ui.frames(3);
    ui.type((folder / "below").string());
    confirmed(ui);
    ui.frames(2);
    ASSERT_EQ(ui.state.files.dialog.folder, folder / "below");
    ui.type("b.json");
    EXPECT_EQ(confirmed(ui).open_file, (folder / "below/b.json").string());
}

TEST(FileDialogs, ListsOneKindWithDatesAndRecentFolders) {
    const fs::path folder = fs::weakly_canonical(fresh_test_folder());
    fs::create_directory(folder / "elsewhere");
    for (const char* name : {"b.json", "a.glb", "elsewhere/c.gltf"}) std::ofstream(folder / name) << "x";
    UiHarness ui(1280, 720);
    ui.recent_scenes = {(folder / "elsewhere/c.gltf").string()};
    FileDialog& dialog = ui.state.files.dialog;
    open_file_dialog(dialog, FileDialog::Job::Open, folder / "x.json");
    ui.frames(4);
    ASSERT_EQ(dialog.entries.size(), 3u);
    for (const FileDialog::Entry& e : dialog.entries) {
        EXPECT_EQ(e.date.size(), std::string("2026-01-31 23:59").size()) << e.name;
        EXPECT_TRUE(ui.drawn().shows(e.date)) << e.name;
    }
    const auto press = [&](const char* window, const char* label) {
        ui.click(ui.find(window, "", label));
        ui.frames(2);
    };
    press("Open a model, map, bundle, capture or preset", "##kind");
    const auto models = ui.drawn().find(U"models", 0);
    ASSERT_TRUE(models);
    ui.click({models->x, models->y});
    ui.frames(2);
    EXPECT_EQ(dialog.entries.size(), 2u) << "a folder and a model";
    press("Open a model, map, bundle, capture or preset", "Recent");
    press("##Popup", (folder / "elsewhere").string().c_str());
    EXPECT_EQ(dialog.folder, folder / "elsewhere");
    ASSERT_EQ(dialog.entries.size(), 1u);
    EXPECT_EQ(dialog.entries[0].name, "c.gltf");
}

TEST(FileDialogs, TabCompletesAPathUpToItsAmbiguity) {
    const fs::path folder = fresh_test_folder();
    fs::create_directories(folder / "models/fox");
    for (const char* name : {"models/fox/fox.glb", "models/forest.glb", "models/fort.txt", "my.json"})
        std::ofstream(folder / name) << "x";
    const auto completed = [&](const char* typed, FileDialog::Kind kind = FileDialog::Kind::All) {
        return completed_path(folder, typed, FileDialog::Job::Open, kind);
    };
    EXPECT_EQ(completed("mo"), "models/");
    EXPECT_EQ(completed("m"), "m") << "models/ or my.json";
    EXPECT_EQ(completed("m", FileDialog::Kind::Models), "models/");
    EXPECT_EQ(completed("models/f"), "models/fo");
    EXPECT_EQ(completed("models/for"), "models/forest.glb") << "what is not listed does not count";
    EXPECT_EQ(completed("models/fox/"), "models/fox/fox.glb");
    EXPECT_EQ(completed("nothing"), "nothing");
    EXPECT_EQ(completed((folder.string() + "/my").c_str()), folder.string() + "/my.json");
    // The key works in the dialog too.
    UiHarness ui(1280, 720);
    open_file_dialog(ui.state.files.dialog, FileDialog::Job::Open, folder / "x.json");
    ui.frames(3);
    ui.type("models/for");
    ui.key(ImGui::GetKeyIndex(ImGuiKey_Tab));
    ui.frame();
    EXPECT_EQ(confirmed(ui).open_file, (fs::weakly_canonical(folder) / "models/forest.glb").string());
}

TEST(FileDialogs, ReplacingAsksFirst) {
    UiHarness ui(1280, 720);
    ui.state.files.replace = Replacement{"/a/b.json", "Look."};
    ui.frames(3);
    const ImGuiWindow* question = window_of("Replace the file?");
    ASSERT_TRUE(question);
    const float left = question->Pos.x, right = left + question->Size.x;
    const float y = question->Pos.y + question->Size.y - ImGui::GetFrameHeight() * 0.8f;
    const auto agreed =
        click_along(ui, left, right, y, [](const EditorRequests& a) { return a.save_preset.has_value(); });
    ASSERT_TRUE(agreed);
    EXPECT_EQ(*agreed->save_preset, "/a/b.json");
    EXPECT_EQ(agreed->save_about, "Look.");
    EXPECT_TRUE(agreed->replace);
    EXPECT_FALSE(ui.state.files.replace);
    ui.state.files.replace = Replacement{"/a/b.json", {}};
    ui.frames(3);
    EXPECT_FALSE(ui.key(ImGui::GetKeyIndex(ImGuiKey_Escape)).save_preset);
    EXPECT_FALSE(ui.state.files.replace);
}

TEST(FileDialogs, ReplacingSavedErrorsAsksFirst) {
    UiHarness ui(1280, 720);
    ui.state.files.replace = Replacement{.path = "/a/error.json", .errors = true};
    ui.frames(3);
    EXPECT_EQ(ui.lacking({"/a/error.json exists. Its contents would be lost."}), "");
    const auto at = ui.find("Replace the file?", "", "Replace");
    ASSERT_TRUE(at);
    ui.move(*at);
    ui.frames(2);
    const EditorRequests agreed = ui.click_here();
    EXPECT_EQ(agreed.save_error, "/a/error.json");
    EXPECT_TRUE(agreed.replace);
    EXPECT_FALSE(agreed.save_preset);
    EXPECT_FALSE(ui.state.files.replace);
}

}  // namespace
}  // namespace si::test
