// What fitting the maps of one light goes by, and the steps that kinds of maps share. Inside of view/ only.
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

inline constexpr double kMinHalfAngle = 1e-3, kMaxHalfAngle = 1.5;  // rad; tan() stays below 15
inline constexpr double kMarginTexels = 2;  // at each side, so that a kernel at the scene's edge finds cleared texels
inline constexpr double kMinNearShare = 1e-3;  // least near / far of a perspective map: D24 then resolves far / 2e4
inline constexpr double kMinSeenDepthShare =
    1e-3;                                     // of the farthest depth: a camera within the scene sees surfaces at 0 m
inline constexpr double kDepthMargin = 1e-4;  // of the depth range, at each end

struct FitContext {
    const Scene& scene;
    const SceneShape& shape;
    const LightSettings& settings;
    const Settings& all_settings;
    DepthConvention convention;
    int resolution;
    double face_margin_texels;
    double reach_m;  ///< how far a spot or point light shines; infinite when unlimited
    const Camera* camera;
    double margin_texels;             ///< fit_margin_texels()
    std::optional<DepthSpan> seen_m;  ///< depths of all that the camera sees, where they were measured
};

/// Says something of a light, once.
void note(PlacedLight& light, std::string text);

/// Shaders know the ends of a range in single precision. Parallel rays look the same from anywhere along them: where
/// the light stands so far off that its range would lose its digits, the map is seen from so much nearer; else 0.
double eye_advance_m(double near, double far);

/// Half extent plus the margin in texels, at least a thousand float steps of `scale`.
double half_extent_with_margin(double half, double scale, int resolution, double margin = kMarginTexels);

/// Repairs the view's range, makes its matrix and adds it to the light's.
/// @param reference_z where texels are measured, metres
void add_finished_view(FittedLight& light, LightView view, const FitContext& c, double reference_z);

/// Kernels cross from one face of six into the next; a texel more for the normal offset's.
double face_margin_texels(const Settings& settings);

/// Six faces of one range, so that a depth means the same distance in each.
void fit_faces(FittedLight& light, const FitContext& c);

/// The single map of a sun or of a spot light.
void fit_one_view(FittedLight& light, const FitContext& c);

/// Adds a view that holds points and is warped towards the camera: texels near it are smaller than far ones.
/// Wimmer, Scherzer, Purgathofer, Light Space Perspective Shadow Maps, EGSR 2004.
/// @param view its axes: the third one towards the light
/// @param points that are looked up, world; at least one
/// @param on_ground the same, of a ground under a model: where what holds `points` holds these, too, only its depths
///     change
/// @param margin texels at each side
void fit_warped(FittedLight& light, LightView view, const FitContext& c, const Camera& camera,
                std::span<const glm::dvec3> points, std::span<const glm::dvec3> on_ground, double margin);

/// Maps of a directional light, each for an interval of the camera's depth.
void fit_cascades(FittedLight& light, const FitContext& c, const Camera& camera);

}  // namespace si
