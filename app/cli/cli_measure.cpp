#include <fmt/format.h>

#include "app/cli/command.h"
#include "app/commands/light_path.h"
#include "app/commands/report.h"
#include "renderer/measure/shadow_time.h"

namespace si {
namespace {

constexpr PictureSize kSmallPicture{640, 360};  ///< for commands that draw many pictures

void add_sweep(CLI::App& app, Run& run) {
    auto& c = add_command(app, run, "sweep",
                          "Measure error and time over combinations of settings, and report the frontier; or along a "
                          "path of the light (--along, --day)",
                          run_path_sweep);
    PathSweepOptions& o = c.options;
    c.add_session();
    c.add_value("--vary", o.vary, "KEY=VALUES",
                "A setting and its values: KEY=V1,V2,... or KEY=from:to:step (step *2 doubles) or KEY=* for every "
                "choice; may be repeated")
        ->allow_extra_args(false);
    auto* along = c.add_value(
        "--along", o.along, "PATH",
        "Move a light instead: KEY=from:to,KEY=from:to, such as light.azimuth=0:90,light.elevation=10:60. All "
        "move together; writes path.json, path.csv and path.html");
    auto* day = c.add_value(
        "--day", o.day, "LATITUDE,DAY",
        "Move the sun from sunrise to sunset instead: degrees (north is positive) and day of the year, such as "
        "48,172. South is +z, east +x");
    c.app()
        .add_option("--steps", o.steps, fmt::format("With --along and --day: number of steps (default {})", kPathSteps))
        ->type_name("N")
        ->check(CLI::Range(1, kMaxPathSteps));
    c.add_value("--error", o.error, "NAME",
                "With --along and --day: error whose largest value is the worst step, named as in `measure --json` "
                "(default: mae)");
    c.add_file_to_write("--worst-preset", o.worst_preset, "F.json",
                        "With --along and --day: write the settings of the worst step as a preset");
    c.add_output("DIR", "The folder of the results; made if missing. The same command continues an interrupted sweep")
        ->required();
    c.add_size(kSmallPicture, kMeasuredPixelBytes);
    c.app()
        .add_option("--rounds", o.timing.rounds,
                    "Largest number of rounds of timed frames (default 10); fewer if every case's time has settled")
        ->check(CLI::Range(1, 10'000))
        ->excludes(along)
        ->excludes(day);
    c.app()
        .add_option("--frames", o.timing.frames, "Timed frames of a case in a round (default 3)")
        ->check(CLI::Range(1, 1'000))
        ->excludes(along)
        ->excludes(day);
    c.add_area();
    o.cost = kFrontierCost;
    c.add_cost();
    c.app().add_flag_callback(
        "--no-time", [&o] { o.timing.on = false; }, "Measure errors and costs only");
    c.add_value("--shard", o.shard, "I/N", "Measure only part I of N, without times (`merge` joins the parts)");
    c.add_numeric();
    c.app().add_flag("--retry", o.retry, "Measure failed cases again");
    c.app().add_flag("--fresh", o.fresh, "Start again: remove the files of an earlier sweep from the folder");
}

void add_merge(CLI::App& app, Run& run) {
    auto& c = add_command(app, run, "merge", "Join the shards of a sweep", run_merge);
    c.app().add_option("DIR", c.options.parts, "Folders of shards")->required();
    c.add_output("DIR", "The folder of the joined sweep; made if missing")->required();
    c.app().add_flag("--fresh", c.options.fresh, "Start again: remove the files of an earlier sweep from the folder");
}

void add_tune(CLI::App& app, Run& run) {
    auto& c = add_command(app, run, "tune",
                          "Find the bias with the least score (wrong pixels and faint errors), of all kinds, and write "
                          "it as a preset; with "
                          "limits, search kernel and resolution, too",
                          run_tune);
    c.add_session();
    c.add_output("PRESET", "The preset, .json")->required();
    c.add_limits(c.options, "Search kernels and resolutions for the cheapest whose error (--error) is at most this",
                 "Search kernels and resolutions for the most accurate whose frame takes at most this long, in ms of "
                 "the clock that info names",
                 "Error that --max-error limits, named as in `measure --json` (1 minus the value if more is better)");
    c.app().add_flag("--no-acne", c.options.no_acne,
                     "Choose among biases that leave acne in at most 0.01 % of the pixels; fail where there is none");
    c.add_value("--max-gap", c.options.max_gap, "M",
                "Largest lit gap at casters that touch their receiver, in metres, for 95 % of the lit surface")
        ->check(CLI::PositiveNumber);
    c.add_area();
    c.add_size({}, kMeasuredPixelBytes);
    c.add_cost();
    c.add_numeric();
    c.add_json("Attempts and result as JSON");
}

void add_plan(CLI::App& app, Run& run) {
    auto& c = add_command(app, run, "plan",
                          "Print what a frame draws, caches and skips, and why; with --measure the time "
                          "that each optimisation saves",
                          run_plan);
    PlanOptions& o = c.options;
    c.add_session();
    auto* measure = c.app().add_flag("--measure", o.measure,
                                     "Time frames with and without each optimisation alternately, and print the "
                                     "difference in milliseconds");
    c.app()
        .add_option("--rounds", o.rounds, "With --measure: number of rounds (default 15)")
        ->check(CLI::Range(3, 10'000))
        ->needs(measure);
    c.add_numeric();
    c.app().add_flag("--waste", o.waste,
                     "Leave out each map, face and cascade in turn; list those that change no byte of the picture");
    c.add_size();
    c.add_json();
}

void add_advise(CLI::App& app, Run& run) {
    auto& c = add_command(app, run, "advise",
                          "Print changes of settings that save time at no or little loss, each "
                          "measured; with a limit, find the best effects within it (autopilot)",
                          run_advise);
    AdviseOptions& o = c.options;
    c.add_session();
    c.add_limits(o, "Autopilot: the cheapest effects whose error (--error) is at most this",
                 "Autopilot: the most accurate effects whose frame takes at most this long (--cost), in ms of the "
                 "clock that info names",
                 "Error to limit, named as in `measure --json`");
    c.add_value("--vary", o.vary, "KEY=VALUES",
                "Setting and values that the autopilot tries, as in `sweep`; may be repeated (default: chosen from the "
                "scene)")
        ->allow_extra_args(false);
    c.app()
        .add_option("--seconds", o.max_seconds, "Time limit of the autopilot in seconds (default 100)")
        ->check(number_between(1, 1e6));
    c.add_output("PRESET", "The preset that the autopilot writes, .json");
    c.add_cost();
    c.add_numeric();
    c.add_area();
    c.add_size({}, kMeasuredPixelBytes);
    c.add_json("All results and attempts as JSON");
}

void add_precision(CLI::App& app, Run& run) {
    auto& c = add_command(app, run, "precision",
                          "Print the error of single against double precision in map coordinates "
                          "and depths, for each way to compute them (map.origin, map.transform)",
                          run_precision);
    c.add_session();
    c.add_value(
         "--over", c.options.over, "WHAT",
         fmt::format("Series of scenes farther away, larger, or deeper: {}", fmt::join(precision_series(), ", ")))
        ->check(one_of(precision_series()));
    c.add_size(kSmallPicture, kMeasuredPixelBytes);
    c.add_json();
}

void add_shimmer(CLI::App& app, Run& run) {
    auto& c = add_command(
        app, run, "shimmer",
        "Measure how much shadow edges shimmer while camera or light move by parts of a texel, with and without "
        "snapping to whole texels",
        run_shimmer);
    ShimmerOptions& o = c.options.shimmer;
    c.add_session();
    std::vector<std::string_view> motions;
    for (const ShimmerMotionRow& row : shimmer_motions()) motions.push_back(row.key);
    c.app()
        .add_option_function<std::string>(
            "--motion",
            [&o](const std::string& key) {
                o.motion = std::ranges::find(shimmer_motions(), key, &ShimmerMotionRow::key)->motion;
            },
            fmt::format("Moving part: {} (default camera)", fmt::join(motions, ", ")))
        ->check(one_of(motions))
        ->type_name("WHAT");
    c.add_value("--steps", o.steps, "N", "Number of steps (default 32)")->check(CLI::Range(1, 10'000));
    c.add_value("--step-texels", o.step_texels, "T", "Length of a step in texels of the map (default 0.3)")
        ->check(number_between(1e-3, 100));
    c.add_output("OUT", "A picture of the share of steps in which each pixel flips: .png, .pfm or .exr");
    c.add_size(kSmallPicture, kMeasuredPixelBytes);
    c.add_json();
}

void add_report(CLI::App& app, Run& run) {
    auto& c = add_command(app, run, "report",
                          "Write one page that compares presets on a scene: pictures, wrong pixels, diagnosed pixels, "
                          "numbers and commands, to attach to a bug",
                          run_report);
    ReportOptions& o = c.options;
    c.add_scene()->required();
    c.add_value(
         "--preset", o.presets, "F",
         "A preset: a file or a built-in one (`list presets`); may be repeated. All are drawn in the view of the "
         "first one")
        ->required()
        ->allow_extra_args(false);
    c.add_value("--set", o.session.sets, "KEY=VALUE", "Set one setting of all presets; may be repeated")
        ->allow_extra_args(false);
    c.add_value("--pixel", o.pixels, "X,Y",
                "A pixel to diagnose and draw, counted from the top left; may be repeated (default: of each cause, the "
                "middle of its largest cluster)")
        ->allow_extra_args(false);
    c.add_output("F.html", "The page, .html")->required();
    c.add_size({}, kMeasuredPixelBytes);
    c.add_area();
    c.add_cost();
    c.app().add_flag("!--no-time", o.time, "Measure errors only");
}

}  // namespace

void add_measure_commands(CLI::App& app, Run& run) {
    for (const auto add :
         {add_sweep, add_merge, add_tune, add_plan, add_advise, add_precision, add_shimmer, add_report})
        add(app, run);
}

}  // namespace si
