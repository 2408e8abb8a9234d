// What a fit finds of a light that is placed: where across its view shadows may lie. Pure CPU, double precision.
#pragma once

#include <limits>
#include <optional>

#include "renderer/projection/camera.h"
#include "renderer/projection/depth_span.h"
#include "renderer/projection/light_view.h"
#include "renderer/view/bounds/scene_shape.h"

namespace si {

/// Whose shadows count: of all that receives, or of the model, or of the ground that it is stood on.
enum class ReceiverFilter { All, Model, Ground };

struct FitInput {
    const Scene& scene;
    const SceneShape& shape;  ///< of the scene
    /// Place, axes and kind of projection; in perspective nothing beyond half_width is lit by this light.
    const LightView& view;
    double reach_m = std::numeric_limits<double>::infinity();  ///< in perspective: nothing beyond is lit
    const Camera* camera = nullptr;                            ///< of rows that read it; null: there is none
    std::optional<DepthSpan> seen_m;  ///< camera depths of all that it sees, where they were measured
    ReceiverFilter receiver_filter = ReceiverFilter::All;
    bool receives(std::size_t box) const {
        return shape.box_receives[box] && (receiver_filter == ReceiverFilter::All ||
                                           (box == shape.ground) == (receiver_filter == ReceiverFilter::Ground));
    }
};

/// A rectangle across the view: metres, or in perspective tangents.
struct MapRegion {
    glm::dvec2 lo{std::numeric_limits<double>::infinity()};
    glm::dvec2 hi{-std::numeric_limits<double>::infinity()};
    bool empty() const { return !(lo.x <= hi.x && lo.y <= hi.y); }
    bool holds(const MapRegion& r) const {
        return r.empty() || (lo.x <= r.lo.x && lo.y <= r.lo.y && hi.x >= r.hi.x && hi.y >= r.hi.y);
    }
    void add(const MapRegion& r) {
        lo = glm::min(lo, r.lo);
        hi = glm::max(hi, r.hi);
    }
    void add(const glm::dvec2& p) {
        lo = glm::min(lo, p);
        hi = glm::max(hi, p);
    }
    MapRegion common(const MapRegion& r) const { return {glm::max(lo, r.lo), glm::min(hi, r.hi)}; }
};

/// All that a map has to cover, so that no point that the light can reach lies in shadow outside of it; nothing: the
/// whole scene, without such a promise.
using Fit = std::optional<MapRegion> (*)(const FitInput&);

std::optional<MapRegion> fit_scene(const FitInput&);
std::optional<MapRegion> fit_casters(const FitInput&);
std::optional<MapRegion> fit_view(const FitInput&);

}  // namespace si
