#include "renderer/view/fits/shadowed.h"

namespace si {

std::optional<MapRegion> fit_casters(const FitInput& in) {
    std::vector<ViewExtent> receivers(in.shape.boxes.size());
    for (std::size_t i = 0; i < receivers.size(); ++i)
        if (in.receives(i)) receivers[i] = lit_extent(in, i);
    return shadowed_region(in, receivers);
}

}  // namespace si
