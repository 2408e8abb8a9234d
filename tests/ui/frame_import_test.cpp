// Tests of frames of other engines in the editor: captures through a helper that tests replace, images of maps, and the
// export of the shown frame as a bundle.
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/stat.h>

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>
#include <vector>

#include "app/editor/persistence.h"
#include "renderer/settings/param.h"
#include "tests/support/process.h"
#include "tests/support/traits.h"
#include "tests/ui/test_editor.h"
#include "tests/ui/ui_harness.h"
#include "ui/scene_view/camera_steering.h"
#include "ui/state/scene_choices.h"
#include "ui/widgets/free_name.h"

namespace si::test {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

/// Interpreter of the capture helper, replaced by a script for the life of this object.
class ScriptedHelper {
public:
    ScriptedHelper(const fs::path& folder, const std::string& script) {
        const fs::path file = folder / "python";
        std::ofstream(file) << "#!/bin/sh\n" << script << "\n";
        ::chmod(file.c_str(), 0755);
        ::setenv("SI_CAPTURE_PYTHON", file.c_str(), 1);
    }
    ~ScriptedHelper() { ::unsetenv("SI_CAPTURE_PYTHON"); }
    ScriptedHelper(const ScriptedHelper&) = delete;
    ScriptedHelper& operator=(const ScriptedHelper&) = delete;
};

/// Returns a script that lists two maps, and writes a copy of `bundle`. It notes its picks in `picks`.
std::string listing_script(const fs::path& bundle, const fs::path& picks) {
    return R"(for word in "$@"; do
case "$word" in
--list) list=1;;
--pick=*) echo "$word" >> ')" +
           picks.string() + R"(';;
--output=*) out="${word#--output=}";;
esac; done
echo '{"progress": 0.5, "label": "looking at passes"}'
if [ "$list" ]; then
echo '{"candidate": {"number": 0, "texture": 242, "slice": 0, "layers": 2, "width": 64, "height": 64, "format": "D16", "draws": 30, "light": "directional"}}'
echo '{"candidate": {"number": 1, "texture": 242, "slice": 1, "layers": 2, "width": 64, "height": 64, "format": "D16", "draws": 16, "light": "spot or point"}}'
exit 0
fi
cp -r ')" + bundle.string() +
           R"('/. "$out"
echo '{"done": true, "notes": ["one look-up has no sampler"], "gate": [{"name": "sun 0", "passed": true, "captured_texels": 9, "draws": 3}, {"name": "sun 1", "passed": false, "captured_texels": 9, "draws": 3, "missed": 4}]}')";
}

/// Editor with a folder of its own, whose requests tests make.
class FrameImports : public testing::Test {
protected:
    FrameImports() {
        EditorOptions options = editor_options("boxes", {"map.resolution=256"}, {640, 400});
        options.state_folder = folder_ / "state";
        editor_.emplace(options);
        std::ofstream(folder_ / "a.rdc") << "RDOC and nothing else";
    }
    TestEditor& editor() { return *editor_; }
    EditorState& state() { return editor_->state(); }
    std::optional<ImportFacts> importing() { return editor_->facts().importing; }
    /// Fulfils one request, and waits until nothing changes any more.
    void ask(const std::function<void(EditorRequests&)>& what) {
        ask_only(what);
        editor_->settle();
    }
    void ask_only(const std::function<void(EditorRequests&)>& what) {
        EditorRequests requests = editor_->requests();
        what(requests);
        editor_->model().fulfil(requests);
    }
    void start() {
        ask([](EditorRequests& r) { r.start_import = true; });
    }
    void write() {
        ask([](EditorRequests& r) { r.write_import = true; });
    }
    void export_to(const fs::path& path, bool replace = false) {
        ask([&](EditorRequests& r) {
            r.export_file = ExportRequest{ExportKind::Bundle, path.string()};
            r.replace = replace;
        });
    }
    /// Returns the last line of the log with this text and kind; empty: none.
    std::string logged(std::string_view text, LogKind kind) {
        std::string out;
        for (const LogLine& line : state().log.lines())
            if (line.kind == kind && line.text.find(text) != std::string::npos) out = line.text;
        return out;
    }
    /// Returns the names of files beside the editor's own in the folder.
    std::vector<std::string> files() const {
        std::vector<std::string> out;
        for (const auto& entry : fs::directory_iterator(folder_))
            if (entry.path().filename() != "state") out.push_back(entry.path().filename().string());
        std::ranges::sort(out);
        return out;
    }
    bool shows_imported_maps() {
        const FrameResult* const frame = editor_->facts().result;
        return frame && !frame->imported.empty() && frame->imported[0] && frame->imported[0]->views;
    }

