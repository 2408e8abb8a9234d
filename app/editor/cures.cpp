#include "app/editor/cures.h"

#include "app/context/headless_context.h"
#include "renderer/measure/axes.h"
#include "renderer/reference/truth.h"

namespace si {

void EditorCures::start(const Scene& scene, const Settings& settings, int width, int height,
                        std::optional<glm::ivec2> pixel, std::vector<CureIdea> own) {
    found_.reset();
    CureOptions options{.pixel = pixel, .time = true, .more = std::move(own)};
    if (!pixel) options.truth = truth_options(settings);  // a dossier speaks of a light without size
    job_.start({"the present settings", 0}, [copy = std::make_shared<const Scene>(scene), settings, width, height,
                                             options](const Workers& workers, const auto& report) {
        CureOutcome out{.table = {},
                        .problem = {},
                        .scene = copy->id,
                        .settings = settings,
                        .width = width,
                        .height = height,
                        .pixel = options.pixel};
        try {
            const HeadlessContext context;
            Renderer renderer;
            TruthCache cache;
            out.table = find_cures(renderer, *copy, settings, width, height, options, cache, workers,
                                   [&](double share, const std::string& what) {
                                       report({what, share});
                                   });
        } catch (const Cancelled&) {
            out.problem = "The search for cures was cancelled";
        } catch (const std::exception& e) {
            out.problem = e.what();
        }
        return out;
    });
}

bool EditorCures::poll(std::string& problem) {
    auto outcome = job_.end();
    if (!outcome) return false;
    problem = outcome->problem;
    if (problem.empty()) found_ = std::move(outcome);
    return true;
}

CureSearch EditorCures::facts(const Scene& scene, const Settings& settings, int width, int height) const {
    CureSearch f;
    f.running = job_.facts();
    if (!found_ || found_->scene != scene.id) return f;
    f.table = &found_->table;
    f.pixel = found_->pixel;
    f.current = found_->width == width && found_->height == height &&
                measured_settings(found_->settings) == measured_settings(settings);
    return f;
}

}  // namespace si
