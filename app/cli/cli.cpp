#include "app/cli/cli.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdlib>
#include <functional>
#include <new>
#include <tuple>

#include "app/base/notes.h"
#include "app/base/output.h"
#include "app/cli/cli_measure.h"
#include "app/commands/commands.h"
#include "app/editor/editor.h"
#include "app/session/workspace.h"
#include "renderer/base/did_you_mean.h"
#include "renderer/base/error.h"
#include "renderer/base/lower_case.h"
#include "renderer/reference/light_map_cache.h"
#include "renderer/settings/param.h"

namespace si {
namespace {

constexpr const char* kSceneHelp = "A .gltf or .glb file, or a built-in scene (`list scenes`)";

/// Variables that the options of all commands are parsed into.
struct Options {
    SessionOptions session;
    std::string size, output, file, other_file;
    PresetTexts texts;
    RenderOptions render;
    ProbeOptions probe;
    ReferenceCommandOptions reference;
    MeasureOptions measure;
    ListOptions list;
    OverviewOptions overview;
    ContactSheetOptions sheet;
    EditorOptions editor;
    MeasureCliOptions sweeps;
    DocsOptions docs;
    int file_scene = -1;
    bool json = false, no_state = false, area = false;
};

void add_session_options(CLI::App& command, SessionOptions& session, bool scene_required) {
    auto* scene = command.add_option("SCENE", session.scene, kSceneHelp);
    if (scene_required) scene->required();
    command.add_option("--preset", session.preset, "Start from a preset: a file or a built-in one (`list presets`)")
        ->type_name("F");
    command.add_option("--set", session.sets, "Set one setting; may be repeated, the last one wins")
        ->type_name("KEY=VALUE")
        ->allow_extra_args(false);
    command.add_flag_callback(
        "--no-cache", [] { light_maps().set_disk_folder({}); },
        "Neither read nor keep baked light maps ($XDG_CACHE_HOME/shadow-inspector, by default below ~/.cache)");
    command.footer([] { return settings_help(); });
}

void add_size(CLI::App& command, Options& o, const char* standard) {
    o.size = "";
    command.add_option("--size", o.size, fmt::format("Size of the picture in pixels (default {})", standard))
        ->type_name("WxH");
}

PictureSize size_of(const Options& o) {
    return o.size.empty() ? PictureSize{} : parse_size(o.size);
}

void add_render(CLI::App& app, Options& o, std::function<void()>& run) {
    auto* c = app.add_subcommand("render", "Draw a scene into a file");
    add_session_options(*c, o.session, true);
    c->add_option("-o,--output", o.output, "The file: .png (8 bit), or .pfm (float) for views of one number a pixel")
        ->required()
        ->type_name("OUT");
    auto* view = c->add_option("--view", o.render.view,
                               "shaded, visibility, shadow-map, camera-depth or an overlay (`list views`); "
                               "without it the picture with the overlays and panes of view.*")
                     ->type_name("V");
    add_size(*c, o, "1280x720");
    auto* against =
        c->add_option("--against", o.render.against,
                      "Draw another picture of the same frame right of the picture, to compare: truth (the ray-traced "
                      "reference), or a preset (its light, maps, bias, filter and shading)")
            ->type_name("WHAT");
    auto* swipe = c->add_option("--swipe", o.render.swipe,
                                "With --against: one picture, this left of a line at X (0 to 1), the other right of it")
                      ->check(number_between(0, 1))
                      ->type_name("X")
                      ->needs(against);
    c->add_flag("--difference", o.render.difference, "With --against: one picture of 2 |A - B|")
        ->needs(against)
        ->excludes(swipe);
    c->add_option("--fit-camera", o.render.fit_camera,
                  "Fit view-dependent maps and cascades to the camera of this preset instead of the picture's; "
                  "shadows outside its view frustum may be missing")
        ->type_name("F");
    add_numeric_option(*c, o.render.check_numeric);
    c->add_option("--report", o.render.report, "Write facts of the frame as JSON: fit, settings, passes and times")
        ->type_name("F.json");
    c->callback([&o, &run, view] {
        run = [&o, view] {
            o.render.session = o.session;
            o.render.output = o.output;
            o.render.size = size_of(o);
            o.render.view_given = view->count() > 0;
            run_render(o.render);
        };
    });
}

void add_reference(CLI::App& app, Options& o, std::function<void()>& run) {
    auto* c = app.add_subcommand("truth", "Trace the ray-traced reference of a light's shadows into a file");
    add_session_options(*c, o.session, true);
    c->add_option("-o,--output", o.output, "The file: .png (8 bit) or .pfm (float); 1 lit to 0 in shadow")
        ->required()
        ->type_name("OUT");
    auto* area = c->add_flag("--area", o.reference.reference.area,
                             "Give the light its size (light.size); else it is a point or a direction. As --set "
                             "truth.area=true");
    c->add_flag("--as-rasterised", o.reference.reference.as_rasterised,
                "Leave out the faces that culling leaves out of the shadow map (caster.cull)");
    auto* samples = c->add_option("--samples", o.reference.reference.samples,
                                  "With --area: most rays a pixel (default 1024). As --set truth.samples=N")
                        ->check(CLI::Range(1, 1 << 20))
                        ->type_name("N");
    auto* noise = c->add_option("--noise", o.reference.reference.noise,
                                "With --area: wanted standard error of a pixel (default 0.005). As --set truth.noise=E")
                      ->check(number_between(0, 1))
                      ->type_name("E");
    c->add_option("--threads", o.reference.threads, "Threads that trace (default: all)")
        ->check(CLI::Range(1, 1024))
        ->type_name("N");
    add_numeric_option(*c, o.reference.check_numeric);
    add_size(*c, o, "1280x720");
    c->add_option("--report", o.reference.report, "Write counts, rays, noise and times as JSON")->type_name("F.json");
    c->callback([&o, &run, area, samples, noise] {
        run = [&o, area, samples, noise] {
            o.reference.session = o.session;
            std::vector<std::string>& sets = o.reference.session.sets;
            if (area->count()) sets.push_back("truth.area=true");
            if (samples->count()) sets.push_back(fmt::format("truth.samples={}", o.reference.reference.samples));
            if (noise->count()) sets.push_back(fmt::format("truth.noise={}", o.reference.reference.noise));
            o.reference.output = o.output;
            o.reference.size = size_of(o);
            run_reference(o.reference);
        };
    });
}

void add_measure(CLI::App& app, Options& o, std::function<void()>& run) {
    auto* c = app.add_subcommand(
        "measure", "Measure the error of a light's shadows against the ray-traced reference, their time and memory");
    add_session_options(*c, o.session, true);
    c->add_flag("--area", o.area,
                "Compare with an area light (light.size), not a point or direction. As --set truth.area=true");
    c->add_flag("!--no-time", o.measure.time, "Take no times");
    add_cost_option(*c, o.measure.cost);
    add_numeric_option(*c, o.measure.check_numeric);
    c->add_flag("--cures", o.measure.fixes,
                "Try fixes for wrong pixels and measure each: pixels cured and broken, time and bytes");
    add_size(*c, o, "1280x720");
    c->add_flag("--json", o.json, "All numbers as JSON");
    c->callback([&o, &run] {
        run = [&o] {
            o.measure.session = o.session;
            if (o.area) o.measure.session.sets.push_back("truth.area=true");
            o.measure.size = size_of(o);
            o.measure.json = o.json;
            run_measure(o.measure);
        };
    });
}

void add_probe(CLI::App& app, Options& o, std::function<void()>& run) {
    auto* c = app.add_subcommand("probe", "Print the shadow test of one pixel, step by step");
    add_session_options(*c, o.session, true);
    c->add_option("--pixel", o.probe.pixel, "The pixel, counted from the top left")->required()->type_name("X,Y");
    add_size(*c, o, "1280x720");
    add_numeric_option(*c, o.probe.check_numeric);
    c->add_flag("!--no-truth", o.probe.reference, "Trace no rays: print only the map's result, without a verdict");
    c->add_option("-o,--output", o.probe.section,
                  "Draw the shadow test of view.light as a cross-section along the light's ray; fixes are not searched")
        ->type_name("F.svg");
    c->add_flag("--json", o.json, "All numbers as JSON");
    c->callback([&o, &run] {
        run = [&o] {
            o.probe.session = o.session;
            o.probe.size = size_of(o);
            o.probe.json = o.json;
            run_probe(o.probe);
        };
    });
}

void add_list(CLI::App& app, Options& o, std::function<void()>& run) {
    auto* c = app.add_subcommand("list", "List settings, presets, filters and other tables, with explanations");
    c->add_option("WHAT", o.list.kind, fmt::format("{}", fmt::join(list_kinds(), ", ")))->required();
    c->add_option("KEY", o.list.prefix,
                  "Only keys that start with this, such as bias or bias.slope; of settings, where none does, those "
                  "found by these words, such as \"normal bias\"");
    c->add_flag("--json", o.json, "An array of rows as JSON");
    c->callback([&o, &run] {
        run = [&o] {
            o.list.json = o.json;
            run_list(o.list);
        };
    });
}

void add_presets(CLI::App& app, Options& o, std::function<void()>& run) {
    auto* c = app.add_subcommand("preset", "Check, show and write presets");
    c->require_subcommand(1);
    auto* check =
        c->add_subcommand("check", "Check whether a preset can be loaded; print the first fault and its place");
    check->add_option("FILE", o.file, "A preset file, or a built-in preset")->required();
    check->callback([&o, &run] { run = [&o] { run_preset_check(o.file); }; });
    auto* show = c->add_subcommand("show", "List what a preset changes");
    show->add_option("FILE", o.file, "A preset file, or a built-in preset")->required();
    show->callback([&o, &run] { run = [&o] { run_preset_show(o.file); }; });
    auto* save = c->add_subcommand("save", "Write the settings of SCENE, --preset and --set as a preset");
    add_session_options(*save, o.session, true);
    save->add_option("-o,--output", o.output, "The preset file, .json")->required()->type_name("FILE");
    save->add_option("--about", o.texts.about, "A sentence on what to look at")->type_name("TEXT");
    save->add_option("--title", o.texts.title, "A few words, its name in lists")->type_name("TEXT");
    save->add_option("--topic", o.texts.topic, "Its heading in lists")->type_name("TEXT");
    save->callback([&o, &run] { run = [&o] { run_preset_save(o.session, o.texts, o.output); }; });
    auto* diff = c->add_subcommand("diff", "Print the differences of two presets in words");
    diff->add_option("A", o.file, "A preset file, a built-in preset, or default")->required();
    diff->add_option("B", o.other_file, "The other preset: a file, a built-in preset, or default")->required();
    diff->add_flag("--json", o.json, "All differences as JSON");
    diff->callback([&o, &run] { run = [&o] { run_preset_diff(o.file, o.other_file, o.json); }; });
}

void start_editor(Options& o) {
    EditorOptions& e = o.editor;
    if (e.headless && e.screenshot.empty()) throw UsageError("edit --headless: --screenshot F.png is missing");
    if (!e.headless && !e.screenshot.empty()) throw UsageError("edit --screenshot: only together with --headless");
    if (!e.screenshot.empty()) {
        if (lower_extension(e.screenshot) != ".png") {
            throw UsageError(fmt::format("{}: the screenshot must end in .png", e.screenshot.string()));
        }
        require_writable(e.screenshot);
    }
    if (!o.size.empty()) {
        const PictureSize size = parse_size(o.size);
        e.width = size.width;
        e.height = size.height;
        e.size_given = true;
    }
    if (!e.report.empty()) require_writable(e.report);
    require_distinct(e.screenshot, "--screenshot", e.report, "--report");
    tab_named(e.tab);
    if (!o.probe.pixel.empty())
        std::tie(e.probe_x, e.probe_y) = parse_pixel(o.probe.pixel, {e.width, e.height}, "--probe");
    e.session = o.session;
    e.welcome = o.session.scene.empty() && o.session.preset.empty() && e.sweep.empty() && e.tab.empty();
    if (!e.headless && !o.no_state) e.state_folder = state_folder();
    if (o.no_state) light_maps().set_disk_folder({});
    if (lower_extension(o.session.preset) == ".json") e.preset = o.session.preset;
    print_notes(run_editor(e));
}

void add_edit(CLI::App& app, Options& o, std::function<void()>& run) {
    auto* c = app.add_subcommand("edit", "Open the editor, or draw it into a file");
    add_session_options(*c, o.session, false);
    c->add_flag("--headless", o.editor.headless, "Draw the editor through EGL, without a display");
    c->add_option("--screenshot", o.editor.screenshot, "The picture that --headless writes")->type_name("F.png");
    add_size(*c, o, "1600x900");
    c->add_option("--probe", o.probe.pixel, "Probe this pixel of the scene's picture at the start")->type_name("X,Y");
    c->add_option("--tab", o.editor.tab,
                  "The tab in front at the start: effects, probe, error, objects, compare, frontier, advice, lab, "
                  "numbers or log");
    c->add_option("--theme", o.editor.theme, "dark or light (default: the theme chosen last)")
        ->type_name("T")
        ->check(CLI::IsMember({"dark", "light"}));
    c->add_option("--sweep", o.editor.sweep, "Show the sweep in this folder in the tab frontier")->type_name("DIR");
    add_numeric_option(*c, o.editor.check_numeric);
    c->add_option("--report", o.editor.report,
                  "Write a report of the session as JSON, every few seconds: driver messages, errors, unsound numbers, "
                  "and memory by owner over time")
        ->type_name("F.json");
    c->add_flag("--no-state", o.no_state,
                "Neither read nor keep layout, recent files and autosaves "
                "($XDG_STATE_HOME/shadow-inspector, by default below ~/.local/state); implies --no-cache");
    c->callback([&o, &run] { run = [&o] { start_editor(o); }; });
}

void add_others(CLI::App& app, Options& o, std::function<void()>& run) {
    auto* info = app.add_subcommand("info", "Print the OpenGL driver, its limits, and the clock that measures times");
    info->add_flag("--json", o.json, "As JSON");
    info->callback([&o, &run] { run = [&o] { run_info(o.json); }; });

    auto* scene = app.add_subcommand(
        "scene", "Print the contents of a scene, and the parts of its file that were dropped and why");
    scene->add_option("SCENE", o.session.scene, kSceneHelp)->required();
    scene
        ->add_option("--index", o.file_scene,
                     "Index of the scene in a glTF file, from 0 (default: the file's own default)")
        ->check(CLI::Range(0, 9999))
        ->type_name("N");
    scene->add_flag("--json", o.json, "As JSON");
    scene->callback([&o, &run] { run = [&o] { run_scene(o.session.scene, o.file_scene, o.json); }; });

    auto* sheet = app.add_subcommand("contact-sheet", "Draw every model below a folder into one picture");
    sheet->add_option("FOLDER", o.sheet.folder, "The folder to search for .gltf and .glb files")->required();
    sheet->add_option("-o,--output", o.sheet.output, "The sheet, .png; its index is written next to it as .txt")
        ->required()
        ->type_name("SHEET");
    sheet->add_option("--columns", o.sheet.columns, "Tiles in a row (default 8)")->check(CLI::Range(1, 1000));
    add_numeric_option(*sheet, o.sheet.check_numeric);
    add_size(*sheet, o, "256x192");
    sheet->callback([&o, &run] {
        run = [&o] {
            if (!o.size.empty()) o.sheet.size = parse_size(o.size);
            run_contact_sheet(o.sheet);
        };
    });

    auto* out = app.add_subcommand("export",
                                   "Write a scene as glTF, in the pose that the settings choose; other settings of "
                                   "--preset and --set become its suggested settings");
    add_session_options(*out, o.session, true);
    out->add_option("-o,--output", o.output, "The file: .gltf (one file, buffers inside) or .glb")
        ->required()
        ->type_name("FILE");
    out->callback([&o, &run] { run = [&o] { run_export(o.session, o.output); }; });

    auto* overview = app.add_subcommand("overview",
                                        "Draw editor, scene, shadow map and visibility into a folder, and "
                                        "print passes and times");
    add_session_options(*overview, o.session, false);
    overview->add_option("-o,--output", o.overview.folder, "The folder; made if missing (default out)")
        ->type_name("DIR");
    add_numeric_option(*overview, o.overview.check_numeric);
    add_size(*overview, o, "1280x720");
    overview->callback([&o, &run] {
        run = [&o] {
            o.overview.session = o.session;
            o.overview.size = size_of(o);
            run_overview(o.overview);
        };
    });

    auto* docs = app.add_subcommand(
        "docs", "Write docs/settings.md, presets.md, metrics.md or techniques.md from the program's own tables");
    docs->add_option("WHAT", o.docs.what, "settings (the default), presets, metrics, hard-cases or techniques (draws)");
    auto* page =
        docs->add_option("-o,--output", o.docs.output, "The file (default: standard output)")->type_name("FILE");
    docs->add_option("--only", o.docs.only,
                     "Write the rows of one choice alone; the other rows of the page of techniques stay")
        ->type_name("KEY=CHOICE")
        ->needs(page);
    docs->add_flag("--check", o.docs.check, "Compare instead of writing; fails when the file is out of date")
        ->needs(page);
    docs->callback([&o, &run] { run = [&o] { run_docs(o.docs); }; });
}

bool has_display() {
    const auto set = [](const char* name) { return std::getenv(name) && *std::getenv(name); };
    return set("DISPLAY") || set("WAYLAND_DISPLAY");
}

/// Runs the program without a command: the editor if there is a display, else `overview`.
void run_default(Options& o) {
    if (has_display()) {
        start_editor(o);
        return;
    }
    fmt::print(
        "There is no display (DISPLAY and WAYLAND_DISPLAY are not set): drawing into {}/ instead of opening the "
        "editor.\n",
        o.overview.folder);
    run_overview(o.overview);
}

int fail(int code, const std::string& message) {
    std::fflush(stdout);
    print_to_stderr(fmt::format("shadow-inspector: {}\n", one_line(message)));
    return code;
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
    app.set_version_flag("--version", std::string("shadow-inspector ") + SI_VERSION);
    app.require_subcommand(0, 1);
    app.get_formatter()->column_width(34);
    Options options;
    std::function<void()> run = [&options] { run_default(options); };
    add_edit(app, options, run);
    add_render(app, options, run);
    add_reference(app, options, run);
    add_measure(app, options, run);
    add_probe(app, options, run);
    add_list(app, options, run);
    add_measure_commands(app, options.sweeps, run,
                         [](CLI::App& c, SessionOptions& session) { add_session_options(c, session, true); });
    add_presets(app, options, run);
    add_others(app, options, run);
    if (const auto folder = cache_folder(); !folder.empty()) light_maps().set_disk_folder(folder / "light-maps");
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& e) {
        if (e.get_exit_code() == 0) return app.exit(e);
        return fail(2, usage_message(app, e, argc, argv));
    }
    if (const std::string name = given_empty(app); !name.empty())
        return fail(2, fmt::format("{} is given as an empty word; leave it out or name something", name));
    try {
        run();
        finish_stdout();
        return 0;
    } catch (const UsageError& e) {
        return fail(2, e.what());
    } catch (const std::bad_alloc&) {
        return fail(1, "out of memory; try a smaller picture or map.resolution");
    } catch (const std::exception& e) {
        return fail(1, e.what());
    }
}

}  // namespace si