    const fs::path folder_ = fs::weakly_canonical(fresh_test_folder());
    std::optional<TestEditor> editor_;
};

std::map<std::string, std::string> contents_of(const fs::path& bundle) {
    std::map<std::string, std::string> out;
    for (const auto& entry : fs::recursive_directory_iterator(bundle))
        if (entry.is_regular_file()) out[entry.path().lexically_relative(bundle).string()] = file_bytes(entry.path());
    return out;
}

SI_TEST_IS(Later, FrameImports, ExportWritesMapsOfTheFrozenCamera);
TEST_F(FrameImports, ExportWritesMapsOfTheFrozenCamera) {
    const fs::path own = folder_ / "own.bundle", flown = folder_ / "flown.bundle", cascades = folder_ / "three.bundle";
    Settings& settings = state().settings;
    set_setting(settings, "light.fit", "view");
    editor().settle();
    state().frozen = frozen_camera_of(*editor().facts().result, settings.camera);
    export_to(own);
    settings.camera.source = CameraSource::Manual;
    settings.camera.distance = 9;
    settings.camera.azimuth += 120;
    editor().settle();
    export_to(flown);
    EXPECT_EQ(state().log.unseen_errors(), 0) << editor().last_line();
    ASSERT_TRUE(fs::exists(own) && fs::exists(flown));
    const auto a = contents_of(own), b = contents_of(flown);
    EXPECT_TRUE(a.at("picture.png") != b.at("picture.png")) << "the camera has not moved";
    EXPECT_TRUE(a.at("maps/light0-0.pfm") == b.at("maps/light0-0.pfm")) << "the maps differ";
    EXPECT_EQ(Json::parse(a.at("frame.json")).at("lights"), Json::parse(b.at("frame.json")).at("lights"));

    set_setting(settings, "light.cascades", "3");
    export_to(cascades);
    EXPECT_NE(logged("chosen by depth along the frozen camera", LogKind::Error), "") << editor().last_line();
    EXPECT_FALSE(fs::exists(cascades));
    set_setting(settings, "light.cascade_choice", "map");
    export_to(cascades);
    EXPECT_TRUE(fs::exists(cascades)) << editor().last_line();
}

TEST_F(FrameImports, ExportWritesTheBundleOfTheCommand) {
    const fs::path bundle = folder_ / "mine.bundle";
    export_to(bundle);
    EXPECT_EQ(logged("Wrote", LogKind::Info), "Wrote " + bundle.string());
    EXPECT_EQ(state().log.unseen_errors(), 0) << editor().last_line();
    const EditorRequests size = editor().requests();
    const ProcessResult made = run_program(
        {"export", "boxes", "--set", "map.resolution=256", "--size",
         std::to_string(size.scene_width) + "x" + std::to_string(size.scene_height), "--bundle", "command.bundle"},
        folder_);
    ASSERT_EQ(made.code, 0) << made.err;
    const auto ours = contents_of(bundle), theirs = contents_of(folder_ / "command.bundle");
    ASSERT_EQ(ours.size(), theirs.size());
    EXPECT_GE(ours.size(), 4u) << "scene, map, picture, frame.json";
    for (const auto& [name, bytes] : theirs) {
        ASSERT_TRUE(ours.contains(name)) << name;
        EXPECT_TRUE(ours.at(name) == bytes) << name;
    }
    editor().model().open(bundle);
    editor().settle();
    EXPECT_EQ(state().scene_name, bundle.string());
    EXPECT_TRUE(shows_imported_maps());
}

