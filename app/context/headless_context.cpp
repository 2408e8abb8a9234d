#include "app/context/headless_context.h"

// epoxy/egl.h needs the GL types of epoxy/gl.h.
// clang-format off
#include <epoxy/gl.h>
#include <epoxy/egl.h>
// clang-format on
#include <fmt/format.h>

#include <array>
#include <cstdlib>
#include <string_view>
#include <vector>

#include "renderer/base/error.h"

namespace si {
namespace {

/// Returns the name of an EGL error. The codes of EGL follow one another.
std::string_view egl_error_name(EGLint error) {
    static constexpr std::string_view kNames[] = {
        "no error code",     "EGL_NOT_INITIALIZED", "EGL_BAD_ACCESS",        "EGL_BAD_ALLOC",
        "EGL_BAD_ATTRIBUTE", "EGL_BAD_CONFIG",      "EGL_BAD_CONTEXT",       "EGL_BAD_CURRENT_SURFACE",
        "EGL_BAD_DISPLAY",   "EGL_BAD_MATCH",       "EGL_BAD_NATIVE_PIXMAP", "EGL_BAD_NATIVE_WINDOW",
        "EGL_BAD_PARAMETER", "EGL_BAD_SURFACE",     "EGL_CONTEXT_LOST"};
    static_assert(std::size(kNames) == EGL_CONTEXT_LOST - EGL_SUCCESS + 1);
    const auto i = std::size_t(error - EGL_SUCCESS);
    return i < std::size(kNames) ? kNames[i] : "an unknown EGL error";
}

std::string failed(std::string_view call) {
    return fmt::format("{} failed ({})", call, egl_error_name(eglGetError()));
}

/// Returns true if a space-separated list of extensions contains the name as a whole word.
bool listed(const char* extensions, std::string_view name) {
    return fmt::format(" {} ", extensions ? extensions : "").find(fmt::format(" {} ", name)) != std::string::npos;
}

/// Candidate for an EGL display, in the order in which they are tried.
struct DisplayCandidate {
    EGLenum platform;
    void* native;
    std::string name;
};

std::vector<DisplayCandidate> candidates(const char* client_extensions) {
    std::vector<DisplayCandidate> hardware, software;
    if (listed(client_extensions, "EGL_EXT_platform_device") &&
        (listed(client_extensions, "EGL_EXT_device_enumeration") || listed(client_extensions, "EGL_EXT_device_base"))) {
        std::array<EGLDeviceEXT, 32> devices{};
        EGLint count = 0;
        if (eglQueryDevicesEXT(EGLint(devices.size()), devices.data(), &count)) {
            for (EGLint i = 0; i < count; ++i) {
                const char* extensions = eglQueryDeviceStringEXT(devices[std::size_t(i)], EGL_EXTENSIONS);
                const bool is_software = listed(extensions, "EGL_MESA_device_software");
                std::string name = fmt::format("EGL device {}", i);
                if (is_software)
                    name += " (software)";
                else if (listed(extensions, "EGL_EXT_device_drm"))
                    if (const char* file = eglQueryDeviceStringEXT(devices[std::size_t(i)], EGL_DRM_DEVICE_FILE_EXT))
                        name += fmt::format(" ({})", file);
                (is_software ? software : hardware)
                    .push_back({EGL_PLATFORM_DEVICE_EXT, devices[std::size_t(i)], std::move(name)});
            }
        }
    }
    std::vector<DisplayCandidate> all = std::move(hardware);
    all.insert(all.end(), software.begin(), software.end());
    if (listed(client_extensions, "EGL_MESA_platform_surfaceless"))
        all.push_back({EGL_PLATFORM_SURFACELESS_MESA, nullptr, "EGL surfaceless platform"});
    return all;
}

}  // namespace

struct HeadlessContext::Impl {
    EGLDisplay display = EGL_NO_DISPLAY;
    EGLConfig config = nullptr;
    EGLContext context = EGL_NO_CONTEXT;
    EGLSurface surface = EGL_NO_SURFACE;  ///< needed only if EGL lacks surfaceless contexts
    std::string description;
    bool offers_older = false;  ///< a driver exists, but for an OpenGL before 4.5

    Impl() = default;
    Impl(const Impl&) = delete;
    Impl& operator=(const Impl&) = delete;
    /// Destroys context and surface, but keeps the display initialised: EGL shares one display per device in a process,
    /// so that terminating it would break a second context.
    ~Impl() {
        if (context == EGL_NO_CONTEXT) return;
        if (eglGetCurrentContext() == context) eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
        eglDestroyContext(display, context);
        if (surface != EGL_NO_SURFACE) eglDestroySurface(display, surface);
    }

