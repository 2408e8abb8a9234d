#include "renderer/view/view_choice.h"

namespace si {
namespace {

std::size_t face_of(const glm::dvec3& d) {
    const glm::dvec3 a = glm::abs(d);
    if (a.x >= a.y && a.x >= a.z) return d.x >= 0 ? 0 : 1;
    if (a.y >= a.z) return d.y >= 0 ? 2 : 3;
    return d.z >= 0 ? 4 : 5;
}

}  // namespace

ChosenView ViewChooser::choose([[maybe_unused]] std::span<const LightView> views, const glm::dvec3& point_ws) const {
    switch (choice) {
        case ViewChoice::One:
            break;
        case ViewChoice::Face:
            return {face_of(point_ws - from_ws)};
    }
    return {};
}

}  // namespace si
