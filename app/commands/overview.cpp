#include <fmt/format.h>

#include <filesystem>

#include "app/base/notes.h"
#include "app/commands/commands.h"
#include "app/context/headless_context.h"
#include "app/editor/editor.h"
#include "app/report/health_report.h"
#include "app/report/map_report.h"
#include "app/report/views.h"
#include "renderer/base/atomic_file.h"
#include "renderer/base/lower_case.h"
#include "renderer/render/reference_frames.h"

namespace si {
namespace {

namespace fs = std::filesystem;

void print_passes(const FrameResult& frame, const DriverInfo& driver) {
    static constexpr const char* kStates[] = {"ran", "reused", "skipped"};
    fmt::print("\n{:<32} {:<8} {:>10} {:>7} {:>11}  {}\n", "pass", "state", "ms", "draws", "triangles", "why");
    for (const PassInfo& p : frame.passes) {
        const std::string ms = p.state == PassState::Drawn ? fmt::format("{:.2f}", p.gpu_ms) : "-";
        fmt::print("{:<32} {:<8} {:>10} {:>7} {:>11}  {}\n", p.name, kStates[std::size_t(p.state)], ms, p.draws,
                   p.triangles, p.reason);
    }
    fmt::print("\nmeasured with {} on {}\n", frame.clock, driver.renderer);
}

void draw_editor(const CommandOptions& options, const std::string& path) {
    EditorOptions editor;
    editor.session = options.session;
    editor.headless = true;
    editor.screenshot = path;
    if (lower_extension(options.session.preset) == ".json") editor.preset = options.session.preset;
    run_editor(editor);  // its notes are those of the session, printed later
}

}  // namespace

void run_overview(const CommandOptions& options) {
    make_folders(options.output);
    const auto file = [&](const std::string& name) { return (fs::path(options.output) / name).string(); };
    SessionOptions opened = options.session;
    for (const char* name : {"scene.png", "shadow-map.png", "visibility.png", "editor.png"})
        opened.outputs.emplace_back(file(name));
    const Session session = open_session(opened);
    FrameResult frame;
    DriverInfo driver;
    std::optional<MapReport> map;
    std::shared_ptr<const NumericHealth> health;
    {
        const HeadlessContext context;
        Renderer renderer;
        FrameRequest request{.width = options.size.width, .height = options.size.height};
        for (const char* view : {"shaded", "shadow-map", "visibility"}) {
            const std::string path = file(view == std::string("shaded") ? "scene.png" : fmt::format("{}.png", view));
            write_view(renderer, session.scene, session.settings, request, find_view(view), path);
            print_wrote(path);
        }
        // The second frame is timed, because the first one compiles shaders.
        request.outputs = {.colour = true, .shadow_map = true, .visibility = true};
        ReferenceCache references;
        trace_sources(renderer, session.scene, session.settings, request, references);
        request.timing = request.force = true;
        frame = renderer.render(session.scene, session.settings, request);
        driver = renderer.driver();
        map = map_report(renderer, session.scene, session.settings, request);
        if (options.check_numeric) health = search_numbers(renderer, session.scene, session.settings, request);
    }
    // The editor makes its own OpenGL context, so that this one must have ended.
    draw_editor(options, file("editor.png"));
    print_wrote(file("editor.png"));
    print_passes(frame, driver);
    if (map)
        fmt::print("the picture reads {:.1f} % of the {} x {} texels of light {}'s map{}\n",
                   100 * map->exact_utilisation, map->size.width, map->size.height, map->light,
                   map->utilisations.size() > 1 ? fmt::format(", face {}", map->face) : "");
    print_notes(session.notes);
    print_notes(frame.notes);
    if (health) require_sound(*health);
}

}  // namespace si
