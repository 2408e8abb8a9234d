#include "tests/support/guided.h"

#include <algorithm>
#include <cmath>

#include "app/session/presets.h"
#include "app/session/session.h"
#include "renderer/measure/measured_error.h"
#include "renderer/scenes/builtin.h"

namespace si::test {
namespace {

bool named(const GuidedDrawing::Nodes& nodes, const std::string& path) {
    return std::any_of(nodes.begin(), nodes.end(), [&](const std::string& node) {
        return node.ends_with('*') ? path.starts_with(std::string_view(node).substr(0, node.size() - 1)) : path == node;
    });
}

/// Returns the scene with the objects of these nodes only.
Scene only_nodes(Scene scene, const GuidedDrawing::Nodes& nodes) {
    std::erase_if(scene.objects, [&](const Object& o) { return !named(nodes, scene.nodes[std::size_t(o.node)].path); });
    return scene;
}

}  // namespace

GuidedDrawing::GuidedDrawing(const std::string& key, const ClaimSubject& subject) {
    const Preset preset = load_preset(subject.preset.empty() ? key : subject.preset);
    scene = load_scene(preset.scene);
    settings = preset.settings;
    for (const std::string& change : subject.set) apply_set(settings, change);
    shot = draw_shot(scene, settings, subject.size.at(0), subject.size.at(1));
    if (shot.frame.map_view.texture) map_view = hard_renderer().read_colour(shot.frame.map_view);
}

const RayReference& GuidedDrawing::rays() const {
    if (!rays_) rays_.emplace(scene);
    return *rays_;
}

const std::vector<std::optional<Hit>>& GuidedDrawing::hits() const {
    if (hits_.empty())
        for (const PixelRay& ray : pixel_rays(shot)) hits_.push_back(rays().first_hit(ray.origin, ray.direction));
    return hits_;
}

const ErrorMetrics& GuidedDrawing::error() const {
    if (error_) return *error_;
    ReferenceCache cache;
    const FrameRequest request{.width = shot.width, .height = shot.height};
    error_ = measure_error(hard_renderer(), scene, settings, request, settings.view.light, reference_options(settings),
                           cache)
                 .metrics;
    return *error_;
}

const Classification& GuidedDrawing::classification() const {
    if (!classification_)
        classification_ = Measurer(hard_renderer(), shot.width, shot.height).classify(scene, settings);
    return *classification_;
}

GuidedDrawing::MeanErrors GuidedDrawing::mean_errors() const {
    const ReferenceImage reference =
        trace_reference(rays(), shot.frame.camera, shot.light(), shot.width, shot.height, shot.frame.map_resolution, 6);
    MeanErrors sum;
    int dark = 0;
    int lit = 0;
    for (int y = 0; y < shot.height; ++y)
        for (int x = 0; x < shot.width; ++x) {
            const double v = shot.visibility.at(x, y);
            if (reference.state_at(x, y) == ReferenceState::Shadow) {
                ++dark;
                sum.bled += v;
            }
            if (reference.state_at(x, y) == ReferenceState::Lit) {
                ++lit;
                sum.darkened += 1 - v;
            }
        }
    EXPECT_GT(dark, 40) << "too few pixels to say anything";
    EXPECT_GT(lit, 1000) << "too few pixels to say anything";
    return {sum.bled / dark, sum.darkened / lit};
}

bool GuidedDrawing::counts(std::size_t pixel, const Nodes& receivers) const {
    if (!hits()[pixel]) return false;
    const Hit& hit = *hits()[pixel];
    // Surfaces edge-on to the light are left out: rounding decides their side.
    if (glm::dot(hit.normal, direction_to(shot.light(), hit.position)) <= 0.02) return false;
    const int object = rays().triangle(hit.triangle).object;
    return receivers.empty() ||
           named(receivers, scene.nodes[std::size_t(scene.objects[std::size_t(object)].node)].path);
}

/// Calls `use(hit, visibility)` for the counted pixels.
template <class Use>
void GuidedDrawing::each_pixel(const Nodes& receivers, Use use) const {
    for (std::size_t i = 0; i < hits().size(); ++i)
        if (counts(i, receivers)) use(*hits()[i], shot.visibility.data[i]);
}

int GuidedDrawing::edges(const Nodes& receivers) const {
    int count = 0;
    for (std::size_t i = 0; i + 1 < hits().size(); ++i)
        if ((i + 1) % std::size_t(shot.width) != 0 && counts(i, receivers) && counts(i + 1, receivers))
            count += (shot.visibility.data[i] < 0.5f) != (shot.visibility.data[i + 1] < 0.5f);
    return count;
}

double GuidedDrawing::mean_of_drawn(const std::function<double(int x, int y)>& value) const {
    const FloatImage& map = shot.maps.at(0);
    const double empty = shot.view().curve.convention.far_depth();
    double sum = 0;
    int count = 0;
    for (int y = 0; y < map.height; ++y)
        for (int x = 0; x < map.width; ++x)
            if (map.at(x, y) != empty) {
                sum += value(x, y);
                ++count;
            }
    EXPECT_GT(count, 100) << "too few texels to say anything";
    return sum / std::max(count, 1);
}

bool GuidedDrawing::shadowed(const RayReference& rays, const Hit& hit) const {
    return rays.occluded(hit.position + 1e-5 * hit.normal, shot.light(), -1);
}

double GuidedDrawing::wrongly_dark(const Nodes& receivers) const {
    int lit = 0, wrong = 0;
    each_pixel(receivers, [&](const Hit& hit, float v) {
        if (!shadowed(rays(), hit)) {
            ++lit;
            wrong += v < 0.5f;
        }
    });
    EXPECT_GT(lit, 100) << "too few pixels to say anything";
    return double(wrong) / std::max(lit, 1);
}

double GuidedDrawing::wrongly_lit(const Nodes& receivers, const Nodes& casters) const {
    std::optional<RayReference> some;
    if (!casters.empty()) some.emplace(only_nodes(scene, casters));
    int shadow = 0, wrong = 0;
    each_pixel(receivers, [&](const Hit& hit, float v) {
        if (shadowed(some ? *some : rays(), hit)) {
            ++shadow;
            wrong += v >= 0.5f;
        }
    });
    EXPECT_GT(shadow, 30) << "too few pixels to say anything";
    return double(wrong) / std::max(shadow, 1);
}

double GuidedDrawing::lit_where(const std::function<bool(const glm::dvec4&, bool)>& chosen) const {
    int count = 0, lit = 0;
    each_pixel({}, [&](const Hit& hit, float v) {
        if (!chosen(uvdw(view_of(shot.light(), hit.position), hit.position), shadowed(rays(), hit))) return;
        ++count;
        lit += v >= 0.5f;
    });
    EXPECT_GT(count, 100) << "too few pixels to say anything";
    return count > 0 ? double(lit) / count : -1;
}

double GuidedDrawing::grey() const {
    int count = 0, seen = 0;
    each_pixel({}, [&](const Hit&, float v) {
        ++seen;
        count += v > 0.01f && v < 0.99f;
    });
    return double(count) / std::max(seen, 1);
}

int GuidedDrawing::grey_levels() const {
    std::set<long> levels;
    each_pixel({}, [&](const Hit&, float v) {
        if (v > 0.005f && v < 0.995f) levels.insert(std::lround(v * 1000));
    });
    return int(levels.size());
}

double GuidedDrawing::dark() const {
    int count = 0, seen = 0;
    each_pixel({}, [&](const Hit&, float v) {
        ++seen;
        count += v < 0.5f;
    });
    return double(count) / std::max(seen, 1);
}

}  // namespace si::test
