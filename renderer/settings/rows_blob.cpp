// Rows of blobs: blob.*.
#include "renderer/settings/rows.h"

namespace si {
namespace {

using namespace rows;

constexpr auto kBlobRows = std::to_array<Param>({
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
});
static_assert(kBlobRows.size() == member_count<BlobSettings>(), "a member of BlobSettings has no row");

}  // namespace

std::span<const Param> blob_rows() {
    return kBlobRows;
}

}  // namespace si
