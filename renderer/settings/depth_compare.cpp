// Decision between shadow sampler and comparison in the shader.
#include "renderer/settings/depth_compare.h"

#include "renderer/settings/biases.h"
#include "renderer/settings/map_storage.h"
#include "renderer/settings/paging.h"

namespace si {

bool compares_per_texel(const Settings& settings) {
    return bias_of(settings).per_texel && filter_of(settings).samples() == Samples::Depth;
}

bool uses_sampler(const Settings& settings) {
    if (draws_pages(settings) || settings.filter.method != FilterMethod::Sampler || is_colour(settings.map.format))
        return false;
    return !(compares_per_texel(settings) && is_bilinear(filter_of(settings), settings));
}

FilterCost kernel_cost(const Settings& settings) {
    const Filter& row = filter_of(settings);
    FilterCost cost = row.cost(row, settings);
    if (cost.gathers > 0 && !uses_sampler(settings)) cost.texels = 4 * cost.gathers;
    return cost;
}

}  // namespace si
