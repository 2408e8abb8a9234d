// Tests contexts without a display: version, switching, and release of memory.
#include <epoxy/gl.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include "app/context/headless_context.h"
#include "app/context/window_context.h"
#include "renderer/base/error.h"
#include "tests/support/error_text.h"
#include "tests/support/traits.h"

namespace si {
namespace {

std::ptrdiff_t open_files() {
    const std::filesystem::directory_iterator list("/proc/self/fd");
    return std::distance(begin(list), end(list));
}

long resident_kib() {
    std::ifstream file("/proc/self/statm");
    long total = 0, resident = 0;
    file >> total >> resident;
    return resident * 4;
}

TEST(HeadlessContext, IsACoreDebugContextOfVersion45) {
    const HeadlessContext context;
    GLint major = 0, minor = 0, profile = 0, flags = 0;
    glGetIntegerv(GL_MAJOR_VERSION, &major);
    glGetIntegerv(GL_MINOR_VERSION, &minor);
    glGetIntegerv(GL_CONTEXT_PROFILE_MASK, &profile);
    glGetIntegerv(GL_CONTEXT_FLAGS, &flags);
    EXPECT_GE(major * 10 + minor, 45);
    EXPECT_EQ(profile, GL_CONTEXT_CORE_PROFILE_BIT);
    EXPECT_TRUE(flags & GL_CONTEXT_FLAG_DEBUG_BIT);
    EXPECT_EQ(context.description().rfind("EGL ", 0), 0u) << context.description();
}

TEST(HeadlessContext, TwoContextsCanBeSwitched) {
    HeadlessContext first;
    GLuint made = 0;
    glCreateTextures(GL_TEXTURE_2D, 1, &made);
    {
        const HeadlessContext second;
        EXPECT_FALSE(glIsTexture(made)) << "the contexts share objects";
    }
    first.make_current();
    EXPECT_TRUE(glIsTexture(made)) << "destroying the second context broke the first";
    glDeleteTextures(1, &made);
    EXPECT_EQ(glGetError(), GLenum(GL_NO_ERROR));
}

SI_TEST_IS(SystemAllocator, HeadlessContext, FiftyContextsReleaseAllMemory);
TEST(HeadlessContext, FiftyContextsReleaseAllMemory) {
    const auto cycle = [] {
        const HeadlessContext context;
        GLuint texture = 0;  // 16 MiB, cleared so that the driver allocates it
        glCreateTextures(GL_TEXTURE_2D, 1, &texture);
        glTextureStorage2D(texture, 1, GL_RGBA8, 2048, 2048);
        glClearTexImage(texture, 0, GL_RGBA, GL_UNSIGNED_BYTE, nullptr);
        glFinish();
    };
    for (int i = 0; i < 5; ++i) cycle();
    const auto files = open_files();
    const long memory = resident_kib();
    for (int i = 0; i < 50; ++i) cycle();
    EXPECT_LE(open_files(), files);  // a thread of an earlier test may still close one
    // Leaked contexts would hold 50 such textures, 800 MiB.
    EXPECT_LT(resident_kib() - memory, 100 * 1024);
}

TEST(HeadlessContext, NeedsNoDisplay) {
    const char* display = std::getenv("DISPLAY");
    const std::string before = display ? display : "";
    setenv("DISPLAY", ":nowhere", 1);
    EXPECT_NO_THROW(HeadlessContext());
    if (display)
        setenv("DISPLAY", before.c_str(), 1);
    else
        unsetenv("DISPLAY");
}

TEST(WindowContext, WithoutADisplayTheErrorNamesTheFix) {
    unsetenv("WAYLAND_DISPLAY");
    setenv("DISPLAY", ":nowhere", 1);
    EXPECT_TRUE(test::fails_with([] { WindowContext("test", 320, 200); }, {"glfwInit", "--headless"}));
    unsetenv("DISPLAY");
    EXPECT_FALSE(WindowContext::display_available());
}

}  // namespace
}  // namespace si