TEST_F(FrameImports, ExportAsksBeforeItReplacesAndRefusesItsInput) {
    const fs::path bundle = folder_ / "mine.bundle";
    export_to(bundle);
    const auto before = contents_of(bundle);
    state().settings.map.resolution = 128;
    export_to(bundle);
    ASSERT_TRUE(state().files.replace) << "it exists";
    EXPECT_TRUE(state().files.replace->exported);
    EXPECT_EQ(contents_of(bundle), before) << "replaced without an answer";
    state().files.replace.reset();
    export_to(bundle, true);
    const auto after = contents_of(bundle);
    EXPECT_NE(after, before);
    editor().model().open(bundle);
    editor().settle();
    export_to(bundle, true);
    EXPECT_NE(logged("write another one", LogKind::Error), "") << editor().last_line();
    EXPECT_EQ(contents_of(bundle), after) << "the shown bundle was replaced";
    export_to(folder_ / "mine.txt");
    EXPECT_NE(logged("mine.txt", LogKind::Error), "");
    export_to(folder_ / "none" / "mine.bundle");
    EXPECT_NE(logged("none/mine.bundle", LogKind::Error), "");
    state().settings.lights[0].cast = false;
    export_to(folder_ / "dark.bundle");
    EXPECT_EQ(files(), (std::vector<std::string>{"a.rdc", "mine.bundle"}));
}

TEST_F(FrameImports, CaptureIsListedWrittenAndOpened) {
    export_to(folder_ / "made.bundle");
    const ScriptedHelper helper(folder_, listing_script(folder_ / "made.bundle", folder_ / "picks"));
    editor().model().open(folder_ / "a.rdc");
    editor().settle();
    ASSERT_TRUE(importing());
    EXPECT_EQ(importing()->step, ImportStep::Warning) << "said once that shaders run";
    start();
    ASSERT_TRUE(importing()) << editor().last_line();
    ASSERT_EQ(importing()->step, ImportStep::Choosing);
    ASSERT_EQ(importing()->choices.size(), 2u);
    EXPECT_EQ(importing()->choices[1].text, "texture 242, slice 1 of 2, 64 x 64, D16, 16 draws, spot or point");
    EXPECT_EQ(state().import_dialog.picks, (std::vector<int>{0, 1})) << "all are chosen";
    EXPECT_EQ(state().import_dialog.output, (folder_ / "a.bundle").string());
    EXPECT_EQ(state().scene_name, "boxes");
    state().import_dialog.picks = {1};
    write();
    EXPECT_FALSE(importing());
    EXPECT_EQ(state().scene_name, (folder_ / "a.bundle").string()) << editor().last_line();
    EXPECT_TRUE(shows_imported_maps());
    EXPECT_EQ(file_bytes(folder_ / "picks"), "--pick=1\n");
    EXPECT_NE(logged("sun 0: agrees", LogKind::Info), "");
    EXPECT_NE(logged("sun 1: DIFFERS", LogKind::Warning), "");
    EXPECT_NE(logged("no sampler", LogKind::Info), "");
    const auto recent = editor().facts().recent_scenes;
    ASSERT_FALSE(recent.empty());
    EXPECT_EQ(recent.front(), (folder_ / "a.bundle").string());

    // A second capture is opened without the warning, and no bundle is replaced.
    editor().model().open(folder_ / "a.rdc");
    editor().settle();
    ASSERT_TRUE(importing());
    ASSERT_EQ(importing()->step, ImportStep::Choosing);
    EXPECT_EQ(state().import_dialog.output, (folder_ / "a-2.bundle").string());
    state().import_dialog.output = (folder_ / "a.bundle").string();
    write();
    ASSERT_TRUE(importing());
    EXPECT_NE(importing()->problem.find("exists"), std::string::npos) << importing()->problem;
    ask([](EditorRequests& r) { r.cancel_import = true; });
    EXPECT_FALSE(importing());
    EXPECT_EQ(files(), (std::vector<std::string>{"a.bundle", "a.rdc", "made.bundle", "picks", "python"}));
}

TEST_F(FrameImports, FailureOfTheHelperIsOneSentence) {
    const auto opened = [&](const std::string& script) {
        const ScriptedHelper helper(folder_, script);
        editor().model().open(folder_ / "a.rdc");
        editor().settle();
        if (importing() && importing()->step == ImportStep::Warning) start();
        EXPECT_FALSE(importing());
        EXPECT_EQ(state().scene_name, "boxes");
        EXPECT_EQ(state().log.lines().back().kind, LogKind::Error);
        return editor().last_line();
    };
    EXPECT_NE(opened("kill -SEGV $$").find("a.rdc: the capture helper crashed (Segmentation fault) while opening"),
              std::string::npos)
        << editor().last_line();
    EXPECT_EQ(opened("echo '{\"error\": \"import-capture needs the Debian package python3-renderdoc; install it\", "
                     "\"place\": \"program\"}'; exit 1"),
              "import-capture needs the Debian package python3-renderdoc; install it");
    EXPECT_NE(opened("exit 0").find("no shadow map was found"), std::string::npos) << editor().last_line();
    std::ofstream(folder_ / "a.rdc") << "no capture";
    EXPECT_NE(opened("exit 0").find("is no RenderDoc capture"), std::string::npos) << editor().last_line();
}

