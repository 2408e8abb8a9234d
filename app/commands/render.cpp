#include <fmt/format.h>

#include <charconv>

#include "app/commands/commands.h"
#include "app/headless_context.h"
#include "app/map_report.h"
#include "app/notes.h"
#include "app/output.h"
#include "app/report.h"
#include "app/views.h"
#include "renderer/error.h"
#include "renderer/lost_casters.h"

namespace si {

PictureSize parse_size(const std::string& text) {
    PictureSize size;
    const char* const end = text.data() + text.size();
    const auto width = std::from_chars(text.data(), end, size.width);
    const bool has_x = width.ec == std::errc() && width.ptr != end && *width.ptr == 'x';
    const auto height = has_x ? std::from_chars(width.ptr + 1, end, size.height) : width;
    const bool in_range = size.width >= 1 && size.height >= 1 && size.width <= 16384 && size.height <= 16384;
    if (!has_x || height.ec != std::errc() || height.ptr != end || !in_range) {
        throw UsageError(
            fmt::format("--size {}: WIDTHxHEIGHT in pixels is wanted, each 1 to 16384, such as 1280x720", text));
    }
    return size;
}

void run_render(const RenderOptions& options) {
    const View view = find_view(options.view);
    require_writable(options.output);
    check_view_file(view, options.output);
    if (!options.report.empty()) require_writable(options.report);
    Session session = open_session(options.session);
    // Asked for by name, the plain picture is plain; else the settings decide on overlays, panes and slabs.
    if (options.view_given && view.key == "shaded") {
        session.settings.view.overlay = session.settings.view.panes = session.settings.view.slabs = 0;
    }
    if (view.overlay > 0) session.settings.view.overlay = view.overlay;

    const HeadlessContext context;
    Renderer renderer;
    FrameRequest request;
    request.width = options.size.width, request.height = options.size.height;
    request.timing = !options.report.empty();
    FrameResult frame;
    write_view(renderer, session.scene, session.settings, request, view, options.output, &frame);
    if (!options.report.empty()) {
        auto report = report_json(session, view.key, request, frame, renderer.driver());
        const PaneGrid grid = picture_grid(session.settings, request.width, request.height);
        request.width = grid.width, request.height = grid.height;
        const auto map = map_report(renderer, session.scene, session.settings, request);
        report["shadow_map"] = map ? map_report_json(*map) : nlohmann::ordered_json(nullptr);
        write_file(options.report, json_text(report));
    }
    print_notes(session.notes);
    print_notes(frame.notes);
    for (std::size_t i = 0; i < frame.lights.size(); ++i)
        print_notes(lost_caster_notes(session.scene, lost_casters(session.scene, session.settings, frame.lights[i])));
}

}  // namespace si
