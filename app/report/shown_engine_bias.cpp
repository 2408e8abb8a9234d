#include "app/report/shown_engine_bias.h"

#include <cstddef>

#include "renderer/bundle/given_maps.h"

namespace si {

EngineBias shown_engine_bias(const Settings& settings, std::span<const FittedLight> lights) {
    const int light = settings.view.light_index();
    const bool imported =
        std::size_t(light) < lights.size() && lights[std::size_t(light)].provider == MapProvider::Imported;
    return imported ? engine_bias_of_light(settings, light) : EngineBias::Own;
}

}  // namespace si