    /// Opens the candidate's EGL display and makes a context. Returns an empty text on success, else the failure.
    std::string open(const DisplayCandidate& candidate);
    /// Makes a context on the chosen display and configuration. Returns an empty text on success, else the failure.
    std::string make_context(EGLContext shared);
    /// Returns the driver's version text if its OpenGL is older than 4.5; else empty.
    std::string older_version();
};

std::string HeadlessContext::Impl::open(const DisplayCandidate& candidate) {
    display = eglGetPlatformDisplayEXT(candidate.platform, candidate.native, nullptr);
    if (display == EGL_NO_DISPLAY) return failed("eglGetPlatformDisplayEXT");
    EGLint major = 0, minor = 0;
    if (!eglInitialize(display, &major, &minor)) return failed("eglInitialize");
    if (!eglBindAPI(EGL_OPENGL_API)) return failed("eglBindAPI(EGL_OPENGL_API)");
    const char* extensions = eglQueryString(display, EGL_EXTENSIONS);
    const bool surfaceless = listed(extensions, "EGL_KHR_surfaceless_context");

    const std::array<EGLint, 5> config_attributes{EGL_SURFACE_TYPE, surfaceless ? 0 : EGL_PBUFFER_BIT,
                                                  EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT, EGL_NONE};
    EGLint configs = 0;
    if (!eglChooseConfig(display, config_attributes.data(), &config, 1, &configs)) return failed("eglChooseConfig");
    if (configs == 0) return "eglChooseConfig found no configuration for OpenGL";
    if (std::string problem = make_context(EGL_NO_CONTEXT); !problem.empty()) return problem;
    description = candidate.name + (surfaceless ? ", no surface" : ", 16x16 pbuffer");
    return {};
}

std::string HeadlessContext::Impl::make_context(EGLContext shared) {
    const bool surfaceless = listed(eglQueryString(display, EGL_EXTENSIONS), "EGL_KHR_surfaceless_context");
    // Robust contexts report a reset of the driver; drivers without them get a plain context.
    for (const bool tells_of_resets : {true, false}) {
        const EGLint end = tells_of_resets ? EGL_CONTEXT_OPENGL_RESET_NOTIFICATION_STRATEGY : EGL_NONE;
        const std::array<EGLint, 11> context_attributes{EGL_CONTEXT_MAJOR_VERSION,
                                                        4,
                                                        EGL_CONTEXT_MINOR_VERSION,
                                                        5,
                                                        EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                                        EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                                        EGL_CONTEXT_OPENGL_DEBUG,
                                                        EGL_TRUE,
                                                        end,
                                                        EGL_LOSE_CONTEXT_ON_RESET,
                                                        EGL_NONE};
        context = eglCreateContext(display, config, shared, context_attributes.data());
        if (context != EGL_NO_CONTEXT) break;
    }
    if (context == EGL_NO_CONTEXT) {
        const std::string why = failed("eglCreateContext(OpenGL 4.5 core)"), version = older_version();
        return version.empty() ? why : fmt::format("{}, the driver offers {}", why, version);
    }
    if (!surfaceless) {
        const std::array<EGLint, 5> size{EGL_WIDTH, 16, EGL_HEIGHT, 16, EGL_NONE};
        surface = eglCreatePbufferSurface(display, config, size.data());
        if (surface == EGL_NO_SURFACE) return failed("eglCreatePbufferSurface");
    }
    if (!eglMakeCurrent(display, surface, surface, context)) return failed("eglMakeCurrent");
    return {};
}

std::string HeadlessContext::Impl::older_version() {
    const EGLContext any = eglCreateContext(display, config, EGL_NO_CONTEXT, nullptr);
    if (any == EGL_NO_CONTEXT) return {};
    std::string version;
    if (eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, any)) {
        if (const auto* text = reinterpret_cast<const char*>(glGetString(GL_VERSION))) version = text;
        eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    }
    eglDestroyContext(display, any);
    offers_older = offers_older || !version.empty();
    return version;
}

HeadlessContext::HeadlessContext() {
    const char* client = eglQueryString(EGL_NO_DISPLAY, EGL_EXTENSIONS);
    if (!client)
        throw Error(failed("eglQueryString(EGL_EXTENSIONS)") +
                    ": this libEGL knows no client extensions; install libegl1 and libegl-mesa0");
    const std::vector<DisplayCandidate> ways = candidates(client);
    if (ways.empty())
        throw Error(
            "no OpenGL without a display: EGL offers neither EGL_EXT_platform_device nor "
            "EGL_MESA_platform_surfaceless; install libegl-mesa0 and libgl1-mesa-dri");
    std::string attempts;
    bool too_old = false;
    for (const DisplayCandidate& way : ways) {
        auto attempt = std::make_unique<Impl>();
        const std::string problem = attempt->open(way);
        if (problem.empty()) {
            impl_ = std::move(attempt);
            return;
        }
        too_old = too_old || attempt->offers_older;
        attempts += fmt::format("{}{}: {}", attempts.empty() ? "" : "; ", way.name, problem);
    }
    const char* asked = std::getenv("MESA_GL_VERSION_OVERRIDE");
    const std::string fix =
        !too_old ? "install libgl1-mesa-dri for the software renderer, or join the group that may open /dev/dri (often "
                   "'render')"
        : asked  ? fmt::format("MESA_GL_VERSION_OVERRIDE={} asks for less: unset it", asked)
                 : "update the driver, or use Mesa's software driver with LIBGL_ALWAYS_SOFTWARE=1";
    throw Error(fmt::format("no OpenGL 4.5 without a display: {}; {}", attempts, fix));
}

HeadlessContext::~HeadlessContext() = default;

void HeadlessContext::make_current() {
    if (!eglBindAPI(EGL_OPENGL_API)) throw Error(failed("eglBindAPI(EGL_OPENGL_API)"));
    if (!eglMakeCurrent(impl_->display, impl_->surface, impl_->surface, impl_->context))
        throw Error(failed("eglMakeCurrent") + ": is the context current on another thread?");
}

ThreadContextMaker HeadlessContext::sharing() const {
    struct Beside : ThreadContext {
        Impl impl;
    };
    return [this]() -> std::unique_ptr<ThreadContext> {
        if (!eglBindAPI(EGL_OPENGL_API))
            throw Error(failed("eglBindAPI(EGL_OPENGL_API)"));  // the bound API is a state of the thread
        auto made = std::make_unique<Beside>();
        made->impl.display = impl_->display;
        made->impl.config = impl_->config;
        if (const std::string problem = made->impl.make_context(impl_->context); !problem.empty())
            throw Error("no second OpenGL context that shares with the first: " + problem);
        return made;
    };
}

std::string HeadlessContext::description() const {
    return impl_->description;
}

}  // namespace si
