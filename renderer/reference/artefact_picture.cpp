#include "renderer/reference/artefact_picture.h"

#include <algorithm>

namespace si {
namespace {

// Colours: Okabe and Ito, Color Universal Design, 2008. Those of the normal offset are lighter tints.
constexpr auto kStyles = std::to_array<ArtefactStyle>({
    {Artefact::Acne, "acne", "acne", {213, 94, 0}},
    {Artefact::PeterPanning, "peter_panning", "peter-panning", {86, 180, 233}},
    {Artefact::Leak, "leak", "leak", {0, 114, 178}},
    {Artefact::EdgeAliasing, "edge_aliasing", "edge aliasing", {240, 228, 66}},
    {Artefact::OutsideMap, "outside_map", "outside the map", {0, 158, 115}},
    {Artefact::LostCaster, "lost_caster", "lost caster", {204, 121, 167}},
    {Artefact::PeterPanningOffset, "peter_panning_offset", "peter-panning (normal offset)", {130, 226, 255}},
    {Artefact::OffsetShadow, "offset_shadow", "false shadow (normal offset)", {255, 158, 92}},
    {Artefact::Filter, "filter", "kernel too wide", {230, 159, 0}},
    {Artefact::Undersampled, "undersampled", "caster thinner than a texel", {255, 255, 255}},
    {Artefact::Penumbra, "penumbra", "penumbra", {150, 120, 200}},
    {Artefact::NoMap, "no_map", "other source", {255, 105, 180}},
    {Artefact::PeterPanningRaster, "peter_panning_raster", "peter-panning (polygon offset)", {40, 90, 225}},
    {Artefact::Contact, "contact", "contact shadow", {128, 64, 0}},
    {Artefact::LightBleeding, "light_bleeding", "light bleeding", {0, 45, 95}},
});
static_assert(kStyles.size() == kArtefacts - 1);

}  // namespace

std::span<const ArtefactStyle> artefact_styles() {
    return kStyles;
}

ByteImage artefact_picture(const ByteImage& picture, const std::vector<ClassifiedPixel>& classified, int step) {
    ByteImage out = picture;
    const auto width = std::size_t(out.width), every = std::size_t(std::max(step, 1));
    const std::size_t columns = (width + every - 1) / every;
    for (std::size_t i = 0; i < out.data.size() / 4; ++i) {
        std::uint8_t* p = &out.data[4 * i];
        // Rec. 709 weights on encoded values, brightened so that colours stand out.
        const double grey = 40 + 0.7 * (0.2126 * p[0] + 0.7152 * p[1] + 0.0722 * p[2]);
        std::fill_n(p, 3, std::uint8_t(grey));
        const std::size_t at = i / width / every * columns + i % width / every;
        const Artefact artefact = at < classified.size() ? classified[at].artefact : Artefact::None;
        if (artefact != Artefact::None) std::copy_n(kStyles[std::size_t(artefact) - 1].rgb.begin(), 3, p);
        p[3] = 255;
    }
    return out;
}

}  // namespace si
