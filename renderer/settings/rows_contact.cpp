// Rows of contact shadows: contact.*.
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

constexpr auto kContactRows = std::to_array<Param>({
    {SI_FIELD(contact.steps), .label = "Steps", .unit = "steps", .min = 1, .max = 256, .logarithmic = true,
     SI_IDLE(no_light_has_contacts(s), kNone),
     .help = "Number of samples along the ray. Thin casters between samples are missed. Each pixel starts at its own "
             "offset, which turns this into noise.",
     .also = "samples, ray steps", .read_by = ReadBy::Visibility},
    {SI_FIELD(contact.thickness), .label = "Thickness", .unit = "m", .min = 1e-4, .max = 1e4, .logarithmic = true,
     SI_IDLE(no_light_has_contacts(s), kNone),
     .help = "Assumed thickness of visible surfaces: a ray at most this far behind one is blocked. The picture does "
             "not hold thickness. Too little lets light through, and too much shadows free surfaces behind an edge.",
     .also = "depth bias, ray thickness", .read_by = ReadBy::Visibility},
});
static_assert(kContactRows.size() == member_count<ContactSettings>(), "a member of ContactSettings has no row");

}  // namespace

std::span<const Param> contact_rows() {
    return kContactRows;
}

}  // namespace si
