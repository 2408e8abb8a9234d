// capture_scene FOLDER SCENE [KEY=VALUE…]: draws one frame of a scene by this project's renderer, captured by RenderDoc
// if its library is preloaded.
#include <cstdio>
#include <exception>
#include <stdexcept>
#include <string>
#include <vector>

#include "app/context/headless_context.h"
#include "app/session/session.h"
#include "renderer/render/renderer.h"
#include "tests/capture_program/frame_capture.h"

namespace {

void run(const std::string& folder, const std::string& scene, const std::vector<std::string>& sets) {
    const si::Session session = si::open_session({.scene = scene, .sets = sets});
    const si::HeadlessContext context;
    si::Renderer renderer;
    si::test::FrameCapture capture(folder + "/frame");
    si::FrameRequest request{.width = 320, .height = 180};
    request.outputs = {.colour = true};
    // Later frames reuse maps, so the first one is captured.
    capture.begin();
    renderer.render(session.scene, session.settings, request);
    if (!capture.end()) throw std::runtime_error("no frame was captured");
}

}  // namespace

int main(int count, char** words) {
    if (count < 3) {
        std::fprintf(stderr, "usage: %s FOLDER SCENE [KEY=VALUE...]\n", words[0]);
        return 2;
    }
    try {
        run(words[1], words[2], std::vector<std::string>(words + 3, words + count));
    } catch (const std::exception& e) {
        std::fprintf(stderr, "capture_scene: %s\n", e.what());
        return 1;
    }
}
