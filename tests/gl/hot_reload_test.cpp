// Tests shaders read from a tree: saved files take effect, broken files leave the last good program in place.
#include <gtest/gtest.h>
#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <fstream>

#include "app/context/headless_context.h"
#include "renderer/base/error.h"
#include "renderer/gl/program_cache.h"
#include "tests/support/error_text.h"

namespace si {
namespace {

namespace fs = std::filesystem;

class HotReload : public ::testing::Test {
protected:
    HeadlessContext context;
    fs::path tree = fs::path(SI_TEST_OUTPUT_DIR) / ("hot_reload_" + std::to_string(getpid()));
    int saves = 0;

    void SetUp() override { fs::create_directories(tree / "shaders"); }
    void TearDown() override { fs::remove_all(tree); }
    void save(const std::string& name, const std::string& text) {
        const fs::path path = tree / "shaders" / name;
        std::ofstream(path) << text;
        // File times may be as coarse as a second; each save gets one of its own.
        fs::last_write_time(path, fs::file_time_type::clock::now() + std::chrono::seconds(++saves));
    }
};

constexpr const char* kVertex = "void main() { gl_Position = vec4(0.0); }\n";

TEST_F(HotReload, SavedFilesTakeEffectAndBrokenFilesKeepTheLastProgram) {
    save("a.vert.glsl", kVertex);
    save("b.frag.glsl", "#include \"c.glsl\"\nout vec4 o;\nvoid main() { o = colour(); }\n");
    save("c.glsl", "vec4 colour() { return vec4(1.0); }\n");
    gl::ProgramCache cache{gl::ShaderSource(tree)};
    const gl::ProgramRequest request{.vertex = "a.vert.glsl", .fragment = "b.frag.glsl"};
    const GLuint first = cache.get(request);
    EXPECT_FALSE(cache.source().poll());
    EXPECT_EQ(cache.get(request), first);

    save("c.glsl", "vec4 colour() { return vec4(0.5); }\n");
    EXPECT_TRUE(cache.source().poll());
    const GLuint second = cache.get(request);
    EXPECT_NE(second, first);
    EXPECT_TRUE(cache.log().empty());

    save("c.glsl", "vec4 colour() { return nonsense; }\n");
    EXPECT_TRUE(cache.source().poll());
    EXPECT_EQ(cache.get(request), second);
    EXPECT_NE(cache.log().find("nonsense"), std::string::npos);
    EXPECT_NE(cache.log().find("c.glsl"), std::string::npos) << "the log names the files: " << cache.log();

    save("c.glsl", "vec4 colour() { return vec4(0.25); }\n");
    EXPECT_TRUE(cache.source().poll());
    EXPECT_NE(cache.get(request), second);
    EXPECT_TRUE(cache.log().empty());
}

TEST_F(HotReload, WithoutAGoodProgramTheErrorNamesFileAndLine) {
    save("a.vert.glsl", kVertex);
    save("b.frag.glsl", "\n#include \"missing.glsl\"\n");
    gl::ProgramCache cache{gl::ShaderSource(tree)};
    EXPECT_TRUE(test::fails_with([&] { cache.get({.vertex = "a.vert.glsl", .fragment = "b.frag.glsl"}); },
                                 {"b.frag.glsl:2", "missing.glsl"}));
}

TEST_F(HotReload, EqualTextsShareAProgramAndUnmentionedDefinesDoNotSplitIt) {
    save("a.vert.glsl", kVertex);
    save("b.frag.glsl", "out vec4 o;\nvoid main() {\n#ifdef USED\no = vec4(1.0);\n#else\no = vec4(0.0);\n#endif\n}\n");
    gl::ProgramCache cache{gl::ShaderSource(tree)};
    gl::ProgramRequest request{.vertex = "a.vert.glsl", .fragment = "b.frag.glsl"};
    const GLuint plain = cache.get(request);
    request.defines = {{"UNUSED", "1"}, {"USED_NOT", "2"}};
    EXPECT_EQ(cache.get(request), plain);
    request.defines = {{"USED", "1"}};
    EXPECT_NE(cache.get(request), plain);
    EXPECT_EQ(cache.size(), 2u);
}

}  // namespace
}  // namespace si
