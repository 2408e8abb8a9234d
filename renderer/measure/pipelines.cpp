#include "renderer/measure/pipelines.h"

#include <fmt/format.h>

#include "renderer/base/error.h"

namespace si {

std::vector<PipelineError> compare_pipelines(Renderer& renderer, const Scene& scene, const Settings& settings,
                                             int width, int height) {
    FrameRequest request{.width = width, .height = height};
    request.outputs = {.colour = false, .visibility = true, .precision = true};
    std::vector<PipelineError> out;
    FloatImage best;
    for (const MapOrigin origin : {MapOrigin::Near, MapOrigin::World})
        for (const MapTransform transform : {MapTransform::World, MapTransform::Eye}) {
            Settings s = settings;
            s.map.origin = int(origin);
            s.map.transform = int(transform);
            const FrameResult frame = renderer.render(scene, s, request);
            if (!frame.precision)
                throw Error(
                    fmt::format("light {} has no shadow map to look anything up in: choose another by view.light",
                                settings.view.light));
            FloatImage visibility = renderer.read_float(frame.visibility, 1);
            PipelineError e{origin, transform, frame.precision->pixels, frame.precision->texels, frame.precision->ulps};
            if (best.data.empty()) best = visibility;
            for (std::size_t i = 0; i < visibility.data.size(); ++i)
                e.flips += (visibility.data[i] < 0.5f) != (best.data[i] < 0.5f);
            out.push_back(e);
        }
    return out;
}

}  // namespace si
