#include "app/sweep/rendered_cases.h"

#include "app/measure_json.h"
#include "app/output.h"
#include "app/sweep/pictures.h"
#include "renderer/param.h"

namespace si {

RunInfo RenderedCases::run() {
    RunInfo run = this_run();
    run.renderer = driver_.renderer, run.version = driver_.version;
    run.clock = driver_.clock, run.software = driver_.software;
    return run;
}

Settings RenderedCases::prepared(const SweepCase& c, std::vector<std::string>* notes) {
    Settings settings = c.settings;
    std::vector<std::string> repairs = sanitise(settings);
    if (!(settings.scene == posed_)) {
        const std::string remark = pose_scene(session_.scene, settings.scene);
        posed_ = settings.scene;
        if (!remark.empty()) repairs.push_back(remark);
    }
    if (notes) *notes = std::move(repairs);
    return settings;
}

CaseFacts RenderedCases::facts(const SweepCase& c) {
    CaseFacts facts;
    const Settings settings = prepared(c, &facts.notes);
    const Judgement judged = measurer_.judge(session_.scene, settings);
    facts.error = error_json(judged.error);
    facts.error["noise"] = judged.truth->noise;
    if (judged.truth->noise_unknown > 0) facts.notes.push_back("the truth: " + noise_text(*judged.truth));
    facts.cost = cost_json(judged.cost);
    facts.notes.insert(facts.notes.end(), judged.notes.begin(), judged.notes.end());
    facts.picture_jpg = jpg_bytes(shrunk(judged.picture, kThumbnailWidth));
    facts.artefacts_png = png_bytes(shrunk(judged.artefacts, kArtefactsWidth));
    return facts;
}

TimeSamples RenderedCases::time(const SweepCase& c, int frames) {
    const Settings settings = prepared(c);
    return measurer_.time(session_.scene, settings, frames);
}

}  // namespace si
