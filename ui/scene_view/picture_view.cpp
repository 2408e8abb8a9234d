#include "ui/scene_view/picture_view.h"

#include <cmath>
#include <limits>

#include "ui/scene_view/frustum_lines.h"

namespace si {
namespace {

constexpr double kParallel = 1e-9;

}  // namespace

std::optional<glm::dvec2> PictureView::point(const glm::dvec3& world) const {
    const auto both = segment(world, world);
    if (!both) return {};
    return both->first;
}

std::optional<std::pair<glm::dvec2, glm::dvec2>> PictureView::segment(const glm::dvec3& from,
                                                                      const glm::dvec3& to) const {
    auto on = project_segment(camera, from, to, int(size.x), int(size.y));
    if (on) {
        on->first += origin + 0.5;
        on->second += origin + 0.5;
    }  // project() has pixel centres at whole numbers
    return on;
}

Ray PictureView::ray(const glm::dvec2& screen) const {
    Ray r;
    const glm::dvec2 pixel = screen - origin - 0.5;
    camera.pixel_ray(pixel.x, pixel.y, int(size.x), int(size.y), r.origin, r.direction);
    if (camera.orthographic) r.begin = -std::numeric_limits<double>::infinity();
    return r;
}

double PictureView::metres_per_pixel(const glm::dvec3& world) const {
    const double seen = camera.orthographic ? camera.height
                                            : 2 * std::tan(0.5 * camera.fov_y_rad) *
                                                  std::abs(glm::dot(camera.axes[2], camera.eye - world));
    return seen / size.y;
}

bool PictureView::contains(const glm::dvec2& screen) const {
    const glm::dvec2 p = screen - origin;
    return p.x >= 0 && p.y >= 0 && p.x < size.x && p.y < size.y;
}

std::optional<glm::dvec3> intersect_plane(const Ray& ray, const glm::dvec3& point, const glm::dvec3& normal) {
    const double towards = glm::dot(ray.direction, normal);
    if (std::abs(towards) < kParallel) return {};
    const double t = glm::dot(point - ray.origin, normal) / towards;
    if (!(t > ray.begin)) return {};
    return ray.origin + t * ray.direction;
}

std::optional<double> nearest_on_line(const Ray& ray, const glm::dvec3& origin, const glm::dvec3& direction) {
    const glm::dvec3 w = origin - ray.origin;
    const double b = glm::dot(direction, ray.direction), spread = 1 - b * b;
    if (spread < kParallel) return {};
    const double on_line = glm::dot(direction, w), on_ray = glm::dot(ray.direction, w);
    if (!((on_ray - b * on_line) / spread > ray.begin)) return {};
    return (b * on_ray - on_line) / spread;
}

}  // namespace si
