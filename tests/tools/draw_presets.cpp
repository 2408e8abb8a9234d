// draw_presets FOLDER: draws every built-in preset on the driver at hand and prints the driver's name and each preset's
// key. Files are KEY.rgba (8 bits a channel) and KEY.visibility (floats), top row first.
#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>

#include "app/context/headless_context.h"
#include "app/session/session.h"
#include "renderer/render/renderer.h"

namespace {

template <typename T>
void write(const std::filesystem::path& file, const std::vector<T>& data) {
    std::ofstream(file, std::ios::binary)
        .write(reinterpret_cast<const char*>(data.data()), std::streamsize(data.size() * sizeof(T)));
}

void draw(const std::filesystem::path& folder) {
    const si::HeadlessContext context;
    si::Renderer renderer;
    std::printf("%s\n", renderer.driver().renderer.c_str());
    for (const si::BuiltinPreset& preset : si::builtin_presets()) {
        const si::Session session = si::open_session({.preset = preset.key});
        si::FrameRequest request{.width = 320, .height = 180};
        request.outputs = {.colour = true, .visibility = true};
        const si::FrameResult frame = renderer.render(session.scene, session.settings, request);
        write(folder / (preset.key + ".rgba"), renderer.read_colour(frame.colour).data);
        // No visibility texture is made without a casting light.
        write(folder / (preset.key + ".visibility"),
              frame.visibility.texture ? renderer.read_float(frame.visibility, 1).data : std::vector<float>());
        std::printf("%s\n", preset.key.c_str());
    }
}

}  // namespace

int main(int count, char** arguments) {
    if (count != 2) return 2;
    try {
        draw(arguments[1]);
    } catch (const std::exception& e) {
        std::fprintf(stderr, "draw_presets: %s\n", e.what());
        return 1;
    }
}
