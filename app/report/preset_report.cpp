#include "app/report/preset_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "app/report/diagnosed_lights.h"
#include "app/report/picture_comparison.h"
#include "app/report/section_svg.h"
#include "renderer/advise/fixes.h"
#include "renderer/inspect/section.h"
#include "renderer/measure/artefact_clusters.h"
#include "renderer/measure/axes.h"
#include "renderer/reference/artefact_picture.h"
#include "renderer/reference/ray_scenes.h"
#include "renderer/render/reference_frames.h"
#include "renderer/scene/scene.h"
#include "renderer/settings/param.h"

namespace si {
namespace {

/// Returns the pixels to diagnose: the marked ones, else the middle of each cause's largest cluster.
std::vector<ReportedPixel> pixels_to_diagnose(const Classification& classified, const PresetReportOptions& options) {
    std::vector<ReportedPixel> out;
    for (const glm::ivec2& pixel : options.pixels) out.push_back({.pixel = pixel, .marked = true});
    if (!out.empty()) return out;
    const Reference& reference = *classified.reference;
    for (const ArtefactStyle& style : artefact_styles())
        for (const ArtefactCluster& c : artefact_clusters(classified.classified, reference.width, style.artefact, 1))
            out.push_back({.pixel = c.pixel * reference.step, .wrong = c.pixels, .cause = std::string(style.label)});
    return out;
}

std::string cause_label(Artefact cause) {
    const auto row = std::ranges::find(artefact_styles(), cause, &ArtefactStyle::artefact);
    return row == artefact_styles().end() ? std::string() : std::string(row->label);
}

/// Diagnoses pixels of one frame under view.light.
class PixelReporter {
public:
    PixelReporter(Renderer& renderer, const Scene& scene, const Settings& settings, glm::ivec2 size,
                  const Workers& workers)
        : renderer_(renderer),
          scene_(scene),
          settings_(measured_settings(settings)),
          request_{.width = size.x, .height = size.y},
          meter_(renderer_trial_meter({renderer, scene, size.x, size.y, cache_, workers},
                                      {.work = false, .reference = ReferenceOptions()})) {
        // The time of a suggested change does not matter here.
        meter_.time = [](const Settings&, const Settings&) { return CostChange{}; };
        meter_.time_to_limit = nullptr;
        trace_sources(renderer, scene, settings_, request_, cache_, workers);
        casters_ = ray_scenes().get(ray_scenes().geometry(scene, settings_), workers);
    }

    void diagnose(ReportedPixel& reported) {
        const Probe probe = renderer_.probe(scene_, settings_, request_, reported.pixel.x, reported.pixel.y);
        if (!probe.hit) {
            reported.verdict = "The pixel shows no surface.";
            return;
        }
        reported.object = probe.object.empty() ? "(unnamed)" : probe.object;
        const auto light = std::size_t(std::max(settings_.view.light, 0));
        if (light >= probe.lights.size()) {
            reported.verdict = fmt::format("There is no light {} (view.light).", settings_.view.light);
            return;
        }
        const std::vector<PixelDiagnosis> found =
            diagnose_lights(probe, scene_, settings_, renderer_.driver(), *casters_);
        const PixelDiagnosis& d = found[light];
        reported.cause = cause_label(d.cause().artefact);
        reported.verdict = d.verdict;
        if (d.fix) reported.fix = drawn_fix(*d.fix, reported.pixel);
        reported.section = section_svg(pixel_section(probe, light, found, settings_, casters_.get()));
    }

private:
    Renderer& renderer_;
    const Scene& scene_;
    Settings settings_;
    FrameRequest request_;
    ReferenceCache cache_;
    TrialMeter meter_;
    std::shared_ptr<const ReferenceScene> casters_;
    std::optional<MeasuredSettings> before_;  ///< of the settings without a change, once a change is drawn

