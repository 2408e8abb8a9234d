#include <fmt/format.h>

#include <charconv>

#include "app/base/notes.h"
#include "app/base/output.h"
#include "app/commands/commands.h"
#include "app/context/headless_context.h"
#include "app/report/health_report.h"
#include "app/report/map_report.h"
#include "app/report/picture_comparison.h"
#include "app/report/report.h"
#include "app/report/views.h"
#include "app/session/presets.h"
#include "renderer/base/did_you_mean.h"
#include "renderer/base/error.h"
#include "renderer/base/printable.h"
#include "renderer/inspect/grey_range.h"
#include "renderer/inspect/lost_casters.h"
#include "renderer/render/reference_frames.h"
#include "renderer/scene/placement.h"
#include "renderer/scene/scene.h"
#include "renderer/settings/param.h"

namespace si {

PictureSize parse_size(const std::string& text) {
    PictureSize size;
    const char* const end = text.data() + text.size();
    const auto width = std::from_chars(text.data(), end, size.width);
    const bool has_x = width.ec == std::errc() && width.ptr != end && *width.ptr == 'x';
    const auto height = has_x ? std::from_chars(width.ptr + 1, end, size.height) : width;
    const bool in_range = size.width >= 1 && size.height >= 1 && size.width <= 16384 && size.height <= 16384;
    if (!has_x || height.ec != std::errc() || height.ptr != end || !in_range)
        throw UsageError(
            fmt::format("--size {}: must be WIDTHxHEIGHT in pixels, each 1 to 16384, such as 1280x720", text));
    return size;
}

namespace {

/// Returns the camera of a preset with its near and far distances, for --fit-camera.
MapCamera map_camera_of(Renderer& renderer, const Session& session, const Settings& preset, FrameRequest request) {
    Settings seen = session.settings;
    seen.camera = preset.camera;
    request.outputs = {.colour = false};
    request.timing = false;
    const FrameResult frame = renderer.render(session.scene, seen, request);
    return {frame.camera, frame.seen_m};
}

/// Sets the view to one pane without overlays and slabs.
void show_plain_picture(ViewSettings& view) {
    view.overlay = 0;
    view.panes = Panes::One;
    view.slabs = Slabs::None;
}

/// Draws the frame and the one that it is compared with into one picture. Returns the mean difference of both.
/// @param preset preset of the other picture; null: the reference
double write_against(Renderer& renderer, const Session& session, FrameRequest request, const RenderOptions& options,
                     const Settings* preset, FrameResult& frame) {
    ReferenceCache references;
    Settings settings = session.settings;
    show_plain_picture(settings.view);
    request.outputs.true_colour = preset == nullptr;
    frame = render_with_reference(renderer, session.scene, settings, request, references, workers_with_progress());
    const ByteImage a = renderer.read_colour(frame.colour);
    ByteImage b;
    if (!preset) {
        if (!frame.true_colour.texture) throw Error("--against truth: there is no light to trace a reference of");
        b = renderer.read_colour(frame.true_colour);
    } else {
        Settings placed = *preset;
        carry_settings(placed, preset->scene, settings.scene);
        Settings other = settings_with_shadows_of(settings, placed);
        check_objects(session.scene, other, options.against, nullptr);
        Scene shown = session.scene;
        hide_objects(shown, hidden_paths(other));
        request.outputs.true_colour = false;
        b = renderer.read_colour(
            render_with_reference(renderer, shown, other, request, references, workers_with_progress()).colour);
    }
    write_png(options.output, options.difference   ? difference_image(a, b)
                              : options.swipe >= 0 ? swipe_image(a, b, options.swipe)
                                                   : side_by_side_image(a, b));
    return mean_difference(a, b);
}

}  // namespace

void run_render(const RenderOptions& options) {
    const View view = find_view(options.view.empty() ? "shaded" : options.view);
    require_writable(options.output);
    check_view_file(view, options.output);
    const bool against = !options.against.empty();
    if (against && view.key != "shaded")
        throw UsageError(
            fmt::format("--against compares the shaded picture, not the view '{}'; leave out "
                        "--view",
                        view.key));
    if (options.fit && view.key != "shadow-map" && view.key != "camera-depth")
        throw UsageError(fmt::format(
            "--fit: the view '{}' shows no stored depths; add --view shadow-map or --view camera-depth", view.key));
    if (!options.report.empty()) require_writable(options.report);
    require_distinct(options.output, "-o", options.report, "--report");
    std::optional<Settings> other;
    if (against && options.against != "truth") {
        try {
            other = load_preset(options.against).settings;
        } catch (const UsageError&) {
            static const std::vector<std::string> kWords{"truth"};
            const std::string meant = nearest_name(options.against, kWords);
            if (meant.empty()) throw;
            throw UsageError(
                fmt::format("--against {}: allowed are truth and presets{}", options.against, did_you_mean(meant)));
        }
    }
    std::optional<Settings> fit_camera;
    if (!options.fit_camera.empty()) fit_camera = load_preset(options.fit_camera).settings;
    require_outputs_not_read(options.session.outputs,
                             std::vector<std::filesystem::path>{options.against, options.fit_camera});
    require_picture_memory(options.size, !against                     ? kDrawnPixelBytes
                                         : options.against == "truth" ? kTracedPixelBytes
                                                                      : kComparedPixelBytes);
    Session session = open_session(options.session);
    // --view shaded draws the plain picture; without --view the settings decide on overlays, panes and slabs.
    if (options.view == "shaded") show_plain_picture(session.settings.view);
    if (view.overlay > 0) session.settings.view.overlay = view.overlay;
    if (options.fit) session.settings.view.map_fit = true;

    const HeadlessContext context;
    Renderer renderer;
    FrameRequest request{.width = options.size.width, .height = options.size.height};
    request.timing = !options.report.empty();
    request.with_look = options.look;
    if (fit_camera) request.map_camera = map_camera_of(renderer, session, *fit_camera, request);
    FrameResult frame;
    double mean = 0;
    if (against) {
        mean = write_against(renderer, session, request, options, other ? &*other : nullptr, frame);
        fmt::print("mean |A - B| {:.6f}, B: {}\n", mean, printable(options.against, std::string::npos));
    } else {
        frame = write_view(renderer, session.scene, session.settings, request, view, options.output,
                           workers_with_progress());
        if (options.fit) fmt::print("{}\n", grey_range_text(session.settings.view, frame));
    }
    std::shared_ptr<const NumericHealth> health;
    if (options.check_numeric)
        health = search_numbers(renderer, session.scene, session.settings, request, workers_with_progress());
    if (!options.report.empty()) {
        auto report = report_json(session, view.key, request, frame, renderer.driver());
        if (health) report["numeric_health"] = health_json(*health);
        if (against) report["against"] = {{"what", options.against}, {"mean_difference", mean}};
        const PaneGrid grid = picture_grid(session.settings, request.width, request.height);
        request.width = grid.width;
        request.height = grid.height;
        const auto map = map_report(renderer, session.scene, session.settings, request);
        report["shadow_map"] = map ? map_report_json(*map) : nlohmann::ordered_json(nullptr);
        write_file(options.report, json_text(report));
    }
    print_notes(session.notes);
    print_notes(frame.notes);
    for (std::size_t i = 0; i < frame.lights.size(); ++i)
        print_notes(
            lost_caster_remarks(session.scene, lost_casters(session.scene, session.settings, frame.lights[i]), int(i)));
    if (health) require_sound(*health);
}

}  // namespace si
