// Input of fitting one light's shadow maps, and the steps that kinds of maps share. Inside of view/ only.
#pragma once

#include <algorithm>
#include <limits>
#include <optional>
#include <span>
#include <string>

#include "renderer/projection/camera.h"
#include "renderer/projection/depth_span.h"
#include "renderer/view/bounds/scene_shape.h"
#include "renderer/view/lights/light.h"

namespace si {

/// Limits of half the opening angle of a perspective shadow map, radians; its tan() stays below 15.
inline constexpr double kMinHalfAngle = 1e-3;
inline constexpr double kMaxHalfAngle = 1.5;
/// Margin at each side of a shadow map in texels, so that a filter kernel at the scene's edge finds cleared texels.
inline constexpr double kMarginTexels = 2;
/// Smallest ratio near / far of a perspective shadow map. A D24 map then resolves about far / 17,000 at the far plane.
inline constexpr double kMinNearShare = 1e-3;
/// Smallest camera depth that the fit of a shadow map uses, as a share of the farthest visible depth. A camera inside
/// the scene sees surfaces at 0 m.
inline constexpr double kMinSeenDepthShare = 1e-3;
/// Margin at each end of a shadow map's depth range, as a share of the range.
inline constexpr double kDepthMargin = 1e-4;

/// Input for fitting the shadow maps of one light: scene, settings, resolution and camera.
struct FitContext {
    const Scene& scene;
    const SceneShape& shape;
    const LightSettings& settings;  ///< settings of this light
    const Settings& all_settings;
    DepthConvention convention;
    int resolution;                   ///< texels along a side of a map
    double face_margin_texels;        ///< margin around a cube face, from face_margin_texels()
    double reach_m;                   ///< range of a spot or point light in metres; infinite when unlimited
    const Camera* camera;             ///< null for fits without a camera
    double margin_texels;             ///< margin around the region to cover, from fit_margin_texels()
    std::optional<DepthSpan> seen_m;  ///< camera depths of all visible surfaces; nullopt: not measured
    double normal_m = 0;              ///< normal offset if it is set in metres, else 0; all_settings has it in texels
};

/// Adds a message to the notes of a light, unless the light has it already.
void add_note(PlacedLight& light, std::string text);

/// Returns the distance in metres by which a light view with parallel rays moves its eye forward, so that near and far
/// stay exact in single precision. The distance is `near` if the range is tiny compared with its distance from the eye,
/// else 0. Parallel rays look the same from anywhere along them.
/// @param near,far depth range before the move, metres
double eye_advance_m(double near, double far);

/// Returns half the width of a shadow map after adding a margin in texels at each side. The half width without margin
/// counts as at least 2^-13 of `scale`, a thousand steps of single precision.
/// @param half half width without margin: metres, or in perspective the tangent of half the angle of view
/// @param scale size of the scene in the same unit, such as its radius
/// @param resolution texels along a side of the map
/// @param margin texels
double half_extent_with_margin(double half, double scale, int resolution, double margin = kMarginTexels);

/// Completes a light view and adds it to the light's views: applies the manual depth range (light.near,
/// light.far) and the factor light.stretch, which lengthens that range. Widens a depth range that is still too small,
/// and computes the projection.
/// @param reference_z distance in metres from the light at which the view's texel size is computed
void add_finished_view(FittedLight& light, LightView view, const FitContext& c, double reference_z);

/// Returns the margin in texels around each of the six cube faces of a point light's map. Kernels and normal offsets
/// that cross an edge between faces then find their texels.
double face_margin_texels(const Settings& settings);

/// Computes the six cube face views of a point light or of a spot light with a wide cone. All faces share one depth
/// range, so that a stored depth means the same distance in each face.
void fit_faces(FittedLight& light, const FitContext& c);

/// Fits the single shadow map of a directional light or a spot light, and adds its view to the light.
void fit_one_view(FittedLight& light, const FitContext& c);

/// Adds a warped shadow map view (LiSPSM) to a light. The map's texels are smaller near the camera than far from it.
/// The map contains all given receiver points.
/// Wimmer, Scherzer, Purgathofer, Light Space Perspective Shadow Maps, EGSR 2004.
/// @param view view with its axes set; the third one points to the light
/// @param points receiver points, world; at least one
/// @param on_ground receiver points on a ground under a model, world; they change the map's width and height only if
/// some lie outside a map of `points`
/// @param margin texels at each side
void fit_warped(FittedLight& light, LightView view, const FitContext& c, const Camera& camera,
                std::span<const glm::dvec3> points, std::span<const glm::dvec3> on_ground, double margin);

/// Fits one map of a directional light for each interval of camera depth (cascaded shadow maps).
void fit_cascades(FittedLight& light, const FitContext& c, const Camera& camera);

}  // namespace si
