#include "tests/capture_program/frame_capture.h"

#include <dlfcn.h>
#include <renderdoc_app.h>

#include <cstdio>

namespace si::test {

FrameCapture::FrameCapture(const std::string& path) {
    void* const library = ::dlopen("librenderdoc.so", RTLD_NOW | RTLD_NOLOAD);
    if (!library) return;
    const auto get = reinterpret_cast<pRENDERDOC_GetAPI>(::dlsym(library, "RENDERDOC_GetAPI"));
    if (!get || !get(eRENDERDOC_API_Version_1_1_2, &api_)) {
        api_ = nullptr;
        return;
    }
    static_cast<RENDERDOC_API_1_1_2*>(api_)->SetCaptureFilePathTemplate(path.c_str());
}

void FrameCapture::begin() {
    if (api_) static_cast<RENDERDOC_API_1_1_2*>(api_)->StartFrameCapture(nullptr, nullptr);
}

bool FrameCapture::end() {
    if (!api_) return true;
    auto* const api = static_cast<RENDERDOC_API_1_1_2*>(api_);
    if (!api->EndFrameCapture(nullptr, nullptr)) return false;
    char file[4096];
    uint32_t length = sizeof file;
    if (api->GetNumCaptures() == 0 || !api->GetCapture(api->GetNumCaptures() - 1, file, &length, nullptr)) return false;
    std::printf("%s\n", file);
    return true;
}

}  // namespace si::test
