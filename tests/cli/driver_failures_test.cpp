// Tests of driver failures, on the command line and in the editor: a message, exit code 1, and kept settings.
#include <gtest/gtest.h>

#include "app/cli/cli.h"
#include "app/editor/headless_editor.h"
#include "renderer/gl/driver_failure.h"
#include "renderer/settings/param.h"
#include "tests/support/process.h"
#include "tests/support/text.h"

namespace si {
namespace {

using gl::DriverFailure;

void fail_always(DriverFailure kind) {
    gl::fault_injection().fails = [kind](DriverFailure of, std::string_view) { return of == kind; };
}

TEST(DriverTrouble, EndsCommandsWithStatusOneAndAMessage) {
    const auto folder = fresh_test_folder();
    const std::string out = (folder / "x.png").string();
    const std::vector<const char*> argv = {"shadow-inspector", "render", "boxes", "-o", out.c_str(), "--size", "64x48"};
    for (const auto& [kind, part] : {std::pair{DriverFailure::Memory, "the driver has no memory for"},
                                     {DriverFailure::Shader, "shader does not compile"},
                                     {DriverFailure::Context, "the graphics driver reset"}}) {
        fail_always(kind);
        testing::internal::CaptureStderr();
        const int code = run_cli(int(argv.size()), argv.data());
        const std::string err = testing::internal::GetCapturedStderr();
        gl::fault_injection() = {};
        EXPECT_EQ(code, 1) << err;
        EXPECT_NE(err.find(part), std::string::npos) << err;
        EXPECT_FALSE(std::filesystem::exists(out)) << "half a picture";
    }
}

TEST(DriverTrouble, NamesAnOlderOpenGl) {
    for (const char* command : {"info", "render boxes -o x.png"}) {
        const ProcessResult r =
            run_shell(std::string("MESA_GL_VERSION_OVERRIDE=4.4 $SI ") + command, fresh_test_folder());
        EXPECT_EQ(r.code, 1) << r.err;
        EXPECT_EQ(
            test::lacking(r.err, {"OpenGL 4.5", "the driver offers 4.4", "MESA_GL_VERSION_OVERRIDE=4.4", "unset it"}),
            "");
        EXPECT_EQ(r.err.find("\n"), r.err.size() - 1) << "more than a sentence: " << r.err;
    }
}

TEST(DriverTrouble, EditorKeepsItsSettingsAndDrawsAgain) {
    EditorOptions options;
    options.session.scene = "boxes";
    options.width = 800;
    options.height = 600;
    options.headless = true;
    HeadlessEditor editor(options);
    editor.settle();
    EditorModel& model = editor.model();
    for (const DriverFailure kind : {DriverFailure::Memory, DriverFailure::Shader, DriverFailure::Context}) {
        fail_always(kind);
        set_setting(model.state.settings, "filter.kernel", kind == DriverFailure::Shader ? "pcss" : "vsm");
        set_setting(model.state.settings, "map.resolution", kind == DriverFailure::Context ? "128" : "256");
        const Settings settings = model.state.settings;
        editor.frame();
        editor.frame();
        EXPECT_FALSE(model.facts().problem.empty());
        EXPECT_FALSE(model.facts().result) << "a picture of nothing";
        EXPECT_TRUE(model.state.settings == settings);
        gl::fault_injection() = {};
        set_setting(model.state.settings, "filter.kernel", "hard");
        editor.settle();
        EXPECT_TRUE(model.facts().problem.empty()) << model.facts().problem;
        EXPECT_TRUE(model.facts().result);
    }
}

}  // namespace
}  // namespace si
