// Fits of a placed light: the region across its view in which shadows may lie. CPU, double precision.
#pragma once

#include <limits>
#include <optional>

#include "renderer/projection/camera.h"
#include "renderer/projection/depth_span.h"
#include "renderer/projection/light_view.h"
#include "renderer/view/bounds/scene_shape.h"

namespace si {

class CameraSlice;

/// Choice of the receivers whose shadows a map has to cover: all, those of the model, or the generated ground.
enum class ReceiverFilter { All, Model, Ground };

/// Input for finding the region that a light's shadow map has to cover: scene, light view, camera and receivers.
struct FitInput {
    const Scene& scene;
    const SceneShape& shape;  ///< boxes of the scene
    /// Place, axes and projection of the light. A perspective light lights nothing outside the view.
    const LightView& view;
    double reach_m = std::numeric_limits<double>::infinity();  ///< range of a perspective light in metres
    const Camera* camera = nullptr;   ///< camera of the picture, for fits that read it; else null
    std::optional<DepthSpan> seen_m;  ///< camera depths of all visible surfaces, where they were measured
    ReceiverFilter receiver_filter = ReceiverFilter::All;  ///< receivers that count
    /// Returns true when an object receives shadows and passes the receiver filter of the fit.
    /// @param box index into SceneShape::boxes
    bool receives(std::size_t box) const {
        return shape.box_receives[box] && (receiver_filter == ReceiverFilter::All ||
                                           (box == shape.ground) == (receiver_filter == ReceiverFilter::Ground));
    }
};

/// Rectangle across a light's view: metres, or in perspective tangents of the angles to the axis. Empty by default.
using MapRegion = Bounds2;

/// Function that finds the region of a light's view that its shadow map has to cover. It guarantees that outside the
/// region no surface that faces the light lies in shadow. Fits that read the camera guarantee this only for surfaces
/// that the camera sees. An empty result gives no guarantee: the map then covers the whole scene.
using FitFunction = std::optional<MapRegion> (*)(const FitInput&);

/// Returns a region of a light's view that contains every place where a caster shadows a receiver facing the light;
/// empty without any shadow. Shadow maps need not cover more. Intersects the bounding boxes of casters with the box
/// around all receivers. Flat casters and large convex casters cannot shadow their own lit side. For them, triangles of
/// receivers are clipped to the space behind the caster, and back-facing triangles of single-sided receivers are
/// skipped.
/// @param seen a slice of the camera's frustum; only the parts of receivers inside it count
std::optional<MapRegion> shadowed_region(const FitInput& in, const CameraSlice* seen = nullptr);

/// Returns the region of a light's view in which casters shadow any receiver (light.fit casters). The shadow map then
/// covers the region. Empty if there is no shadow.
std::optional<MapRegion> fit_casters(const FitInput&);
/// Returns the region of a light's view in which casters shadow receivers that the camera sees (light.fit view).
/// Without a camera, all receivers count. The shadow map then covers the region. Empty if there is no shadow.
std::optional<MapRegion> fit_view(const FitInput&);

}  // namespace si
