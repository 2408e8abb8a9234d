// Contact sheet: every model below a folder in one picture, with an index of the tiles.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>

#include "app/base/notes.h"
#include "app/base/output.h"
#include "app/commands/commands.h"
#include "app/context/headless_context.h"
#include "app/report/health_report.h"
#include "app/report/labelled_sheet.h"
#include "app/report/picture_comparison.h"
#include "renderer/base/error.h"
#include "renderer/base/lower_case.h"
#include "renderer/bundle/bundle_files.h"
#include "renderer/importers/importers.h"
#include "renderer/render/renderer.h"

namespace si {
namespace {

namespace fs = std::filesystem;

constexpr int kLabelHeight = 18;  // px, below each tile
constexpr int kMaxSide = 16384;   // px of the sheet

std::vector<fs::path> models_below(const fs::path& folder) {
    std::error_code error;
    if (!fs::is_directory(folder, error)) throw Error(fmt::format("{}: not a folder", folder.string()));
    std::vector<fs::path> out;
    for (auto it = fs::recursive_directory_iterator(folder, fs::directory_options::skip_permission_denied, error);
         it != fs::recursive_directory_iterator() && !error; it.increment(error)) {
        // A bundle is a folder or a file, and what lies in its folder is a part of it.
        const bool is_folder = it->is_directory();
        if (!(is_folder ? lower_extension(it->path()) == ".bundle" : it->is_regular_file())) continue;
        if (it->path().filename() == kFrameJson || !find_importer(it->path())) continue;
        out.push_back(it->path());
        if (is_folder) it.disable_recursion_pending();
    }
    if (error) throw Error(fmt::format("{}: {}", folder.string(), error.message()));
    if (out.empty())
        throw Error(
            fmt::format("{}: no model ({}) in this folder or below it", folder.string(), importer_extensions()));
    std::sort(out.begin(), out.end());
    return out;
}

/// Picture of one tile, or the reason why the tile is empty.
struct Tile {
    ByteImage picture;
    std::string text;
    std::vector<std::string> notes;
    std::string unsound;  ///< faulty numbers of the picture; empty: none, or not searched
    bool failed = false;
};

/// @param outputs files of the sheet @throws OutputIsInput if one of them belongs to the model
Tile draw_tile(Renderer& renderer, const fs::path& model, const std::vector<fs::path>& outputs, const PictureSize& size,
               bool check_numeric) {
    Tile tile;
    try {
        const Session session = open_session({.scene = model.string(), .outputs = outputs});
        FrameRequest request{.width = size.width, .height = size.height};
        FrameRequest rested = request;  // smoothed, as the editor shows a static view
        if (session.settings.view.smooth) rested.smoothed = kMaxSmoothedShadings;
        const FrameResult frame = renderer.render(session.scene, session.settings, rested);
        tile.picture = renderer.read_colour(frame.smooth.texture != 0 ? frame.smooth : frame.colour);
        tile.text = fmt::format("{} triangles", session.scene.triangle_count());
        tile.notes = session.scene.warnings;
        if (check_numeric) {
            const auto health = search_numbers(renderer, session.scene, session.settings, request);
            if (!health->sound()) {
                tile.unsound = health_text(*health);
                tile.notes.push_back(tile.unsound);
            }
        }
    } catch (const OutputIsInput&) {
        throw;
    } catch (const std::exception& e) {
        tile.failed = true;
        tile.text = one_line(e.what());
    }
    return tile;
}

}  // namespace

void run_contact_sheet(const ContactSheetOptions& options) {
    require_output(options.output, "the sheet", {".png"});
    const fs::path index_path = fs::path(options.output).replace_extension(".txt");
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
    LabelledSheet sheet(columns * step_x, rows * step_y);
    std::string index;
    std::string unsound;
    int failures = 0;
    for (std::size_t i = 0; i < models.size(); ++i) {
        const int x = int(i) % columns * step_x, y = int(i) / columns * step_y;
        const Tile tile =
            draw_tile(renderer, models[i], {options.output, index_path}, options.size, options.check_numeric);
        if (tile.failed) {
            ++failures;
            sheet.fill(x, y, options.size.width, options.size.height, {92, 30, 30});
            sheet.write("NOT SHOWN: see the index", x + 8, y + (options.size.height - LabelledSheet::kLineHeight) / 2,
                        options.size.width - 16, {255, 255, 255});
        } else {
            sheet.place(tile.picture, x, y);
        }
        sheet.write(fmt::format("{} {}", i + 1, one_line(models[i].stem().string())), x + 3,
                    y + options.size.height + (kLabelHeight - LabelledSheet::kLineHeight) / 2, options.size.width - 6,
                    {230, 230, 230});
        index += fmt::format("{}\t{}\t{}\t{}\n", i + 1, tile.failed ? "NOT SHOWN" : "shown",
                             one_line(fs::relative(models[i], options.folder).string()), tile.text);
        if (unsound.empty() && !tile.unsound.empty()) unsound = fmt::format("{}: {}", models[i].string(), tile.unsound);
        for (const std::string& note : tile.notes) index += fmt::format("\t\t\t{}\n", one_line(note));
    }
    write_png(options.output, sheet.image());
    write_file(index_path, index);
    fmt::print("{} models in {}, {} of them not shown; {} lists them with reasons\n", models.size(), options.output,
               failures, index_path.string());
    if (!unsound.empty()) throw Error(fmt::format("--check-numeric: {}", unsound));
}

}  // namespace si
