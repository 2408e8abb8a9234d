#include "app/cli/cli.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <new>
#include <tuple>

#include "app/base/exit_code.h"
#include "app/base/notes.h"
#include "app/base/output.h"
#include "app/cli/command.h"
#include "app/cli/command_table.h"
#include "app/commands/check.h"
#include "app/commands/convert.h"
#include "app/context/window_context.h"
#include "app/convert/targets.h"
#include "app/editor/editor.h"
#include "app/report/check.h"
#include "app/report/map_import.h"
#include "app/session/workspace.h"
#include "renderer/base/did_you_mean.h"
#include "renderer/base/error.h"
#include "renderer/base/lower_case.h"
#include "renderer/bundle/bundle_files.h"
#include "renderer/bundle/bundle_members.h"
#include "renderer/importers/importers.h"
#include "renderer/reference/light_map_cache.h"
#include "renderer/settings/param.h"

namespace si {
namespace {

constexpr const char* kOverviewFolder = "out";  ///< of the command `overview`, by default

/// Options of the command `edit`, of which some become EditorOptions.
struct EditOptions : CommandOptions {
    EditorOptions editor;
    std::string probe;      ///< "X,Y" from the top left; empty: none
    bool no_state = false;  ///< neither read nor keep layout, recent files and autosaves
};

void add_render(CLI::App& app, Run& run) {
    auto& c = add_command(app, run, "render", "Draw a scene into a file", run_render);
    RenderOptions& o = c.options;
    c.add_session();
    c.add_output("OUT", "The file: .png (8 bit), or .pfm or .exr (float) for views of one number a pixel")->required();
    c.add_value(
        "--view", o.view, "V",
        "shaded, visibility, shadow-map, camera-depth or an overlay (`list views`); without it the picture with "
        "the overlays and panes of view.*");
    c.add_size({}, 0);
    auto* against = c.add_value("--against", o.against, "WHAT",
                                "Draw another picture of the same frame right of the picture, to compare: truth (the "
                                "ray-traced reference), or a preset (its light, maps, bias, filter and shading)");
    auto* swipe = c.add_value("--swipe", o.swipe, "X",
                              "With --against: one picture, this left of a line at X (0 to 1), the other right of it")
                      ->check(number_between(0, 1))
                      ->needs(against);
    c.app()
        .add_flag("--difference", o.difference, "With --against: one picture of 2 |A - B|")
        ->needs(against)
        ->excludes(swipe);
    c.app()
        .add_flag("--look", o.look, "Draw as the editor does: with view.look and view.overlay_blend")
        ->excludes(against);
    c.app()
        .add_flag("--fit", o.fit,
                  "With --view shadow-map or camera-depth: contrast from the smallest to the largest stored depth, "
                  "empty texels left out (--set view.map_fit=true); prints both with units")
        ->excludes(against);
    c.add_value("--fit-camera", o.fit_camera, "F",
                "Fit view-dependent maps and cascades to the camera of this preset instead of the picture's; shadows "
                "outside its view frustum may be missing");
    c.add_numeric();
    c.add_file_to_write("--report", o.report, "F.json",
                        "Write facts of the frame as JSON: fit, settings, passes and times");
}

void add_reference(CLI::App& app, Run& run) {
    auto& c = add_command(app, run, "truth", "Trace the ray-traced reference of a light's shadows into a file",
                          run_reference);
    ReferenceCommandOptions& o = c.options;
    c.add_session();
    c.add_output("OUT", "The file: .png (8 bit), .pfm or .exr (float); 1 lit to 0 in shadow")->required();
    c.add_area("Give the light its size (light.size); else it is a point or a direction. As --set truth.area=true");
    c.app().add_flag("--as-rasterised", o.as_rasterised,
                     "Leave out the faces that culling leaves out of the shadow map (caster.cull)");
    c.add_setting<int>("--samples", "truth.samples", "N",
                       "With --area: most rays a pixel (default 1024). As --set truth.samples=N")
        ->check(CLI::Range(1, 1 << 20));
    c.add_setting<double>("--noise", "truth.noise", "E",
                          "With --area: wanted standard error of a pixel (default 0.005). As --set truth.noise=E")
        ->check(number_between(0, 1));
    c.add_value("--threads", o.threads, "N", "Threads that trace (default: all)")->check(CLI::Range(1, 1024));
    c.add_numeric();
    c.add_size({}, kTracedPixelBytes);
    c.add_file_to_write("--report", o.report, "F.json", "Write counts, rays, noise and times as JSON");
}

void add_measure(CLI::App& app, Run& run) {
    auto& c = add_command(
        app, run, "measure",
        "Measure the error of a light's shadows against the ray-traced reference, their time and memory", run_measure);
    c.add_session();
    c.add_area();
    c.app().add_flag("!--no-time", c.options.time, "Take no times");
    c.add_cost();
    c.add_numeric();
    c.app().add_flag("--cures", c.options.fixes,
                     "Try fixes for wrong pixels and measure each: pixels cured and broken, time and bytes");
    c.add_size({}, kMeasuredPixelBytes);
    c.add_json("All numbers as JSON");
}

void add_check(CLI::App& app, Run& run) {
    auto& c = add_command(
        app, run, "check",
        "Measure a scene, a bundle or a RenderDoc capture (.rdc) as `measure` does, and compare the errors with "
        "limits. Exit code 0: all are kept, 3: one is exceeded, 1: it could not be checked (docs/ci.md)",
        run_check);
    CheckOptions& o = c.options;
    c.add_session();
    c.add_value("--max-acne", o.max_acne, "PIXELS",
                "Most pixels whose cause is acne (artefacts.acne of `measure --json`): 20, or 0.1% of the compared "
                "pixels");
    c.add_value("--max-wrong", o.max_wrong, "PIXELS",
                "Most wrong pixels, whatever the cause (false_shadow and false_light of `measure --json`): 20, or 0.1% "
                "of the compared pixels");
    c.add_value("--max-error", o.max_error, "E", "Largest error (--error), 0 to 1")->check(number_between(0, 1));
    c.add_value("--error", o.error, "NAME",
                fmt::format("Error that --max-error and --baseline limit, named as in `measure --json`: {} (default: "
                            "the first; 1 minus the value if more is better, else its amount)",
                            fmt::join(checked_errors(), ", ")));
    c.add_value("--baseline", o.baseline, "FILE",
                "Compare acne, wrong pixels and error with those in this file, which --write-baseline wrote at the "
                "same size and with the same driver");
    c.add_file_to_write("--write-baseline", o.write_baseline, "FILE",
                        "Write the numbers as a baseline, .json, if no limit is exceeded");
    c.add_value("--tolerance", o.tolerance, "PIXELS",
                "Pixels by which the baseline may be exceeded: 20, or 0.1% of the compared pixels, and the error by "
                "the same share. Also allows another driver and another meaning of errors");
    c.add_file_to_write("--junit", o.junit, "FILE", "Write a JUnit report with a test case for each limit, .xml");
    c.add_area("Compare with an area light (light.size). Without it the reference is hard, whatever the preset says");
    c.add_size({640, 360}, kMeasuredPixelBytes);
    c.add_json("Findings and all errors as JSON");
}

void add_convert(CLI::App& app, Run& run) {
    std::vector<std::string_view> names;
    for (const ConvertTarget& target : convert_targets()) names.push_back(target.name);
    auto& c =
        add_command(app, run, "convert",
                    "Write the shadow settings of a preset as code of an engine, a graphics API, C++ or GLSL, with "
                    "what each number depends on (docs/convert.md)",
                    run_convert);
    ConvertOptions& o = c.options;
    c.app().add_option("PRESET", o.session.preset, "A preset file, or a built-in preset")->required();
    c.add_value("--to", o.target, "NAME", fmt::format("What to write: {}", fmt::join(names, ", ")))->required();
    c.add_output("FILE", "The file to write, whole or not at all (default: standard output)");
    c.add_value(
        "--scene", o.session.scene, "SCENE",
        "Take the map's size and the tilt of surfaces from this scene, and measure there (default: the preset's "
        "scene, if it names one)");
    c.app().add_flag("!--no-scene", o.use_scene, "Read no scene: the map's size is that of the settings, or assumed");
    c.add_value(
         "--angle", o.angle_deg, "DEG",
         "Angle between normal and light at which numbers shall agree that cannot at every angle (default: 95 % of "
         "the lit pixels are tilted less; 45 without a scene)")
        ->check(number_between(0, 89));
    c.add_value("--set", o.session.sets, "KEY=VALUE", "Set one setting; may be repeated, the last one wins")
        ->allow_extra_args(false);
    c.add_area("Compare with an area light (light.size). Without it the reference is hard, whatever the preset says");
    c.app().add_flag("!--no-time", o.time, "Take no times");
    c.add_cost();
    c.add_size({640, 360}, kMeasuredPixelBytes);
    c.add_json("The same as JSON");
}

void add_compare_pictures(CLI::App& app, Run& run) {
    auto& c =
        add_command(app, run, "compare-pictures",
                    "Print the difference of two pictures of equal size as a person sees it (FLIP): 0 none, 1 the "
                    "largest",
                    run_compare_pictures);
    ComparePicturesOptions& o = c.options;
    c.app().add_option("A", o.picture, "A picture, .png")->required();
    c.app().add_option("B", o.other_picture, "The other picture, .png, of the same size")->required();
    c.add_output("HEATMAP.png", "Write the difference of each pixel as a heat map, dark blue 0 to yellow 1");
    c.add_value(
         "--ppd", o.pixels_per_degree, "N",
         fmt::format("Pixels per degree of visual angle (default {:.0f}: a monitor of 3840 pixels and 0.7 m, 0.7 m "
                     "away)",
                     kFlipPixelsPerDegree))
        ->check(number_between(kMinPixelsPerDegree, kMaxPixelsPerDegree));
    c.add_json("Mean and maximum as JSON");
}

void add_compare_maps(CLI::App& app, Run& run) {
    auto& c = add_command(app, run, "compare-maps",
                          "Compare imported shadow maps with maps drawn from the same lights: texels, depths, missing "
                          "casters, needed bias",
                          run_compare_maps);
    CompareMapsOptions& o = c.options;
    c.add_session();
    c.add_value("--light", o.light, "N", "Compare this light alone (default: all lights with imported maps)")
        ->check(CLI::Range(0, kMaxLights - 1));
    c.add_value("--border", o.border_texels, "N",
                "Do not count extra texels this close to covered ones, as of blurred maps of moments (default 0)")
        ->check(CLI::Range(0, 16));
    c.app().add_flag("--leave-out-masked", o.leave_out_masked,
                     "Leave texels that masked casters may cover out of both maps");
    c.app().add_flag("--check", o.check, "End with exit code 1 where a map fails the gate");
    c.add_output("DIFF.png", "Draw both maps and their difference, with a scale in metres");
    c.add_size({}, kMeasuredPixelBytes);
    c.add_json("All numbers as JSON");
}

/// Returns the words of a table of choices in frame.json.
std::vector<std::string_view> keys_of(const auto& table) {
    std::vector<std::string_view> out;
    for (const auto& [key, value] : table) out.push_back(key);
    return out;
}

void add_import_map(CLI::App& app, Run& run) {
    auto& c = add_command(app, run, "import-map",
                          "Make a bundle of another engine's depth map and the light that it belongs to; finds out how "
                          "the map is to be read (docs/bundle.md)",
                          run_import_map);
    ImportMapOptions& o = c.options;
    c.app().add_option("IMAGE", o.image, "The map: .pfm, .exr, .png (16 bits) or .raw")->required();
    c.add_value("--light", o.light, "LIGHT.json",
                "The light: an object as in lights of a bundle's frame.json, or only a matrix and what else is known")
        ->required();
    c.add_value("--scene", o.scene, "SCENE", "The scene that the map shows: a model or a built-in scene");
    c.add_output("BUNDLE", "The bundle: a folder that ends in .bundle, or a .zip file")->required();
    c.add_value("--depth-range", o.depth_range, "RANGE", "Clip z over w of the depth range: 0..1 or -1..1")
        ->check(one_of(keys_of(bundle::kRangeKeys)));
    c.add_value("--reversed", o.reversed, "BOOL", "true: the near plane is stored as 1")
        ->check(one_of({"true", "false"}));
    c.add_value("--first-row", o.first_row, "END", "End of the map that the first stored row shows: bottom or top")
        ->check(one_of(keys_of(bundle::kFirstRowKeys)));
    c.add_value("--matrix", o.matrix, "ORDER", "Order of the numbers of a matrix: columns or rows")
        ->check(one_of(keys_of(kMatrixKeys)));
    c.add_value("--product", o.product, "ORDER",
                "Order of the product of view and projection: projection-view or view-projection")
        ->check(one_of(keys_of(kProductKeys)));
    c.add_value(
         "--stored", o.stored, "KIND",
         "Meaning of a texel: depth, linear, axis-metres, distance-metres, distance-share, exponential or moments")
        ->check(one_of(keys_of(bundle::kStoredKeys)));
    c.add_value("--up", o.up, "AXIS", "Axis of the light's file that is up in the scene: y, z, x, -y, -z or -x")
        ->check(one_of(keys_of(bundle::kUpKeys)));
    c.add_value("--mirrored", o.mirrored, "AXIS", "Axis of the light's file that the scene mirrors: none, x, y or z")
        ->check(one_of(keys_of(kMirroredKeys)));
    c.add_value("--unit", o.unit, "N", "Length in the scene of one unit of the light's file, such as 0.01")
        ->check(CLI::Range(1e-6, 1e6));
    c.add_value("--pick", o.pick, "N", "Take row N of the list of readings")->check(CLI::Range(1, 10000));
    c.add_json("All readings with their errors as JSON");
}

void add_import_capture(CLI::App& app, Run& run) {
    auto& c = add_command(app, run, "import-capture",
                          "Write the shadow maps of a RenderDoc capture (OpenGL or Vulkan) as a bundle, with scene, "
                          "camera and picture. Opening a capture runs its shaders",
                          run_import_capture);
    ImportCaptureOptions& o = c.options;
    c.app().add_option("CAPTURE", o.capture, "A capture, .rdc")->required();
    c.add_output("BUNDLE", "The bundle to write, a folder whose name ends in .bundle");
    c.app().add_flag("--list", o.list, "Print the shadow maps of the capture and write nothing");
    c.add_value("--pick", o.picks, "N", "Write only this map of the list (repeatable)")->check(CLI::Range(0, 1 << 20));
    c.add_json("The list, or the numbers of the comparison, as JSON");
}

void add_probe(CLI::App& app, Run& run) {
    auto& c = add_command(app, run, "probe", "Print the shadow test of one pixel, step by step", run_probe);
    c.add_session();
    c.add_value("--pixel", c.options.pixel, "X,Y", "The pixel, counted from the top left")->required();
    c.add_size();
    c.add_numeric();
    c.app().add_flag("!--no-truth", c.options.reference,
                     "Trace no rays: print only the map's result, without a verdict");
    c.add_output("F.svg",
                 "Draw the shadow test of view.light as a cross-section along the light's ray; fixes are not searched");
    c.add_json("All numbers as JSON");
}

void add_list(CLI::App& app, Run& run) {
    auto& c =
        add_command(app, run, "list", "List settings, presets, filters and other tables, with explanations", run_list);
    c.app()
        .add_option("WHAT", c.options.kind,
                    fmt::format("{}, or profile with the name of an engine as KEY", fmt::join(list_kinds(), ", ")))
        ->required();
    c.app().add_option(
        "KEY", c.options.prefix,
        "Only keys that start with this, such as bias or bias.slope; of settings, where none does, those "
        "found by these words, such as \"normal bias\"");
    c.add_json("An array of rows as JSON");
}

void add_presets(CLI::App& app, Run& run) {
    auto& group = *app.add_subcommand("preset", "Check, show and write presets");
    group.require_subcommand(1);
    const auto add = [&](const char* name, const char* about, void (*execute)(const PresetOptions&)) -> auto& {
        return add_command(group, run, name, about, execute);
    };
    auto& check =
        add("check", "Check whether a preset can be loaded; print the first fault and its place", run_preset_check);
    auto& show = add("show", "List what a preset changes", run_preset_show);
    for (auto* command : {&check, &show})
        command->app().add_option("FILE", command->options.file, "A preset file, or a built-in preset")->required();
    auto& save = add("save", "Write the settings of SCENE, --preset and --set as a preset", run_preset_save);
    save.add_session();
    save.add_output("FILE", "The preset file, .json")->required();
    save.add_value("--about", save.options.about, "TEXT", "A sentence on what to look at");
    save.add_value("--title", save.options.title, "TEXT", "A few words, its name in lists");
    save.add_value("--topic", save.options.topic, "TEXT", "Its heading in lists");
    auto& diff = add("diff", "Print the differences of two presets in words", run_preset_diff);
    diff.app().add_option("A", diff.options.file, "A preset file, a built-in preset, or default")->required();
    diff.app()
        .add_option("B", diff.options.other_file, "The other preset: a file, a built-in preset, or default")
        ->required();
    diff.add_json("All differences as JSON");
}

void start_editor(const EditOptions& o) {
    EditorOptions e = o.editor;
    if (e.headless && e.screenshot.empty()) throw UsageError("edit --headless: --screenshot F.png is missing");
    if (!e.headless && !e.screenshot.empty()) throw UsageError("edit --screenshot: only together with --headless");
    if (!e.screenshot.empty()) require_output(e.screenshot, "the screenshot", {".png"});
    e.width = o.size.width;
    e.height = o.size.height;
    e.size_given = o.size_given;
    if (!e.report.empty()) require_writable(e.report);
    require_distinct(e.screenshot, "--screenshot", e.report, "--report");
    require_outputs_not_read(std::vector{e.screenshot, e.report},
                             std::vector<std::filesystem::path>{o.session.scene, o.session.preset});
    page_named(e.tab);
    if (!o.probe.empty()) std::tie(e.probe_x, e.probe_y) = parse_pixel(o.probe, o.size, "--probe");
    e.session = o.session;
    e.welcome = o.session.scene.empty() && o.session.preset.empty() && e.sweep.empty() && e.tab.empty();
    e.check_numeric = o.check_numeric;
    if (!e.headless && !o.no_state) e.state_folder = state_folder();
    if (o.no_state) light_maps().set_disk_folder({});
    // A desktop passes any file that the program is registered for as SCENE.
    if (e.session.preset.empty() && lower_extension(o.session.scene) == ".json" && !is_bundle_path(o.session.scene))
        std::swap(e.session.preset, e.session.scene);
    if (lower_extension(e.session.preset) == ".json") e.preset = e.session.preset;
    print_notes(run_editor(e));
}

/// Adds the command `edit` and returns its options.
EditOptions& add_edit(CLI::App& app, Run& run) {
    auto& c = add_command(app, run, "edit", "Open the editor, or draw it into a file", start_editor);
    EditorOptions& o = c.options.editor;
    c.add_session(false);
    c.app().add_flag("--headless", o.headless, "Draw the editor through EGL, without a display");
    c.add_value("--screenshot", o.screenshot, "F.png", "The picture that --headless writes");
    c.add_size({o.width, o.height});
    c.add_value("--probe", c.options.probe, "X,Y", "Probe this pixel of the scene's picture at the start");
    c.app().add_option(
        "--tab", o.tab,
        "The tab in front at the start: settings, objects, lights, pixel (or probe), improve, error, frontier, "
        "effects, compare, imported, lab, numbers or log");
    c.add_value("--theme", o.theme, "T", "dark or light (default: the theme chosen last)")
        ->check(one_of({"dark", "light"}));
    c.add_value("--sweep", o.sweep, "DIR", "Show the sweep in this folder in the tab frontier");
    c.add_numeric();
    c.add_value("--report", o.report, "F.json",
                "Write a report of the session as JSON, every few seconds: driver messages, errors, unsound numbers, "
                "and memory by owner over time");
    c.app().add_flag("--no-state", c.options.no_state,
                     "Neither read nor keep layout, recent files and autosaves "
                     "($XDG_STATE_HOME/shadow-inspector, by default below ~/.local/state); implies --no-cache");
    return c.options;
}

void add_others(CLI::App& app, Run& run) {
    add_command(app, run, "info", "Print the OpenGL driver, its limits, and the clock that measures times", run_info)
        .add_json();

    auto& scene =
        add_command(app, run, "scene",
                    "Print the contents of a scene, and the parts of its file that were dropped and why", run_scene);
    scene.add_scene()->required();
    scene
        .add_setting<int>("--index", "scene.index", "N",
                          "Index of the scene in a glTF file, from 0 (default: the file's own default)")
        ->check(CLI::Range(0, 9999));
    scene.add_setting<std::string>("--up", "scene.up", "AXIS",
                                   "Axis of the file that points up: x, y, z, -x, -y, -z (default: as the file says)");
    scene.add_setting<double>("--unit", "scene.unit", "M",
                              "Metres in one unit of the file (default: as the file says)");
    scene.add_json();

    auto& sheet =
        add_command(app, run, "contact-sheet", "Draw every model below a folder into one picture", run_contact_sheet);
    sheet.app()
        .add_option("FOLDER", sheet.options.folder,
                    fmt::format("The folder to search for models ({})", importer_extensions()))
        ->required();
    sheet.add_output("SHEET", "The sheet, .png; its index is written next to it as .txt")->required();
    sheet.app()
        .add_option("--columns", sheet.options.columns, "Tiles in a row (default 8)")
        ->check(CLI::Range(1, 1000));
    sheet.add_numeric();
    sheet.add_size({256, 192});

    auto& out = add_command(
        app, run, "export",
        "Write a scene as glTF, in the pose that the settings choose; other settings of --preset and --set become its "
        "suggested settings. With --bundle: write the frame with its shadow maps",
        run_export);
    out.add_session();
    auto* gltf = out.add_output("FILE", "The file: .gltf (one file, buffers inside) or .glb");
    auto* bundle =
        out.add_file_to_write("--bundle", out.options.bundle, "BUNDLE",
                              "Write scene, camera, lights, shadow maps and picture as a bundle: a folder that ends in "
                              ".bundle, or a .zip file (docs/bundle.md)");
    gltf->excludes(bundle);
    out.add_value("--maps", out.options.maps, "FORMAT",
                  "With --bundle: file format of the maps: pfm (default), or exr (losslessly compressed)")
        ->check(one_of({"pfm", "exr"}))
        ->needs(bundle);
    out.add_size();

    auto& overview = add_command(
        app, run, "overview", "Draw editor, scene, shadow map and visibility into a folder, and print passes and times",
        run_overview);
    overview.options.output = kOverviewFolder;
    overview.add_session(false);
    overview.add_output("DIR", "The folder; made if missing (default out)");
    overview.add_numeric();
    overview.add_size({}, kComparedPixelBytes);

    auto& docs = add_command(
        app, run, "docs",
        "Write docs/settings.md, presets.md, metrics.md or techniques.md from the program's own tables", run_docs);
    docs.app().add_option(
        "WHAT", docs.options.what,
        "settings (the default), presets, metrics, hard-cases, techniques (draws), or the JSON schemas "
        "bundle-schema and preset-schema");
    auto* page = docs.add_output("FILE", "The file (default: standard output)");
    docs.add_value("--only", docs.options.only, "KEY=CHOICE",
                   "Write the rows of one choice alone; the other rows of the page of techniques stay")
        ->needs(page);
    docs.app()
        .add_flag("--check", docs.options.check, "Compare instead of writing; fails when the file is out of date")
        ->needs(page);
}

/// Runs the program without a command: the editor if there is a display, else `overview`.
void run_default(const EditOptions& options) {
    if (WindowContext::display_available()) return start_editor(options);
    fmt::print(
        "There is no display (DISPLAY and WAYLAND_DISPLAY are not set): drawing into {}/ instead of opening the "
        "editor.\n",
        kOverviewFolder);
    run_overview({.output = kOverviewFolder});
}

int fail(ExitCode code, const std::string& message) {
    std::fflush(stdout);
    print_to_stderr(fmt::format("shadow-inspector: {}\n", one_line(message)));
    return exit_status(code);
}

/// Returns the parser's error message, with the nearest name for an unknown command or option.
std::string usage_message(const CLI::App& app, const CLI::ParseError& e, int argc, const char* const* argv) {
    std::string message = e.what();
    std::string path = "shadow-inspector";
    const CLI::App* command = &app;
    for (int i = 1; i < argc && argv[i][0] != '-'; ++i) {
        std::vector<std::string> names;
        const CLI::App* next = nullptr;
        for (const CLI::App* c : command->get_subcommands({})) {
            names.push_back(c->get_name());
            if (names.back() == argv[i]) next = c;
        }
        if (names.empty()) break;
        if (!next) {
            message = fmt::format("no command '{}'{}", argv[i], did_you_mean(nearest_name(argv[i], names)));
            break;
        }
        command = next;
        path += " " + command->get_name();
    }
    // An unknown word comes first: it is the reason why the parser misses another one.
    const auto rest = command->remaining();
    const auto unknown = std::ranges::find_if(rest, [](const std::string& word) { return word.starts_with("--"); });
    if (unknown != rest.end()) {
        std::vector<std::string> names;
        for (const CLI::Option* option : command->get_options())
            for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
        const std::string word = unknown->substr(0, unknown->find('='));
        message = fmt::format("no option '{}'{}", word, did_you_mean(nearest_name(word, names)));
    }
    return fmt::format("{} (see {} --help)", message, path);
}

/// Returns the name of an option or argument that was given as an empty word; empty: none was.
std::string given_empty(const CLI::App& command) {
    static constexpr std::string_view kTexts[] = {"--about", "--title", "--topic"};  // a preset may have none
    for (const CLI::Option* option : command.get_options()) {
        const std::string name = option->get_name();
        if (std::ranges::find(kTexts, name) != std::end(kTexts)) continue;
        if (std::ranges::find(option->results(), std::string()) != option->results().end()) return name;
    }
    for (const CLI::App* sub : command.get_subcommands())
        if (const std::string name = given_empty(*sub); !name.empty()) return name;
    return {};
}

}  // namespace

int run_cli(int argc, const char* const* argv) {
    CLI::App app(
        "Shadow Inspector: a scene next to its live shadow map.\n"
        "Without a command: opens the editor, or, without a display, draws everything into out/.",
        "shadow-inspector");
    app.set_version_flag("--version", version_text, "Print the program's version and those of its files");
    app.require_subcommand(0, 1);
    app.get_formatter()->column_width(34);
    Run run;
    const EditOptions& edit = add_edit(app, run);
    run = [&edit] { run_default(edit); };
    for (const auto add : {add_render, add_reference, add_measure, add_check, add_convert, add_compare_pictures,
                           add_compare_maps, add_import_map, add_import_capture, add_probe, add_list,
                           add_measure_commands, add_presets, add_others, add_printed_tables})
        add(app, run);
    if (const auto folder = cache_folder(); !folder.empty()) light_maps().set_disk_folder(folder / "light-maps");
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& e) {
        if (e.get_exit_code() == 0) return app.exit(e);
        return fail(ExitCode::WrongUsage, usage_message(app, e, argc, argv));
    }
    if (const std::string name = given_empty(app); !name.empty())
        return fail(ExitCode::WrongUsage,
                    fmt::format("{} is given as an empty word; leave it out or name something", name));
    try {
        run();
        finish_stdout();
        return exit_status(ExitCode::Done);
    } catch (const LimitExceeded& e) {
        return fail(ExitCode::LimitExceeded, e.what());
    } catch (const UsageError& e) {
        return fail(ExitCode::WrongUsage, e.what());
    } catch (const std::bad_alloc&) {
        return fail(ExitCode::Failed, "out of memory; try a smaller picture or map.resolution");
    } catch (const std::exception& e) {
        return fail(ExitCode::Failed, e.what());
    }
}

}  // namespace si
