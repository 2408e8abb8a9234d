// Every model below a folder in one picture, with an index of what stands where.
#include <fmt/format.h>
#include <stb/stb_easy_font.h>

#include <algorithm>
#include <array>
#include <filesystem>

#include "app/base/notes.h"
#include "app/base/output.h"
#include "app/commands/commands.h"
#include "app/context/headless_context.h"
#include "app/report/health_report.h"
#include "renderer/base/error.h"
#include "renderer/base/small_letters.h"
#include "renderer/frame/renderer.h"

namespace si {
namespace {

namespace fs = std::filesystem;

constexpr int kLabelHeight = 16;  // px, below each tile
constexpr int kMaxSide = 16384;   // px of the sheet
using Colour = std::array<std::uint8_t, 3>;

std::vector<fs::path> models_below(const fs::path& folder) {
    std::error_code error;
    if (!fs::is_directory(folder, error)) throw Error(fmt::format("{}: this is no folder", folder.string()));
    std::vector<fs::path> out;
    for (auto it = fs::recursive_directory_iterator(folder, fs::directory_options::skip_permission_denied, error);
         it != fs::recursive_directory_iterator() && !error; it.increment(error)) {
        const std::string extension = lower_extension(it->path());
        if (it->is_regular_file() && (extension == ".gltf" || extension == ".glb")) out.push_back(it->path());
    }
    if (error) throw Error(fmt::format("{}: {}", folder.string(), error.message()));
    if (out.empty()) throw Error(fmt::format("{}: there is no .gltf or .glb file in it or below", folder.string()));
    std::sort(out.begin(), out.end());
    return out;
}

class Sheet {
public:
    Sheet(int width, int height) {
        image_.width = width, image_.height = height;
        image_.data.assign(std::size_t(width) * std::size_t(height) * 4, 255);
        fill(0, 0, width, height, {24, 25, 28});
    }
    const ByteImage& image() const { return image_; }
    void fill(int x, int y, int width, int height, const Colour& colour) {
        for (int row = std::max(y, 0); row < std::min(y + height, image_.height); ++row)
            for (int column = std::max(x, 0); column < std::min(x + width, image_.width); ++column)
                std::copy(colour.begin(), colour.end(), at(column, row));
    }
    void place(const ByteImage& picture, int x, int y) {
        for (int row = 0; row < picture.height; ++row)
            std::copy_n(picture.data.begin() + std::ptrdiff_t(row) * picture.width * 4, picture.width * 4,
                        at(x, y + row));
    }
    /// ASCII only; other bytes become '?'. Cut at `width`.
    void write(std::string text, int x, int y, int width, const Colour& colour) {
        for (char& c : text)
            if (c < 32 || c > 126) c = '?';
        while (!text.empty() && stb_easy_font_width(text.data()) > width) text.pop_back();
        struct Vertex {
            float x, y, z;
            std::uint8_t colour[4];
        };
        std::vector<Vertex> corners(text.size() * 64 + 64);
        const int quads =
            stb_easy_font_print(0, 0, text.data(), nullptr, corners.data(), int(corners.size() * sizeof(Vertex)));
        for (int i = 0; i < quads; ++i) {
            const Vertex &a = corners[std::size_t(i) * 4], &b = corners[std::size_t(i) * 4 + 2];
            fill(x + int(a.x), y + int(a.y), std::max(1, int(b.x - a.x)), std::max(1, int(b.y - a.y)), colour);
        }
    }

private:
    ByteImage image_;
    std::vector<std::uint8_t>::iterator at(int x, int y) {
        return image_.data.begin() + (std::ptrdiff_t(y) * image_.width + x) * 4;
    }
};

/// What one tile shows, or why it shows nothing.
struct Tile {
    ByteImage picture;
    std::string text;
    std::vector<std::string> notes;
    std::string unsound;  ///< which of its numbers are none; empty: all are sound, or nobody asked
    bool failed = false;
};

Tile draw_tile(Renderer& renderer, const fs::path& model, const PictureSize& size, bool check_numeric) {
    Tile tile;
    try {
        const Session session = open_session({.scene = model.string()});
        FrameRequest request{.width = size.width, .height = size.height};
        FrameRequest rested = request;  // as the editor shows it once the view rests
        if (session.settings.view.smooth) rested.smoothed = kSmoothedMost;
        const FrameResult frame = renderer.render(session.scene, session.settings, rested);
        tile.picture = renderer.read_colour(frame.smooth.texture != 0 ? frame.smooth : frame.colour);
        tile.text = fmt::format("{} triangles", session.scene.triangle_count());
        tile.notes = session.scene.warnings;
        if (check_numeric) {
            const auto health = search_numbers(renderer, session.scene, session.settings, request);
            if (!health->sound()) tile.unsound = health_text(*health), tile.notes.push_back(tile.unsound);
        }
    } catch (const std::exception& e) {
        tile.failed = true;
        tile.text = one_line(e.what());
    }
    return tile;
}

}  // namespace

void run_contact_sheet(const ContactSheetOptions& options) {
    if (lower_extension(options.output) != ".png")
        throw UsageError(fmt::format("{}: the sheet must end in .png", options.output));
    const fs::path index_path = fs::path(options.output).replace_extension(".txt");
    require_writable(options.output);
    require_writable(index_path);
    const std::vector<fs::path> models = models_below(options.folder);
    const int columns = std::clamp(options.columns, 1, int(models.size()));
    const int rows = (int(models.size()) + columns - 1) / columns;
    const int step_x = options.size.width + 2, step_y = options.size.height + kLabelHeight;
    if (long(columns) * step_x > kMaxSide || long(rows) * step_y > kMaxSide)
        throw UsageError(
            fmt::format("a sheet of {} x {} tiles of {} x {} is larger than {} pixels; choose smaller tiles", columns,
                        rows, options.size.width, options.size.height, kMaxSide));

    const HeadlessContext context;
    Renderer renderer;
    Sheet sheet(columns * step_x, rows * step_y);
    std::string index;
    std::string unsound;
    int failures = 0;
    for (std::size_t i = 0; i < models.size(); ++i) {
        const int x = int(i) % columns * step_x, y = int(i) / columns * step_y;
        const Tile tile = draw_tile(renderer, models[i], options.size, options.check_numeric);
        if (tile.failed) {
            ++failures;
            sheet.fill(x, y, options.size.width, options.size.height, {92, 30, 30});
            sheet.write("NOT SHOWN: see the index", x + 8, y + options.size.height / 2, options.size.width - 16,
                        {255, 255, 255});
        } else {
            sheet.place(tile.picture, x, y);
        }
        sheet.write(fmt::format("{} {}", i + 1, models[i].stem().string()), x + 3, y + options.size.height + 4,
                    options.size.width - 6, {230, 230, 230});
        index += fmt::format("{}\t{}\t{}\t{}\n", i + 1, tile.failed ? "NOT SHOWN" : "shown",
                             one_line(fs::relative(models[i], options.folder).string()), tile.text);
        if (unsound.empty() && !tile.unsound.empty()) unsound = fmt::format("{}: {}", models[i].string(), tile.unsound);
        for (const std::string& note : tile.notes) index += fmt::format("\t\t\t{}\n", one_line(note));
    }
    write_png(options.output, sheet.image());
    write_file(index_path, index);
    fmt::print("{} models in {}, {} of them not shown; {} says which and why\n", models.size(), options.output,
               failures, index_path.string());
    if (!unsound.empty()) throw Error(fmt::format("--check-numeric: {}", unsound));
}

}  // namespace si