    /// Draws the picture with a suggested change. Returns a sentence on what the change does to the pixel and the
    /// picture.
    std::string drawn_fix(const SuggestedFix& fix, glm::ivec2 pixel) {
        if (!before_) before_ = meter_.measure(settings_, settings_.view.light);
        Candidate candidate = suggested_candidate(fix, settings_);
        candidate.light = settings_.view.light;
        const FixTable table = search_fixes(settings_, *before_, {std::move(candidate)}, meter_, {.pixel = pixel});
        const Trial& trial = table.rows.front();
        if (!trial.is_drawn()) return fmt::format("No fix: {}: {}.", fix.text, trial.candidate.untried);
        if (!trial.pixel->right) return fmt::format("No fix: {}: {}.", fix.text, trial.why_not);
        std::string effect = fix.text + ". Drawn so, this pixel is right";
        if (const std::size_t wrong = wrong_pixels(trial.metrics); wrong < table.wrong)
            effect += fmt::format(", and {} pixels are wrong in place of {}", wrong, table.wrong);
        return table.fix() ? fmt::format("Fix: {}.", effect)
                           : fmt::format("A change with a side effect: {}. But {}.", effect, trial.why_not);
    }
};

/// Times all subjects and the base of costs in turns.
/// @param step receives the share done, 0..1, an upper bound of the work
void time_subjects(Measurer& measurer, Scene& scene, PresetReport& report, const std::stop_token& stop,
                   const std::function<void(double)>& step) {
    std::vector<Settings> timed;
    for (const ReportSubject& subject : report.subjects) timed.push_back(subject.settings);
    timed.push_back(timed.front());
    set_settings(timed.back(), base_of_costs());
    constexpr double kUsualTurns = 4;
    double bursts = 0;
    const std::vector<TurnTimes> times = time_in_turns(timed.size(), [&](std::size_t i, TurnTimes& to) {
        step(std::min(bursts++ / (kUsualTurns * double(timed.size())), 0.99));
        hide_objects(scene, hidden_paths(timed[i]));
        to.shadow.add(time_shadow(measurer, scene, timed[i], kBurstPairs, report.cost, &to.frames, stop));
    });
    report.base = summarise_shadow(times.back().shadow);
    for (std::size_t i = 0; i < report.cases.size(); ++i) {
        report.cases[i].time = summarise_times(times[i].frames);
        report.cases[i].shadow = summarise_shadow(times[i].shadow);
        report.cases[i].shadow.of_base = time_ratio(report.cases[i].shadow.moving_ms, report.base->moving_ms);
    }
    report.clock = times.front().frames.clock;
}

}  // namespace

ReportSubject preset_subject(const Scene& scene, const Settings& shown, const SessionOptions& options,
                             std::vector<std::string>& notes) {
    const SessionPlan plan = plan_session(options);
    const ComposedSettings own = compose_settings(plan, scene, plan.settings.scene);
    ReportSubject out{.name = options.preset,
                      .title = plan.preset->title,
                      .settings = settings_with_shadows_of(shown, own.settings),
                      .options = {"--preset", options.preset}};
    notes.insert(notes.end(), own.notes.begin(), own.notes.end());
    for (const std::string& set : options.sets) {
        out.options.emplace_back("--set");
        out.options.push_back(set);
    }
    for (const SettingRef& ref : differing_settings(own.settings, out.settings)) {
        out.options.emplace_back("--set");
        out.options.push_back(setting_key(ref) + "=" + value_text(*ref.param, get_value(out.settings, ref)));
    }
    return out;
}

PresetReport measure_report(Renderer& renderer, Scene scene, const std::string& scene_name,
                            std::vector<ReportSubject> subjects, glm::ivec2 size, const PresetReportOptions& options,
                            const Workers& workers, const std::function<void(double, const std::string&)>& progress) {
    PresetReport report{
        .scene = scene_name, .command = {}, .version = {}, .width = size.x, .height = size.y, .cost = options.cost};
    report.renderer = renderer.driver().renderer;
    report.subjects = std::move(subjects);
    Measurer measurer(renderer, size.x, size.y, workers);
    const double count = double(report.subjects.size()), measured = options.time ? 0.5 : 1;
    for (const ReportSubject& subject : report.subjects) {
        const auto step = [&](double share, const char* what) {
            if (workers.stop.stop_requested()) throw Cancelled();
            progress(measured * (double(report.cases.size()) + share) / count,
                     fmt::format("{}: {}", subject.name, what));
        };
        hide_objects(scene, hidden_paths(subject.settings));
        ReportedCase reported;
        step(0, "error");
        reported.classified = measurer.classify(scene, subject.settings);
        reported.pixels = pixels_to_diagnose(reported.classified, options);
        if (!reported.pixels.empty()) {
            PixelReporter reporter(renderer, scene, subject.settings, size, workers);
            for (ReportedPixel& pixel : reported.pixels) {
                step(0.7 + 0.3 * double(&pixel - reported.pixels.data()) / double(reported.pixels.size()), "pixels");
                reporter.diagnose(pixel);
            }
        }
        report.cases.push_back(std::move(reported));
    }
    if (options.time)
        time_subjects(measurer, scene, report, workers.stop,
                      [&](double share) { progress(measured + (1 - measured) * share, "times, in turns"); });
    return report;
}

}  // namespace si
