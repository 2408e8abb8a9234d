// Rows of shadow volumes: volumes.*.
#include "renderer/settings/rows.h"

namespace si {
namespace {

using namespace rows;

constexpr auto kVolumeRows = std::to_array<Param>({
    {SI_FIELD(volumes.allow_large), .label = "Draw large volumes",
     .help = "Draws shadow volumes also where more than 20000 triangles of casters are not of closed surfaces: each "
             "then adds faces of its own, and a picture may take minutes. Off: the light has no shadow then, and a "
             "note says how many triangles it would take and how often they would cover the picture."},
});
static_assert(kVolumeRows.size() == member_count<VolumeSettings>(), "a member of VolumeSettings has no row");

}  // namespace

std::span<const Param> volume_rows() {
    return kVolumeRows;
}

}  // namespace si
