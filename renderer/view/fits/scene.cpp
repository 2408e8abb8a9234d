#include "renderer/view/fits/region.h"

namespace si {

std::optional<MapRegion> fit_scene(const FitInput&) {
    return std::nullopt;
}

}  // namespace si
