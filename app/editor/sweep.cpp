#include "app/editor/sweep.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "app/base/output.h"
#include "app/session/command_line.h"
#include "app/session/engine_session.h"
#include "app/sweep/files.h"
#include "app/sweep/measured_cases.h"
#include "app/sweep/progress_line.h"
#include "app/sweep/results.h"
#include "renderer/base/atomic_file.h"
#include "renderer/base/error.h"
#include "renderer/base/temporary_folder.h"
#include "renderer/settings/param.h"

namespace si {
namespace {

namespace fs = std::filesystem;

constexpr int kMaxFolders = 8;            ///< largest number of editors that sweep at the same time
constexpr std::size_t kMaxFinished = 16;  ///< largest number of remembered measurements

bool holds_sweep(const fs::path& folder, const SweepSpec& spec, const SweepPlan& plan) {
    if (!has_journal(folder)) return false;
    try {
        const SweepState state = read_journal(folder);
        return state.plan == plan_key(plan) && spec_difference(state.spec, spec_json(spec)).empty();
    } catch (const std::exception&) {
        return false;  // a damaged sweep starts again
    }
}

/// Checks that a folder holds no other sweep than the one of `state`. @throws Error
void require_no_other_sweep(const fs::path& folder, const SweepState& state) {
    if (!has_journal(folder)) return;
    const SweepState there = read_journal(folder);
    if (const std::string difference = spec_difference(there.spec, state.spec); !difference.empty())
        throw Error(fmt::format("{}: holds another sweep ({}); choose another folder", folder.string(), difference));
    if (there.plan != state.plan)
        throw Error(
            fmt::format("{}: holds a sweep of a version of the program that ordered its cases differently; choose "
                        "another folder",
                        folder.string()));
}

/// Returns the folder whose journal this sweep continues, or an empty folder, and true if this call has made the
/// folder.
std::pair<fs::path, bool> folder_for(const fs::path& parent, const SweepSpec& spec, const SweepPlan& plan) {
    const auto numbered = [&](int i) { return parent / fmt::format("sweep-{}", i); };
    for (int i = 1; i <= kMaxFolders; ++i)
        if (holds_sweep(numbered(i), spec, plan)) return {numbered(i), false};
    std::string problem;
    for (int i = 1; i <= kMaxFolders; ++i) try {
            remove_sweep_files(numbered(i));
            return {numbered(i), make_folders(numbered(i))};
        } catch (const std::exception& e) {
            problem = e.what();
        }
    throw Error(problem);
}

/// Returns the key of the cost axis: the chosen column if cases have values there (during a sweep all of them, so that
/// the plot does not switch from dot to dot), else the first cost column with values.
std::string shown_cost(const SweepFacts& facts, const std::string& chosen) {
    const auto known = [&](std::size_t column, bool of_all) {
        std::size_t cases = 0, have = 0;
        for (const MeasuredCase& c : facts.cases)
            if (c.failed.empty()) {
                ++cases;
                have += column < c.values.size() && std::isfinite(c.values[column]);
            }
        return of_all ? cases > 0 && have == cases : have > 0;
    };
    for (std::size_t i = 0; i < facts.columns.size(); ++i)
        if (facts.columns[i].key == chosen && known(i, facts.running)) return chosen;
    for (std::size_t i = 0; i < facts.columns.size(); ++i)
        if (!facts.columns[i].error && known(i, true)) return facts.columns[i].key;
    return chosen;
}

/// Returns the settings without those that have no effect, and without the camera's and the view's.
Settings comparable(const Settings& settings) {
    return without_ineffective_settings(measured_settings(settings));
}

/// Returns true if two pictures differ at most in their settings.
bool has_same_frame(const MeasuringThread::Picture& a, const MeasuringThread::Picture& b) {
    return a.scene->id == b.scene->id && a.width == b.width && a.height == b.height && a.cost == b.cost;
}

bool is_same(const MeasuringThread::Picture& a, const MeasuringThread::Picture& b) {
    return has_same_frame(a, b) && a.settings == b.settings;
}

/// Returns true if two pictures show the same scene from the same camera, under shadows that differ.
bool differ_in_shadows_only(const MeasuringThread::Picture& of_a, const MeasuringThread::Picture& of_b) {
    const Settings &a = of_a.settings, &b = of_b.settings;
    return has_same_frame(of_a, of_b) && a.camera == b.camera && a.scene == b.scene && a.truth == b.truth &&
           !differing_settings(comparable(a), comparable(b)).empty();
}

}  // namespace

EditorSweep::EditorSweep(const fs::path& state_folder)
    : parent_(state_folder.empty()
                  ? fs::temp_directory_path() / fmt::format("shadow-inspector-{}-{}", ::getuid(), ::getpid())
                  : state_folder),
      temporary_(state_folder.empty()) {
    facts_.columns = measured_columns();
}

EditorSweep::~EditorSweep() {
    thread_.reset();
    drop_empty();
    std::error_code error;
    if (temporary_) fs::remove_all(parent_, error);
}

MeasuringThread& EditorSweep::thread() {
    if (!thread_) thread_ = std::make_unique<MeasuringThread>();
    return *thread_;
}

std::shared_ptr<const Scene> EditorSweep::copy_of(const Scene& scene) {
    if (!scene_ || scene_->id != scene.id) scene_ = std::make_shared<const Scene>(scene);
    return scene_;
}

void EditorSweep::start(const Scene& scene, const EditorState& state, const SweepRequest& request) {
    std::vector<SweepAxis> axes;
    for (const std::string& axis : request.axes) axes.push_back(parse_axis(axis));
    if (axes.empty()) throw UsageError("a sweep varies at least one setting");
    Settings measured = state.settings;
    measured.truth.area = request.area;
    RunningSweep::Inputs inputs{.sessions = CaseSessions(session_plan(state.scene_name, scene, measured))};
    inputs.spec = sweep_spec(state.scene_name, scene, measured, std::move(axes), request.width, request.height);
    inputs.plan = plan_sweep(inputs.spec.base, inputs.spec.axes);
    const auto [folder, is_new] = folder_for(parent_, inputs.spec, inputs.plan);
    inputs.folder = folder;
    if (is_new) made_.insert(folder);
    inputs.timing.cost = request.timed;
    show({inputs.spec, inputs.plan, inputs.folder});
    swept_cost_ = request.timed;
    thread().start_sweep(std::move(inputs), copy_of(scene), state.settings.scene);
}

void EditorSweep::show(Shown shown) {
    shown_ = std::make_unique<const Shown>(std::move(shown));
    results_.reset();
    facts_.problem.clear();
    fresh_ = true;
}

void EditorSweep::drop_empty() {
    std::erase_if(made_, [](const fs::path& folder) {
        try {
            if (has_journal(folder)) {
                const auto cases = read_journal(folder).cases;
                if (std::ranges::any_of(cases, [](const auto& c) { return c.second.finished; })) return true;
            }
            remove_sweep_files(folder);
            fs::remove(folder);  // fails if other files are in the folder, which then stays
            return true;
        } catch (const std::exception&) {
            return false;
        }
    });
}

void EditorSweep::measure_present(const Scene& scene, const EditorState& state) {
    const SweepPanel& panel = state.sweep;
    Settings wanted = measured_settings(state.settings);
    // Dots of one plot belong to pictures of one size, compared with one kind of reference.
    const int width = shown_ ? shown_->spec.width : panel.width, height = shown_ ? shown_->spec.height : panel.height;
    wanted.truth.area = shown_ ? shown_->spec.area : panel.area;
    const CostCase cost = shown_ ? swept_cost_ : panel.timed;
    MeasuringThread::Picture present{copy_of(scene), std::move(wanted), width, height, cost};
    if (followed_ && is_same(*followed_, present)) return measure_marks(scene, state);
    followed_ = std::move(present);
    mark_.reset();
    marks_are_known_ = false;
    measures_mark_ = false;
    thread().start_measurement(*followed_);
}

void EditorSweep::measure_marks(const Scene& scene, const EditorState& state) {
    if (marks_are_known_ || mark_ || facts_.measuring_present || has_news() || !facts_.present_problem.empty()) return;
    const auto measure = [&](const Settings* settings) {
        const auto picture = settings ? present_picture_under(*settings) : std::nullopt;
        const auto is_refused = [&](const MeasuringThread::Picture& p) { return is_same(p, *picture); };
        if (!picture || finished(picture) || std::ranges::any_of(refused_, is_refused)) return false;
        mark_ = picture;
        measures_mark_ = true;
        thread().start_measurement(*picture);
        return true;
    };
    marks_are_known_ =
        !measure(state.pinned ? &state.pinned->settings : nullptr) && !measure(engine_defaults(scene, state));
}

std::optional<MeasuringThread::Picture> EditorSweep::present_picture_under(const Settings& settings) const {
    if (!followed_) return {};
    MeasuringThread::Picture picture = *followed_;
    picture.settings = measured_settings(settings);
    picture.settings.truth.area = followed_->settings.truth.area;
    if (!differ_in_shadows_only(picture, *followed_)) return {};
    return picture;
}

const Settings* EditorSweep::engine_defaults(const Scene& scene, const EditorState& state) {
    const EnginePanel& panel = state.engine_panel;
    if (!panel.profile) return nullptr;
    const bool known = engine_.profile == panel.profile && engine_.angle_deg == panel.angle_deg &&
                       engine_.scene == scene.id && engine_.over == state.settings;
    if (!known) {
        engine_ = {panel.profile, panel.angle_deg, state.settings, scene.id, state.settings};
        try {
            apply_engine({.profile = panel.profile, .values = {}, .angle_deg = panel.angle_deg}, scene, false, {},
                         *engine_.are);
        } catch (const Error&) {
            engine_.are.reset();
        }
    }
    return engine_.are ? &*engine_.are : nullptr;
}

const EditorSweep::Finished* EditorSweep::finished(const std::optional<MeasuringThread::Picture>& picture) const {
    if (!picture) return nullptr;
    for (const std::vector<Finished>* list : {&finished_, &marks_})
        for (const Finished& f : *list)
            if (is_same(f.of, *picture)) return &f;
    return nullptr;
}

void EditorSweep::stop_measuring_present() {
    if (!followed_) return;
    followed_.reset();
    mark_.reset();
    thread_->cancel_measurement();
}

void EditorSweep::open(const fs::path& folder, SweepPanel& panel) {
    const SweepState state = read_journal(folder);
    const SweepSpec spec = spec_from_json(state.spec);
    const SweepPlan plan = plan_sweep(spec.base, spec.axes);
    if (plan_key(plan) != state.plan)
        throw Error(
            fmt::format("{}: was made by a version of the program that orders cases differently; start the sweep again",
                        folder.string()));
    cancel();
    if (thread_) thread_->wait_for_sweep();
    show({spec, plan, folder});
    results_ = sweep_results(state, plan);
    if (results_->rounds > 0) panel.timed = swept_cost_ = results_->cost;
    seen_sweep_ = thread_ ? thread_->status().sweep : 0;
    opened_ = true;
    // The cancelled sweep's progress is not fetched any more.
    facts_.running = facts_.timing = false;
    facts_.progress = facts_.seconds_left = 0;
    facts_.current.clear();
    drop_empty();
    panel.width = spec.width;
    panel.height = spec.height;
    panel.area = spec.area;
    panel.axes.clear();
    for (const SweepAxis& axis : spec.axes)
        panel.axes.push_back({axis.key, fmt::format("{}", fmt::join(axis.values, ","))});
    panel.chosen.reset();
}

void EditorSweep::save(const fs::path& folder) const {
    if (!shown_) throw Error("there is no sweep to save");
    require_sweep_folder(folder);
    const SweepState state = read_journal(shown_->folder);
    std::error_code error;
    if (!fs::equivalent(folder, shown_->folder, error)) {
        require_no_other_sweep(folder, state);
        make_folders(folder);
        // A failed copy leaves the files of an earlier save.
        const TemporaryFolder copy(folder / ".sweep.XXXXXX");
        if (copy.path().empty())
            throw Error(fmt::format("{}: cannot be written: {}; choose another folder", folder.string(), errno_text()));
        fs::copy_file(shown_->folder / kJournalFile, copy.path() / kJournalFile);
        copy_pictures(shown_->folder, copy.path());
        if (has_journal(folder)) remove_sweep_files(folder);
        make_picture_folder(folder);
        for (const fs::path& file : sweep_files(copy.path()))
            if (fs::exists(file)) fs::rename(file, folder / file.lexically_relative(copy.path()));
    }
    write_sweep_files(folder, state, shown_->plan);
}

void EditorSweep::fetch_results() {
    MeasuringThread::Status status = thread_->status();
    seen_ = status.version;
    fresh_ = true;
    if (mark_) {
        if (!status.measuring) {
            const MeasuringThread::Picture of = *std::exchange(mark_, std::nullopt);
            if (status.measure_problem.empty() && status.measured)
                note_finished(marks_, {of, *status.measured});
            else
                refused_.push_back(of);
        }
    } else if (!measures_mark_) {
        // The numbers of the settings before stay until the present ones have some.
        if (status.measured || !status.measure_problem.empty()) present_ = status.measured;
        facts_.measuring_present = status.measuring;
        facts_.present_problem = status.measure_problem;
        facts_.present_is_old = status.measuring && present_ && present_->time;  // times are measured last
        if (!status.measuring && status.measure_problem.empty() && status.measured && followed_)
            note_finished(finished_, {*followed_, *status.measured});
    }
    if (opened_ && status.sweep == seen_sweep_) return;  // another sweep is shown
    opened_ = false;
    seen_sweep_ = status.sweep;
    if (status.results) results_ = std::move(status.results);
    if (!status.sweeping) drop_empty();
    facts_.running = status.sweeping;
    facts_.timing = status.progress.timing;
    facts_.problem = status.sweep_problem;
    facts_.seconds_left = status.progress.seconds_left;
    const SweepTiming timing;
    const double part = status.progress.total ? double(status.progress.done) / double(status.progress.total) : 0;
    facts_.progress = status.progress.timing ? (status.progress.round + part) / timing.rounds : part;
    facts_.current = status.sweeping ? progress_text(status.progress, timing) : "";
}

void EditorSweep::note_finished(std::vector<Finished>& list, const Finished& finished) {
    std::erase_if(list, [&](const Finished& f) { return f.of.settings == finished.of.settings; });
    if (list.size() == kMaxFinished) list.erase(list.begin());
    list.push_back(finished);
}

EditorSweep::Earlier EditorSweep::earlier(const EditorState& state) const {
    if (!followed_) return {};
    if (state.pinned)
        if (const Finished* pinned = finished(present_picture_under(state.pinned->settings))) return {pinned, true};
    Earlier found;
    for (const Finished& f : finished_)
        if (differ_in_shadows_only(f.of, *followed_)) found.is = &f;
    return found;
}

void EditorSweep::compare_settings(const EditorState& state) {
    facts_.other_scene = shown_ && shown_->spec.scene != state.scene_name;
    facts_.other_settings.clear();
    if (!shown_) return;
    Settings present = state.settings;
    present.truth.area = shown_->spec.area;  // measure_present() compares with the sweep's kind of reference
    const Settings swept = comparable(shown_->spec.base), now = comparable(present);
    for (const SettingRef& ref : differing_settings(swept, now)) {
        const std::string key = setting_key(ref);
        const auto& axes = shown_->spec.axes;
        if (std::ranges::find(axes, key, &SweepAxis::key) == axes.end())
            facts_.other_settings.push_back(std::string(ref.param->label) + ": " + change_text(swept, now, ref));
    }
}

bool EditorSweep::update(const EditorState& state) {
    if (has_news()) fetch_results();
    const bool axes_moved = seen_cost_ != state.sweep.cost || seen_error_ != state.sweep.error;
    const bool settings_moved = compared_ != state.settings || compared_scene_ != state.scene_name;
    fresh_ |= std::exchange(seen_pinned_, state.pinned) != state.pinned;
    fresh_ |= std::exchange(seen_timed_, state.sweep.timed) != state.sweep.timed;
    fresh_ |= std::exchange(seen_engine_, state.engine_panel.profile) != state.engine_panel.profile;
    fresh_ |= std::exchange(seen_angle_deg_, state.engine_panel.angle_deg) != state.engine_panel.angle_deg;
    if (!fresh_ && !axes_moved && !settings_moved) return false;
    if (fresh_ || settings_moved) {
        compare_settings(state);
        compared_ = state.settings;
        compared_scene_ = state.scene_name;
    }
    if (fresh_) {
        marks_are_known_ = false;
        facts_.cases.clear();
        facts_.columns = measured_columns(results_ && results_->rounds > 0 ? results_->cost
                                          : shown_                         ? swept_cost_
                                                                           : state.sweep.timed);
        facts_.failed = 0;
        facts_.total = shown_ ? shown_->plan.cases.size() : 0;
        facts_.about.clear();
        if (results_) {
            for (const SweepRow& row : results_->rows) facts_.cases.push_back(measured_case(row));
            facts_.failed = results_->failed;
            facts_.software = results_->software;
            const SweepSpec& spec = shown_->spec;
            facts_.about = fmt::format("{}, {} x {} pixels, {} reference; {}", spec.scene, spec.width, spec.height,
                                       spec.area ? "area" : "hard", results_->renderer);
        }
        facts_.present.reset();
        if (present_ && followed_) facts_.present = measured_case(*present_);
    }
    const Earlier before = earlier(state);
    facts_.before.reset();
    facts_.change.clear();
    facts_.before_is_pinned = before.pinned;
    if (before.is) {
        const Settings was = comparable(before.is->of.settings), is = comparable(followed_->settings);
        const std::vector<SettingRef> changes = differing_settings(was, is);
        facts_.before = measured_case(before.is->numbers);
        facts_.change = changes.size() > 1
                            ? fmt::format("{} settings", changes.size())
                            : std::string(changes[0].param->label) + ": " + change_text(was, is, changes[0]);
    }
    facts_.cost = shown_cost(facts_, state.sweep.cost);
    facts_.view =
        frontier_view(results_ ? results_->rows : std::vector<SweepRow>{}, present_ && followed_ ? &*present_ : nullptr,
                      facts_.cost, state.sweep.error, before.is ? &before.is->numbers : nullptr);
    if (results_) add_base(facts_.view.plot, *results_, facts_.cost);
    for (PlotSpot& spot : facts_.view.plot.spots)
        if (spot.kind == PlotSpot::Kind::Pinned && before.pinned) spot.label = "A";
    facts_.engine.reset();
    const bool has_engine = state.engine_panel.profile && state.engine_panel.profile == engine_.profile && engine_.are;
    if (const Finished* engine = has_engine ? finished(present_picture_under(*engine_.are)) : nullptr) {
        facts_.engine = measured_case(engine->numbers);
        if (facts_.view.present)
            add_spot(facts_.view.plot, PlotSpot::Kind::Engine, std::string(engine_.profile->title), engine->numbers,
                     facts_.cost, state.sweep.error);
    }
    seen_cost_ = state.sweep.cost;
    seen_error_ = state.sweep.error;
    fresh_ = false;
    return true;
}

}  // namespace si
