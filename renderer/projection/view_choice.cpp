#include "renderer/projection/view_choice.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "renderer/projection/projection.h"

namespace si {
namespace {

std::size_t face_of(const glm::dvec3& d) {
    const glm::dvec3 a = glm::abs(d);
    if (a.x >= a.y && a.x >= a.z) return d.x >= 0 ? 0 : 1;
    if (a.y >= a.z) return d.y >= 0 ? 2 : 3;
    return d.z >= 0 ? 4 : 5;
}

/// Returns max(|u|, |v|) of a point from a map's centre; infinite outside the near and far planes. For parallel rays.
double from_centre(const LightView& view, const glm::dvec3& point_ws) {
    const glm::dvec4 h = uvd_from_clip(view.curve.convention) * view.clip_position(point_ws);
    if (!(h.w > 0 && h.z >= 0 && h.z <= h.w)) return std::numeric_limits<double>::infinity();
    return std::max(std::abs(h.x / h.w - 0.5), std::abs(h.y / h.w - 0.5));
}

}  // namespace

ChosenView ViewChooser::choose(std::span<const LightView> views, const glm::dvec3& point_ws) const {
    if (choice == ViewChoice::One) return {};
    if (choice == ViewChoice::Face) return {.view = face_of(point_ws - from_ws), .other = face_of(point_ws - from_ws)};
    ChosenView chosen{views.size() - 1, views.size() - 1, 0};
    bool held = false;
    for (std::size_t i = views.size(); i-- > 0;) {
        const double at = choice == ViewChoice::Interval   ? glm::dot(point_ws - from_ws, forward)
                          : choice == ViewChoice::Distance ? glm::distance(point_ws, from_ws)
                                                           : from_centre(views[i], point_ws);
        const ViewSpan& span = spans[i];
        if (!(at < span.ends)) continue;
        const bool blends = held && at > span.blends_from;
        chosen = {i, blends ? chosen.view : i, blends ? (at - span.blends_from) / (span.ends - span.blends_from) : 0};
        held = true;
    }
    return chosen;
}

std::string view_short_name(ViewChoice choice, std::size_t view) {
    constexpr const char* kFaces[] = {"+x", "-x", "+y", "-y", "+z", "-z"};
    return choice == ViewChoice::Face ? kFaces[std::min<std::size_t>(view, 5)] : std::to_string(view + 1);
}

std::string view_name(ViewChoice choice, std::size_t view, std::size_t views) {
    if (choice == ViewChoice::One || views < 2) return {};
    const std::string mark = view_short_name(choice, view);
    if (choice == ViewChoice::Face) return "face " + mark;
    return fmt::format("{} {} of {}", choice == ViewChoice::Distance ? "clip level" : "cascade", mark, views);
}

}  // namespace si
