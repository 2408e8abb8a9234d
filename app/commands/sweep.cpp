#include <fmt/format.h>

#include <chrono>

#include "app/base/interrupt.h"
#include "app/base/notes.h"
#include "app/commands/commands.h"
#include "app/context/headless_context.h"
#include "app/report/health_report.h"
#include "app/sweep/files.h"
#include "app/sweep/merge.h"
#include "app/sweep/progress_line.h"
#include "app/sweep/running_sweep.h"
#include "renderer/base/error.h"
#include "renderer/scenes/builtin.h"

namespace si {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;

constexpr auto kCheckpoint = 10s;
constexpr double kBusyLoad = 0.5;  // running processes per core

/// Runs all steps of a sweep until its end or Ctrl+C, and writes results at intervals.
void run_steps(RunningSweep& sweep, const InterruptGuard& interrupt) {
    ProgressLine line;
    auto checkpoint = std::chrono::steady_clock::now() + kCheckpoint;
    while (!interrupt.stop_requested() && sweep.step()) {
        line.show(sweep.progress(), sweep.inputs().timing);
        if (std::chrono::steady_clock::now() < checkpoint) continue;
        write_sweep_files(sweep.inputs().folder, sweep.state(), sweep.inputs().plan, SweepFiles::Results);
        checkpoint = std::chrono::steady_clock::now() + kCheckpoint;
    }
}

void print_result(const SweepResults& results, const fs::path& folder) {
    fmt::print("{}", frontier_text(results));
    if (results.failed > 0) fmt::print("{} of {} cases failed; results.csv says why\n", results.failed, results.cases);
    print_wrote(folder / "report.html");
}

std::vector<std::string> notes_on_pictures(const fs::path& folder, const SweepResults& results) {
    std::vector<std::string> lacking;
    for (const SweepRow& row : results.rows)
        if (row.failed.empty() && lacks_pictures(folder, row.number)) lacking.push_back(std::to_string(row.number));
    if (lacking.empty()) return {};
    const std::size_t count = lacking.size();
    if (count > 10) {
        lacking.resize(10);
        lacking.push_back("...");
    }
    return {fmt::format("{} of {} cases have no pictures ({}); the sweep's command with -o {} draws them", count,
                        results.rows.size(), fmt::join(lacking, ", "), folder.string())};
}

}  // namespace

void run_sweep(const SweepOptions& options) {
    std::vector<SweepAxis> axes;
    for (const std::string& axis : options.vary) axes.push_back(parse_axis(axis));
    const Shard shard = options.shard.empty() ? Shard{} : parse_shard(options.shard);
    const fs::path folder = options.output;
    require_sweep_folder(folder);
    SessionPlan opened = plan_session(options.session);
    protect_assigned_settings(axes, assigned_keys(opened.sets));
    Scene scene = load_scene(opened.scene_name, scene_options(opened));
    require_outputs_not_read(sweep_files(folder), scene, opened.preset_path);
    Session session = compose_session(opened, std::move(scene));
    SweepSpec spec = sweep_spec(session.scene_name, session.scene, session.settings, std::move(axes),
                                options.size.width, options.size.height);
    spec.shard = shard;
    SweepPlan plan = plan_sweep(spec.base, spec.axes);
    CaseSessions sessions(std::move(opened));
    sessions.add_scene(std::move(session.scene), session.settings.scene);
    sessions.check(spec.axes);
    if (options.fresh) remove_sweep_files(folder);
    std::vector<std::string> notes = session.notes;
    notes.insert(notes.end(), plan.notes.begin(), plan.notes.end());

    SweepTiming timing = options.timing;
    timing.cost = options.cost;
    // Shards run at the same time on different machines, so that their times are not comparable.
    timing.on = timing.on && shard.count == 1;
    const HeadlessContext context;
    Renderer renderer;
    const NumberWatch numbers(renderer, session.settings, options.check_numeric);
    InterruptGuard interrupt;
    RunningSweep sweep({std::move(sessions), std::move(spec), std::move(plan), timing, options.retry, folder},
                       renderer);
    run_steps(sweep, interrupt);
    const SweepResults results = write_sweep_files(folder, sweep.state(), sweep.inputs().plan);
    if (interrupt.stop_requested()) {
        print_to_stderr(fmt::format(
            "shadow-inspector: interrupted after {} of {} cases; results so far are in {}; the same command goes on "
            "from there\n",
            results.finished + results.failed, sweep.inputs().plan.cases.size(), folder.string()));
        interrupt.end();
    }
    print_result(results, folder);
    print_notes(notes);
    print_notes(sweep.state().notes);
    const std::vector<RunInfo>& runs = sweep.state().runs;
    if (timing.on && !runs.empty() && runs.back().load > kBusyLoad)
        print_notes({fmt::format("the machine was busy before the sweep began (load {:.1f} a core): times are noisy",
                                 runs.back().load)});
    numbers.require_sound();
}

void run_merge(const MergeOptions& options) {
    const fs::path folder = options.output;
    std::vector<std::pair<std::string, SweepState>> parts;
    for (const std::string& part : options.parts) {
        std::error_code ignored;
        if (fs::equivalent(part, folder, ignored))
            throw UsageError(fmt::format("{}: is one of the parts; name another folder with -o", folder.string()));
        parts.emplace_back(part, read_journal(part));
    }
    SweepState merged = merge_sweeps(parts);
    const SweepSpec spec = spec_from_json(merged.spec);
    const SweepPlan plan = plan_sweep(spec.base, spec.axes);
    if (plan_key(plan) != merged.plan)
        throw Error(fmt::format("{}: was made by a version of the program that orders cases differently",
                                options.parts.front()));
    require_sweep_folder(folder);
    if (options.fresh) remove_sweep_files(folder);
    // Results in the folder stay, because merging continues a sweep. The journal refuses the folder of another sweep.
    Journal journal(folder, merged.spec, merged.plan);
    for (const std::string& part : options.parts) copy_pictures(part, folder);
    journal.add(missing_lines(journal.state(), merged));
    const SweepResults results = write_sweep_files(folder, journal.state(), plan);
    print_result(results, folder);
    print_notes(merged.notes);
    print_notes(notes_on_pictures(folder, results));
    if (const auto missing = missing_cases(journal.state(), plan); !missing.empty())
        print_notes(
            {fmt::format("{} of {} cases are missing; is a shard missing? The sweep's command with -o {} measures "
                         "them",
                         missing.size(), plan.cases.size(), folder.string())});
}

}  // namespace si