TEST_F(FrameImports, CancelEndsTheHelperAndItsGroup) {
    const ScriptedHelper helper(folder_,
                                "echo '{\"progress\": 0.25, \"label\": \"looking at passes\"}'\nsleep 987 &\n"
                                "echo $! > '" +
                                    (folder_ / "sleeper").string() + "'\nwait");
    editor().model().open(folder_ / "a.rdc");
    editor().settle();
    ask_only([](EditorRequests& r) { r.start_import = true; });
    std::string text;
    int frames = 0;
    for (; frames < 3000 && text != "looking at passes"; ++frames) {
        editor().frame();  // does not wait for the helper
        if (importing()) text = importing()->doing;
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    ASSERT_EQ(text, "looking at passes");
    EXPECT_EQ(importing()->step, ImportStep::Reading);
    EXPECT_EQ(importing()->progress, 0.25);
    EXPECT_TRUE(editor().model().loading()) << "a window would sleep on";
    pid_t sleeper = 0;
    for (int i = 0; i < 1000 && sleeper == 0; ++i) {
        std::ifstream(folder_ / "sleeper") >> sleeper;
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    ASSERT_GT(sleeper, 0);
    EXPECT_EQ(::kill(sleeper, 0), 0);
    ask([](EditorRequests& r) { r.cancel_import = true; });
    EXPECT_FALSE(importing());
    EXPECT_NE(logged("was not imported", LogKind::Info), "");
    const auto sleeps = [&] {
        std::string state = file_bytes("/proc/" + std::to_string(sleeper) + "/stat");
        return !state.empty() && state.find(") Z") == std::string::npos;
    };
    for (int i = 0; i < 500 && sleeps(); ++i) std::this_thread::sleep_for(std::chrono::milliseconds(10));
    EXPECT_FALSE(sleeps());
}

TEST_F(FrameImports, ImageOfAMapIsReadAsTheUserChooses) {
    const ProcessResult drawn =
        run_program(Words{"render", "boxes", "-o", "map.pfm"} + Words("--size 64x64 --view shadow-map --report r.json "
                                                                      "--set view.map=raw --set map.resolution=256"),
                    folder_);
    ASSERT_EQ(drawn.code, 0) << drawn.err;
    const Json matrix = Json::parse(file_bytes(folder_ / "r.json"))["fit"][0]["matrices"]["clip_from_world"];
    Json numbers;
    for (int i = 0; i < 4; ++i)
        for (int j = 0; j < 4; ++j) numbers.push_back(matrix[j][i]);
    std::ofstream(folder_ / "light.json") << Json{{"clip_from_world", numbers}}.dump();

    editor().model().open(folder_ / "map.pfm");
    editor().settle();
    ASSERT_TRUE(importing());
    EXPECT_EQ(importing()->step, ImportStep::Light);
    EXPECT_EQ(state().import_dialog.light, (folder_ / "light.json").string());
    state().import_dialog.light = (folder_ / "none.json").string();
    start();
    ASSERT_TRUE(importing());
    EXPECT_EQ(importing()->step, ImportStep::Light) << "another file can be named";
    EXPECT_NE(importing()->problem.find("none.json"), std::string::npos) << importing()->problem;
    state().import_dialog.light = (folder_ / "light.json").string();
    start();
    ASSERT_TRUE(importing()) << editor().last_line();
    ASSERT_EQ(importing()->step, ImportStep::Choosing) << importing()->problem;
    ASSERT_GT(importing()->choices.size(), 1u);
    EXPECT_TRUE(importing()->choices[0].fits);
    EXPECT_FALSE(importing()->choices[1].fits);
    EXPECT_NE(importing()->choices[0].fit.find("0.0 % of "), std::string::npos) << importing()->choices[0].fit;
    EXPECT_EQ(state().import_dialog.picks, std::vector<int>{1}) << "a single reading fits";
    write();
    EXPECT_EQ(state().scene_name, (folder_ / "map.bundle").string()) << editor().last_line();
    EXPECT_TRUE(shows_imported_maps());
    const ProcessResult command = run_program(
        Words{"import-map", "map.pfm", "--light", "light.json"} + "--scene boxes -o command.bundle", folder_);
    ASSERT_EQ(command.code, 0) << command.err;
    auto ours = contents_of(folder_ / "map.bundle"), theirs = contents_of(folder_ / "command.bundle");
    EXPECT_EQ(ours["scene.glb"], theirs["scene.glb"]);
    EXPECT_EQ(ours["frame.json"], theirs["frame.json"]);
}

/// Clicks a widget and returns the requests of the frames around the click.
ImportRequests clicked(UiHarness& ui, const std::string& window, const std::string& label) {
    const auto at = ui.find(window, "", label);
    EXPECT_TRUE(at) << label;
    ImportRequests out;
    const auto frame = [&] {
        const EditorRequests requests = ui.frame();
        out.start_import |= requests.start_import;
        out.write_import |= requests.write_import;
        out.cancel_import |= requests.cancel_import;
    };
    if (at) ui.move(*at);
    frame();
    frame();
    ui.press(true);
    frame();
    frame();
    ui.press(false);
    frame();
    frame();
    return out;
}

SI_TEST_IS(Later, ImportDialogs, WarningChoicesAndProgressAreDrawn);
TEST(ImportDialogs, WarningChoicesAndProgressAreDrawn) {
    UiHarness ui(1280, 720);
    ui.importing = ImportFacts{.step = ImportStep::Warning, .file = "/a/frame.rdc"};
    ui.frames(3);
    EXPECT_TRUE(ui.prints("runs its shaders"));
    EXPECT_TRUE(clicked(ui, "Open a RenderDoc capture?", "Open").start_import);
    EXPECT_TRUE(clicked(ui, "Open a RenderDoc capture?", "Cancel").cancel_import);

    ui.importing = ImportFacts{.step = ImportStep::Reading,
                               .file = "/a/frame.rdc",
                               .doing = "looking at passes",
                               .progress = 0.5,
                               .seconds = 12.4};
    ui.frames(3);
    EXPECT_EQ(ui.lacking({"frame.rdc: looking at passes", "50 %, 12 s"}), "");
    EXPECT_FALSE(ui.prints("runs its shaders")) << "the dialog has closed";
    EXPECT_TRUE(clicked(ui, "import", "Cancel").cancel_import);

    const std::vector<ImportChoice> maps = {{.number = 0, .text = "texture 7, slice 0"},
                                            {.number = 1, .text = "texture 7, slice 1"}};
    ui.state.import_dialog = {.picks = {0, 1}, .output = "/a/frame.bundle", .light = {}};
    ui.importing = ImportFacts{
        .step = ImportStep::Choosing, .file = "/a/frame.rdc", .choices = maps, .problem = "frame.bundle: exists"};
    ui.frames(3);
    EXPECT_EQ(ui.lacking({"0: texture 7, slice 0", "1: texture 7, slice 1", "frame.bundle: exists"}), "");
    clicked(ui, "Choose the shadow maps", "None");
    EXPECT_TRUE(ui.state.import_dialog.picks.empty());
    EXPECT_FALSE(clicked(ui, "Choose the shadow maps", "Open").write_import) << "nothing is chosen";
    clicked(ui, "Choose the shadow maps", "All");
    EXPECT_TRUE(clicked(ui, "Choose the shadow maps", "Open").write_import);

    const std::vector<ImportChoice> readings = {{.number = 1, .text = "reversed", .fit = "0.0 % off"},
                                                {.number = 2, .text = "plain", .fit = "80 % off", .fits = false}};
    ui.state.import_dialog = {.picks = {1}, .output = "/a/map.bundle", .light = {}};
    ui.importing =
        ImportFacts{.step = ImportStep::Choosing, .is_capture = false, .file = "/a/map.pfm", .choices = readings};
    ui.frames(3);
    EXPECT_EQ(ui.lacking({"1: reversed", "0.0 % off", "2: plain", "80 % off"}), "");
    ui.importing.reset();
    ui.frames(3);
    EXPECT_FALSE(ui.prints("1: reversed"));
}

/// Presses Enter and returns the requests of the frame that answers it.
EditorRequests confirmed_import(UiHarness& ui) {
    const int enter = ImGui::GetKeyIndex(ImGuiKey_Enter);
    ImGui::GetIO().KeysDown[enter] = true;
    const EditorRequests pressed = ui.frame();
    ImGui::GetIO().KeysDown[enter] = false;
    const EditorRequests released = ui.frame();
    return pressed.export_file ? pressed : released;
}

TEST(ImportDialogs, TwoClicksSaveTheFrameUnderAFreeName) {
    const fs::path folder = fs::weakly_canonical(fresh_test_folder());
    UiHarness ui(1280, 720);
    ui.state.scene_name = "boxes";
    ui.state.files.preset_path = (folder / "x.json").string();
    const auto saved = [&]() -> std::optional<std::string> {
        ui.frames(3);
        ui.click(ui.find("editor/top", "", "File"));
        ui.frames(2);
        const auto item = ui.find("##Popup", "Save map, matrices and picture", "");
        EXPECT_TRUE(item);
        if (!item) return {};
        ui.move(*item);
        ui.frames(2);
        const auto request = ui.click_here().export_file;
        if (!request) return {};
        EXPECT_EQ(request->kind, ExportKind::Bundle);
        return request->path;
    };
    const std::string label = scene_label("boxes");
    EXPECT_EQ(saved(), (folder / (label + ".bundle")).string());
    fs::create_directory(folder / (label + ".bundle"));
    EXPECT_EQ(saved(), (folder / (label + "-2.bundle")).string());
    EXPECT_EQ(free_bundle_path(folder, "../a\\b:c"), folder / "..-a-b-c.bundle") << "it lies in the folder";
}

TEST(ImportDialogs, ExportChoosesANameAndAsks) {
    const fs::path folder = fs::weakly_canonical(fresh_test_folder());
    UiHarness ui(1280, 720);
    ui.desktop_dialogs = true;
    open_file_dialog(ui.state.files.dialog, FileDialog::Job::Export, folder / "x.json", "Boxes");
    EXPECT_FALSE(ui.frames(3).open_desktop_dialog) << "a bundle is a folder or a file";
    EXPECT_EQ(ui.lacking({"Export the frame", "bundle (scene, camera, maps)"}), "");
    EXPECT_EQ(ui.state.files.dialog.name, "Boxes.bundle");
    ui.type("mine");
    EXPECT_EQ(confirmed_import(ui).export_file, (ExportRequest{ExportKind::Bundle, (folder / "mine.bundle").string()}));
    EXPECT_EQ(with_bundle_extension("a.zip"), fs::path("a.zip"));
    ui.frames(2);
    ui.state.files.replace = Replacement{.path = "/a/b.png", .exported = ExportKind::Picture};
    ui.frames(3);
    const EditorRequests agreed = confirmed_import(ui);
    EXPECT_EQ(agreed.export_file, (ExportRequest{ExportKind::Picture, "/a/b.png"}));
    EXPECT_TRUE(agreed.replace);
    EXPECT_FALSE(agreed.save_preset);
}

TEST(ImportDialogs, ExportWritesEachKind) {
    const fs::path folder = fs::weakly_canonical(fresh_test_folder());
    UiHarness ui(1280, 720);
    const std::pair<ExportKind, const char*> kKinds[] = {{ExportKind::Picture, "Boxes.png"},
                                                         {ExportKind::Map, "Boxes.exr"}};
    for (const auto& [kind, name] : kKinds) {
        ui.state.files.dialog.exported = kind;
        open_file_dialog(ui.state.files.dialog, FileDialog::Job::Export, folder / "x.json", "Boxes");
        ui.frames(3);
        EXPECT_EQ(confirmed_import(ui).export_file, (ExportRequest{kind, (folder / name).string()}));
        ui.frames(2);
    }
    EXPECT_EQ(with_export_extension("a.pfm", ExportKind::Map), fs::path("a.pfm"));
    EXPECT_EQ(with_export_extension("a.pfm", ExportKind::Picture), fs::path("a.pfm.png"));
    ui.state.files.dialog.exported = ExportKind::Code;
    open_file_dialog(ui.state.files.dialog, FileDialog::Job::Export, folder / "x.json", "Boxes");
    ui.frames(3);
    EXPECT_FALSE(confirmed_import(ui).export_file);
    ui.frames(2);
    EXPECT_TRUE(ui.state.convert.shown) << "the dialog Convert goes on";
    EXPECT_EQ(ui.state.convert.output, (folder / "Boxes").string());
}

}  // namespace
}  // namespace si::test
