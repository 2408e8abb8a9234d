#include "app/editor/fixes.h"

#include "app/context/headless_context.h"
#include "renderer/measure/axes.h"
#include "renderer/reference/reference.h"

namespace si {

void EditorFixes::start(const Scene& scene, const Settings& settings, int width, int height,
                        std::optional<glm::ivec2> pixel, std::vector<FixCandidate> own) {
    found_.reset();
    FixOptions options{.pixel = pixel, .time = true, .more = std::move(own)};
    if (!pixel) options.reference = reference_options(settings);  // a pixel diagnosis uses a light without size
    about_ = {.table = {},
              .problem = {},
              .scene = scene.id,
              .settings = settings,
              .width = width,
              .height = height,
              .pixel = options.pixel};
    job_.start(
        [copy = std::make_shared<const Scene>(scene), about = about_, options](const Workers& workers,
                                                                               const auto& report) {
            FixesFound out = about;
            const HeadlessContext context;
            Renderer renderer;
            ReferenceCache cache;
            out.table = find_fixes(renderer, *copy, out.settings, out.width, out.height, options, cache, workers,
                                   [&](double share, const std::string& what) {
                                       report({what, share});
                                   });
            return out;
        },
        {"the present settings", 0});
}

FixSearch EditorFixes::facts(std::uint64_t scene, const Settings& settings, int width, int height) const {
    FixSearch f;
    f.running = job_.progress();
    if (!found_ || found_->scene != scene) return f;
    f.table = &found_->table;
    f.pixel = found_->pixel;
    f.current = found_->width == width && found_->height == height &&
                measured_settings(found_->settings) == measured_settings(settings);
    return f;
}

}  // namespace si
