// Rows of shadows that no map holds: volumes.*, contact.*, blob.*, light_map.*.
#include <algorithm>

#include "renderer/settings/rows.h"

namespace si {
namespace {

using namespace rows;

bool no_light_has_contacts(const Settings& s) {
    const auto lights = std::span(s.lights).first(std::size_t(std::clamp(s.light_count, 0, kMaxLights)));
    return std::ranges::none_of(lights, [](const LightSettings& light) { return light.cast && light.contact > 0; });
}

constexpr std::string_view kNone = "without effect: no light has contact shadows (light.contact)";

constexpr auto kSourceParams = std::to_array<Param>({
    {SI_FIELD(volumes.allow_large), .label = "Draw large volumes",
     .help = "Draws shadow volumes even if more than 20000 triangles of casters belong to no closed surface. Each of "
             "these triangles adds faces of its own, and a picture may take minutes. Off: in such a scene the light "
             "has no shadow. A note then gives the number of triangles and how often their faces would cover the "
             "picture."},
    {SI_FIELD(contact.steps), .label = "Steps", .unit = "steps", .min = 1, .max = 256, .logarithmic = true,
     SI_IDLE(no_light_has_contacts(s), kNone),
     .help = "Number of samples along the ray. Thin casters between samples are missed. Each pixel starts at its own "
             "offset, which turns this into noise.",
     .also = "samples, ray steps", .read_by = ReadBy::Visibility},
    {SI_FIELD(contact.thickness), .label = "Thickness", .unit = "m", .min = 1e-4, .max = 1e4, .logarithmic = true,
     SI_IDLE(no_light_has_contacts(s), kNone),
     .help = "Assumed thickness of visible surfaces, which the depth buffer does not hold. A ray at most this far "
             "behind a surface is blocked. Too small a thickness lets light through. Too large a thickness puts "
             "surfaces behind an edge in shadow, although nothing blocks their light.",
     .also = "depth bias, ray thickness", .read_by = ReadBy::Visibility},
    {SI_FIELD(blob.size), .label = "Size", .unit = "x caster", .min = 0.1, .max = 4,
     .help = "Radius of the disc against half the caster's width across the light.", .read_by = ReadBy::Blobs},
    {SI_FIELD(blob.softness), .label = "Softness", .min = 0, .max = 1,
     .help = "Share of the radius over which the disc fades at its rim: 0 is a hard edge, 1 fades from the middle on.",
     .read_by = ReadBy::Blobs},
    {SI_FIELD(blob.opacity), .label = "Opacity", .min = 0, .max = 1,
     .help = "Share of light that the middle of the disc removes.", .read_by = ReadBy::Blobs},
    {SI_FIELD(blob.reach), .label = "Reach", .unit = "radii", .min = 0, .max = 1000, .logarithmic = true,
     .help = "Distance below the caster's middle at which the disc has faded away, in radii of the disc; with 0 it "
             "does not fade and reaches everything below.",
     .read_by = ReadBy::Blobs},
    {SI_FIELD(light_map.resolution), .label = "Resolution", .unit = "texels", .min = 16, .max = 16384,
     .logarithmic = true, .cost = Cost::Target,
     .help = "Side of the square texture that holds all surfaces of the scene, with one byte for each texel and light. "
             "All surfaces have the same number of texels per metre: as many as fit. The pass reports this number. A "
             "shadow edge is off by up to 0.7 texels."},
    {SI_FIELD(light_map.samples), .label = "Rays per texel", .min = 1, .max = 1 << 20, .logarithmic = true,
     .cost = Cost::Target,
     .help = "Maximum number of rays from a texel to points of the light (light.size). Every texel gets 8 rays, "
             "texels around penumbrae get 64, and noise may require more. With the value 1, the ray goes to the "
             "light's middle, and the shadow is hard."},
});
static_assert(kSourceParams.size() == member_count<VolumeSettings>() + member_count<ContactSettings>() +
                                          member_count<BlobSettings>() + member_count<LightMapSettings>(),
              "a member of these settings has no row");

}  // namespace

std::vector<Param> source_rows() {
    return joined(kSourceParams);
}

}  // namespace si
