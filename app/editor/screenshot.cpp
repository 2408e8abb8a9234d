#include "app/editor/screenshot.h"

#include <fmt/format.h>

#include <cerrno>
#include <cstdio>
#include <system_error>

#include "app/base/output.h"
#include "renderer/base/error.h"
#include "ui/state/shortcuts.h"

namespace si {
namespace {

constexpr int kMaxShots = 100000;

/// Parts of file names, by Shot.
constexpr const char* kParts[] = {"scene", "map", "window", "drawing"};

/// Converts a scene's name ("hard/bias", "/a/fox.glb") to a part of a file name.
std::string plain_name(const std::string& scene) {
    std::string out = std::filesystem::path(scene).stem().string();
    for (char& c : out)
        if (const auto u = static_cast<unsigned char>(c); u < 0x20 || u == 0x7f || c == '/') c = '_';
    return out.empty() ? "screenshot" : out;
}

/// Makes an empty file. Returns false if a file of this name exists.
bool make_empty_file(const std::filesystem::path& path) {
    errno = 0;
    std::FILE* file = std::fopen(path.c_str(), "wx");
    if (file) std::fclose(file);
    if (!file && errno != EEXIST)
        throw Error(fmt::format("{}: cannot be written ({}); save the preset in a folder that can ({})", path.string(),
                                std::generic_category().message(errno), key_text(Command::SavePresetAs)));
    return file != nullptr;
}

}  // namespace

ByteImage cut_out(const ByteImage& window, const ScreenRect& rect, float pixels) {
    const glm::ivec2 size(window.width, window.height);
    const glm::ivec2 lo = glm::clamp(glm::ivec2(glm::round(rect.lo * pixels)), glm::ivec2(0), size);
    const glm::ivec2 hi = glm::clamp(glm::ivec2(glm::round((rect.lo + rect.size) * pixels)), lo, size);
    ByteImage out{hi.x - lo.x, hi.y - lo.y, {}};
    for (int y = lo.y; y < hi.y; ++y) {
        const auto row = window.data.begin() + (std::ptrdiff_t(y) * size.x + lo.x) * 4;
        out.data.insert(out.data.end(), row, row + std::ptrdiff_t(out.width) * 4);
    }
    return out;
}

std::filesystem::path save_screenshot(const ByteImage& picture, Shot of, const std::string& scene,
                                      const std::filesystem::path& folder, const std::string& svg) {
    const std::string name = plain_name(scene);
    for (int number = 1; number < kMaxShots; ++number) {
        const std::filesystem::path path = folder / fmt::format("{}-{}-{}.png", name, kParts[int(of)], number);
        const std::filesystem::path drawing = std::filesystem::path(path).replace_extension(".svg");
        if (!make_empty_file(path)) continue;
        std::error_code ignored;
        bool drawing_taken = false;
        try {
            drawing_taken = !svg.empty() && make_empty_file(drawing);
            if (!svg.empty() && !drawing_taken) {
                std::filesystem::remove(path, ignored);
                continue;
            }
            if (drawing_taken) write_file(drawing, svg);
            write_png(path, picture);
        } catch (...) {
            std::filesystem::remove(path, ignored);
            if (drawing_taken) std::filesystem::remove(drawing, ignored);
            throw;
        }
        return path;
    }
    throw Error(fmt::format("{}: {} screenshots are there already; move them elsewhere", folder.string(), kMaxShots));
}

}  // namespace si
