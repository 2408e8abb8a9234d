// Conditions of map.virtual, and the page size.
#include "renderer/settings/paging.h"

#include <algorithm>
#include <bit>

#include "renderer/settings/filters.h"

namespace si {

std::string_view paging_idle_reason(const Settings& s, int) {
    if (filter_of(s).samples() != Samples::Depth)
        return "without effect: this kernel reads data made from whole maps, not depths";
    return s.map.blur_texels > 0 ? "without effect: map.blur_texels blurs whole maps" : "";
}

bool draws_pages(const Settings& s) {
    return s.map.paged && paging_idle_reason(s, 0).empty();
}

bool has_clip_levels(const Settings& s, int light) {
    const LightSettings& l = s.lights[std::size_t(light)];
    return draws_pages(s) && s.map.virtual_levels > 1 && l.type == LightType::Directional &&
           l.fit != LightFit::Manual && l.projection != LightProjection::Perspective;
}

int page_texels(const Settings& s) {
    const int most = std::max(std::min(s.map.page_size, s.map.resolution / 8), 1);
    return int(std::bit_floor(unsigned(most)));
}

}  // namespace si
