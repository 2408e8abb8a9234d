#include "app/cli/cli_measure.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>

#include "renderer/base/error.h"

namespace si {
namespace {

std::optional<double> finite_number(const std::string& text) {
    double value = 0;
    const char* const end = text.data() + text.size();
    const auto read = std::from_chars(text.data(), end, value);
    if (read.ec != std::errc() || read.ptr != end || !std::isfinite(value)) return {};
    return value;
}

/// Makes a validator for a finite number above 0. Its message does not name the largest double, as CLI11's does.
CLI::Validator above_zero() {
    return {[](std::string& text) -> std::string {
                if (const auto value = finite_number(text); value && *value > 0) return {};
                return fmt::format("\"{}\" is not a number above 0", text);
            },
            "NUMBER > 0"};
}

/// Makes a validator for one of these words; its message lists them.
CLI::Validator one_of(const std::vector<std::string_view>& words) {
    return {[words](std::string& text) -> std::string {
                if (std::find(words.begin(), words.end(), text) != words.end()) return {};
                return fmt::format("\"{}\" is none of {}", text, fmt::join(words, ", "));
            },
            fmt::format("{}", fmt::join(words, ", "))};
}

constexpr const char* kAreaHelp =
    "Compare with an area light (light.size), not a point or direction. As --set truth.area=true";
constexpr const char* kAreaSet = "truth.area=true";

}  // namespace

CLI::Validator number_between(double min, double max) {
    return {[=](std::string& text) -> std::string {
                if (const auto value = finite_number(text); value && *value >= min && *value <= max) return {};
                return fmt::format("\"{}\" is not a number from {:g} to {:g}", text, min, max);
            },
            fmt::format("NUMBER in [{:g} - {:g}]", min, max)};
}

void add_numeric_option(CLI::App& command, bool& check) {
    command.add_flag(
        "--check-numeric", check,
        "Search every map, visibility and matrix for NaN, infinite values, depths outside 0 to 1, negative "
        "variances and overflow; print the place of a fault and exit with 1");
}

void add_cost_option(CLI::App& command, CostCase& cost) {
    command
        .add_option_function<std::string>(
            "--cost",
            [&cost](const std::string& key) {
                try {
                    cost = parse_cost(key);
                } catch (const Error& e) {
                    throw CLI::ValidationError("--" + std::string(e.what()));
                }
            },
            fmt::format("Kind of frames to time: {} (default: {})", cost_keys(), cost_row(kDefaultCost).key))
        ->type_name("FRAMES");
}

namespace {

void add_sweep(CLI::App& app, MeasureCliOptions& o, std::function<void()>& run, const AddSessionOptions& add_session) {
    auto* c =
        app.add_subcommand("sweep", "Measure error and time over combinations of settings, and report the frontier");
    add_session(*c, o.sweep.session);
    c->add_option("--vary", o.sweep.vary,
                  "A setting and its values: KEY=V1,V2,... or KEY=from:to:step (step *2 doubles) or KEY=* for every "
                  "choice; may be repeated")
        ->required()
        ->type_name("KEY=VALUES")
        ->allow_extra_args(false);
    c->add_option("-o,--output", o.sweep.folder,
                  "The folder of the results; made if missing. The same command continues an interrupted sweep")
        ->required()
        ->type_name("DIR");
    c->add_option("--size", o.size, "Size of the picture in pixels (default 640x360)")->type_name("WxH");
    c->add_option("--rounds", o.sweep.timing.rounds,
                  "Largest number of rounds of timed frames (default 10); fewer if every case's time has settled")
        ->check(CLI::Range(1, 10'000));
    c->add_option("--frames", o.sweep.timing.frames, "Timed frames of a case in a round (default 3)")
        ->check(CLI::Range(1, 1'000));
    c->add_flag("--area", o.area, kAreaHelp);
    add_cost_option(*c, o.sweep.timing.cost);
    c->add_flag("--no-time", o.no_time, "Measure errors and costs only");
    c->add_option("--shard", o.sweep.shard, "Measure only part I of N, without times (`merge` joins the parts)")
        ->type_name("I/N");
    add_numeric_option(*c, o.sweep.check_numeric);
    c->add_flag("--retry", o.sweep.retry, "Measure failed cases again");
    c->add_flag("--fresh", o.sweep.fresh, "Start again: remove the files of an earlier sweep from the folder");
    c->callback([&o, &run] {
        run = [&o] {
            if (!o.size.empty()) o.sweep.size = parse_size(o.size);
            o.sweep.timing.on = !o.no_time;
            if (o.area) o.sweep.session.sets.push_back(kAreaSet);
            run_sweep(o.sweep);
        };
    });
}

void add_merge(CLI::App& app, MeasureCliOptions& o, std::function<void()>& run) {
    auto* c = app.add_subcommand("merge", "Join the shards of a sweep");
    c->add_option("DIR", o.merge.parts, "Folders of shards")->required();
    c->add_option("-o,--output", o.merge.folder, "The folder of the joined sweep; made if missing")
        ->required()
        ->type_name("DIR");
    c->add_flag("--fresh", o.merge.fresh, "Start again: remove the files of an earlier sweep from the folder");
    c->callback([&o, &run] { run = [&o] { run_merge(o.merge); }; });
}

void add_tune(CLI::App& app, MeasureCliOptions& o, std::function<void()>& run, const AddSessionOptions& add_session) {
    auto* c = app.add_subcommand("tune",
                                 "Find the least bias that leaves no acne, and write it as a preset; with limits, "
                                 "search kernel and resolution, too");
    add_session(*c, o.tune.session);
    c->add_option("-o,--output", o.tune.output, "The preset, .json")->required()->type_name("PRESET");
    c->add_option("--max-error", o.tune.max_error,
                  "Search kernels and resolutions for the cheapest whose error (--error) is at most this")
        ->check(above_zero())
        ->type_name("E");
    c->add_option("--max-ms", o.tune.max_ms,
                  "Search kernels and resolutions for the most accurate whose frame takes at most this long")
        ->check(above_zero())
        ->type_name("MS");
    c->add_option(
         "--error", o.tune.error,
         fmt::format("Error that --max-error limits, named as in `measure --json` (1 minus the value if more is "
                     "better): {} (default: the first)",
                     fmt::join(tuned_errors(), ", ")))
        ->type_name("NAME");
    c->add_flag("--area", o.area, kAreaHelp);
    c->add_option("--size", o.size, "Size of the picture in pixels (default 1280x720)")->type_name("WxH");
    add_cost_option(*c, o.tune.cost);
    add_numeric_option(*c, o.tune.check_numeric);
    c->add_flag("--json", o.tune.json, "Attempts and result as JSON");
    c->callback([&o, &run] {
        run = [&o] {
            if (!o.size.empty()) o.tune.size = parse_size(o.size);
            if (o.area) o.tune.session.sets.push_back(kAreaSet);
            run_tune(o.tune);
        };
    });
}

void add_plan(CLI::App& app, MeasureCliOptions& o, std::function<void()>& run, const AddSessionOptions& add_session) {
    auto* c = app.add_subcommand("plan",
                                 "Print what a frame draws, caches and skips, and why; with --measure the time that "
                                 "each optimisation saves");
    add_session(*c, o.plan.session);
    auto* measure = c->add_flag("--measure", o.plan.measure,
                                "Time frames with and without each optimisation alternately, and print the "
                                "difference in milliseconds");
    c->add_option("--rounds", o.plan.rounds, "With --measure: number of rounds (default 15)")
        ->check(CLI::Range(3, 10'000))
        ->needs(measure);
    add_numeric_option(*c, o.plan.check_numeric);
    c->add_flag("--waste", o.plan.waste,
                "Leave out each map, face and cascade in turn; list those that change no byte of the picture");
    c->add_option("--size", o.size, "Size of the picture in pixels (default 1280x720)")->type_name("WxH");
    c->add_flag("--json", o.plan.json, "As JSON");
    c->callback([&o, &run] {
        run = [&o] {
            if (!o.size.empty()) o.plan.size = parse_size(o.size);
            run_plan(o.plan);
        };
    });
}

void add_advise(CLI::App& app, MeasureCliOptions& o, std::function<void()>& run, const AddSessionOptions& add_session) {
    auto* c = app.add_subcommand("advise",
                                 "Print changes of settings that save time at no or little loss, each measured; with a "
                                 "limit, find the best effects within it (autopilot)");
    AdviseOptions& a = o.advise;
    add_session(*c, a.session);
    c->add_option("--max-error", a.max_error, "Autopilot: the cheapest effects whose error (--error) is at most this")
        ->check(above_zero())
        ->type_name("E");
    c->add_option("--max-ms", a.max_ms,
                  "Autopilot: the most accurate effects whose frame takes at most this long (--cost)")
        ->check(above_zero())
        ->type_name("MS");
    c->add_option("--error", a.error,
                  fmt::format("Error to limit, named as in `measure --json`: {} (default: the first)",
                              fmt::join(tuned_errors(), ", ")))
        ->type_name("NAME");
    c->add_option("--vary", a.vary,
                  "Setting and values that the autopilot tries, as in `sweep`; may be repeated (default: chosen from "
                  "the scene)")
        ->type_name("KEY=VALUES")
        ->allow_extra_args(false);
    c->add_option("--seconds", a.max_seconds, "Time limit of the autopilot in seconds (default 100)")
        ->check(number_between(1, 1e6));
    c->add_option("-o,--output", a.output, "The preset that the autopilot writes, .json")->type_name("PRESET");
    add_cost_option(*c, a.cost);
    add_numeric_option(*c, a.check_numeric);
    c->add_flag("--area", o.area, kAreaHelp);
    c->add_option("--size", o.size, "Size of the picture in pixels (default 1280x720)")->type_name("WxH");
    c->add_flag("--json", a.json, "All results and attempts as JSON");
    c->callback([&o, &run] {
        run = [&o] {
            if (!o.size.empty()) o.advise.size = parse_size(o.size);
            if (o.area) o.advise.session.sets.push_back(kAreaSet);
            run_advise(o.advise);
        };
    });
}

void add_precision(CLI::App& app, MeasureCliOptions& o, std::function<void()>& run,
                   const AddSessionOptions& add_session) {
    auto* c =
        app.add_subcommand("precision",
                           "Print the error of single against double precision in map coordinates and depths, for "
                           "each way to compute them (map.origin, map.transform)");
    add_session(*c, o.precision.session);
    c->add_option(
         "--over", o.precision.over,
         fmt::format("Series of scenes farther away, larger, or deeper: {}", fmt::join(precision_series(), ", ")))
        ->check(one_of(precision_series()))
        ->type_name("WHAT");
    c->add_option("--size", o.size, "Size of the picture in pixels (default 640x360)")->type_name("WxH");
    c->add_flag("--json", o.precision.json, "As JSON");
    c->callback([&o, &run] {
        run = [&o] {
            if (!o.size.empty()) o.precision.size = parse_size(o.size);
            run_precision(o.precision);
        };
    });
}

void add_shimmer(CLI::App& app, MeasureCliOptions& o, std::function<void()>& run,
                 const AddSessionOptions& add_session) {
    auto* c = app.add_subcommand("shimmer",
                                 "Measure how much shadow edges shimmer while camera or light move by parts of a "
                                 "texel, with and without snapping to whole texels");
    ShimmerCommandOptions& s = o.shimmer;
    add_session(*c, s.session);
    std::vector<std::string_view> motions;
    for (const ShimmerMotionRow& row : shimmer_motions()) motions.push_back(row.key);
    c->add_option_function<std::string>(
         "--motion",
         [&s](const std::string& key) {
             for (const ShimmerMotionRow& row : shimmer_motions())
                 if (row.key == key) s.shimmer.motion = row.motion;
         },
         fmt::format("Moving part: {} (default camera)", fmt::join(motions, ", ")))
        ->check(one_of(motions))
        ->type_name("WHAT");
    c->add_option("--steps", s.shimmer.steps, "Number of steps (default 32)")
        ->check(CLI::Range(1, 10'000))
        ->type_name("N");
    c->add_option("--step-texels", s.shimmer.step_texels, "Length of a step in texels of the map (default 0.3)")
        ->check(number_between(1e-3, 100))
        ->type_name("T");
    c->add_option("-o,--output", s.output, "A picture of the share of steps in which each pixel flips: .png or .pfm")
        ->type_name("OUT");
    c->add_option("--size", o.size, "Size of the picture in pixels (default 640x360)")->type_name("WxH");
    c->add_flag("--json", s.json, "As JSON");
    c->callback([&o, &run] {
        run = [&o] {
            if (!o.size.empty()) o.shimmer.size = parse_size(o.size);
            run_shimmer(o.shimmer);
        };
    });
}

}  // namespace

void add_measure_commands(CLI::App& app, MeasureCliOptions& o, std::function<void()>& run,
                          const AddSessionOptions& add_session) {
    add_sweep(app, o, run, add_session);
    add_merge(app, o, run);
    add_tune(app, o, run, add_session);
    add_plan(app, o, run, add_session);
    add_advise(app, o, run, add_session);
    add_precision(app, o, run, add_session);
    add_shimmer(app, o, run, add_session);
}

}  // namespace si
