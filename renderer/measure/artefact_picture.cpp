#include "renderer/measure/artefact_picture.h"

#include <algorithm>

namespace si {
namespace {

// Okabe and Ito, Color Universal Design, 2008; grey for what is no error by itself.
constexpr auto kStyles = std::to_array<ArtefactStyle>({
    {Artefact::Acne, "acne", "acne", {213, 94, 0}},
    {Artefact::PeterPanning, "peter_panning", "peter-panning", {86, 180, 233}},
    {Artefact::Leak, "leak", "leak", {0, 114, 178}},
    {Artefact::EdgeAliasing, "edge_aliasing", "edge aliasing", {240, 228, 66}},
    {Artefact::OutsideMap, "outside_map", "outside the map", {130, 130, 140}},
    {Artefact::LostCaster, "lost_caster", "lost caster", {204, 121, 167}},
});
static_assert(kStyles.size() == kArtefacts - 1);

}  // namespace

std::span<const ArtefactStyle> artefact_styles() {
    return kStyles;
}

ByteImage artefact_picture(const ByteImage& picture, const std::vector<Artefact>& artefacts) {
    ByteImage out = picture;
    for (std::size_t i = 0; i < std::min(artefacts.size(), out.data.size() / 4); ++i) {
        std::uint8_t* p = &out.data[4 * i];
        // Rec. 709 weights on encoded values: a backdrop, not a measurement. Lifted, so that colours stand out on it.
        const double grey = 40 + 0.7 * (0.2126 * p[0] + 0.7152 * p[1] + 0.0722 * p[2]);
        std::fill_n(p, 3, std::uint8_t(grey));
        const Artefact artefact = artefacts[i];
        if (artefact != Artefact::None) std::copy_n(kStyles[std::size_t(artefact) - 1].rgb.begin(), 3, p);
        p[3] = 255;
    }
    return out;
}

}  // namespace si
