#include "app/sweep/running_sweep.h"

#include <algorithm>

#include "app/base/output.h"
#include "app/report/picture_comparison.h"
#include "renderer/settings/param.h"

namespace si {
namespace {

/// Returns keys and values of the settings in which a prepared case differs from the plan's case.
std::vector<std::pair<std::string, std::string>> own_settings(const SweepCase& c, const Settings& prepared) {
    const Settings measured = measured_settings(prepared);
    std::vector<std::pair<std::string, std::string>> own;
    for (const SettingRef& ref : differing_settings(c.settings, measured))
        own.emplace_back(setting_key(ref), value_text(*ref.param, get_value(measured, ref)));
    return own;
}

}  // namespace

RunInfo RenderedCases::run() {
    RunInfo run = this_run();
    run.renderer = driver_.renderer;
    run.version = driver_.version;
    run.clock = driver_.clock;
    run.software = driver_.software;
    return run;
}

DrawnCase RenderedCases::facts(const SweepCase& c) {
    DrawnCase facts;
    CaseSessions::Prepared prepared = sessions_.prepare(c.sets());
    const Classification classified = measurer_.classify(prepared.scene, prepared.settings);
    facts.own_settings = own_settings(c, prepared.settings);
    facts.notes = std::move(prepared.notes);
    facts.error = {classified.error, classified.reference->noise};
    if (classified.reference->noise_unknown > 0)
        facts.notes.push_back("the reference: " + noise_text(*classified.reference));
    facts.cost = classified.cost;
    if (classified.map_resolution < prepared.settings.map.resolution) facts.map_resolution = classified.map_resolution;
    facts.notes.insert(facts.notes.end(), classified.notes.begin(), classified.notes.end());
    facts.picture_jpg = jpg_bytes(shrunk(classified.picture, kThumbnailWidth));
    facts.artefacts_png = png_bytes(shrunk(classified.artefacts, kArtefactsWidth));
    return facts;
}

CaseTimes RenderedCases::time(const SweepCase& c, int frames, CostCase cost, ShadowFrames which) {
    const CaseSessions::Prepared prepared = sessions_.prepare(c.sets());
    CaseTimes times;
    const int pairs = which == ShadowFrames::All ? std::max(frames, kLeastFrames) : frames;
    times.shadow = time_shadow(measurer_, prepared.scene, prepared.settings, pairs, cost, &times.frames, {}, which);
    return times;
}

RunningSweep::RunningSweep(Inputs inputs, Renderer& renderer, const Workers& workers)
    : inputs_(std::move(inputs)),
      measurer_(renderer, inputs_.spec.width, inputs_.spec.height, workers),
      cases_(measurer_, renderer.driver(), inputs_.sessions),
      journal_(inputs_.folder, spec_json(inputs_.spec), plan_key(inputs_.plan)),
      runner_(inputs_.plan, inputs_.spec.shard, inputs_.timing, inputs_.retry, cases_, journal_, inputs_.folder) {}

}  // namespace si
