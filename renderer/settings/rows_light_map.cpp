// Rows of light maps: light_map.*.
#include "renderer/settings/rows.h"

namespace si {
namespace {

using namespace rows;

constexpr auto kLightMapRows = std::to_array<Param>({
    {SI_FIELD(light_map.resolution), .label = "Resolution", .unit = "texels", .min = 16, .max = 16384,
     .logarithmic = true, .cost = Cost::Target,
     .help =
         "Side of the square that holds all surfaces of the scene, a byte a texel and light. All surfaces have the "
         "same texels per metre: as many as fit, as the pass reports. An edge of a shadow is off by up to 0.7 texels."},
    {SI_FIELD(light_map.samples), .label = "Rays per texel", .min = 1, .max = 1 << 20, .logarithmic = true,
     .cost = Cost::Target,
     .help = "Maximum rays of a texel, over the light's area (light.size): 64 everywhere, then four times as many, and "
             "again, where noise requires it. A single ray goes to the light's middle, and the shadow is hard."},
});
static_assert(kLightMapRows.size() == member_count<LightMapSettings>(), "a member of LightMapSettings has no row");

}  // namespace

std::span<const Param> light_map_rows() {
    return kLightMapRows;
}

}  // namespace si
