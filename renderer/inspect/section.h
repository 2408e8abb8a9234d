// Cross-section of a probed pixel's shadow test along the light's ray: stored depths as steps, the surface, compared
// depths, and the window of right biases. CPU code without ImGui and GL.
#pragma once

#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "renderer/inspect/pixel_diagnosis.h"
#include "renderer/inspect/probe.h"

namespace si {

class ReferenceScene;

/// Row or column of shadow-map texels that a cross-section of the shadow test shows.
struct SectionCut {
    int axis = 0;              ///< direction in the map: 0 along u, 1 along v
    int first = 0, count = 0;  ///< texels along the cut, all in Probe::PerLight::rows
    double reach_texels = 0;   ///< reach of the kernel to either side of the look-up
    bool operator==(const SectionCut&) const = default;
};

/// Point of a cross-section where a ray from the light first meets a surface of the scene.
struct ReferencePoint {
    double along = 0;   ///< map coordinate along the cut, 0..1
    double axis_m = 0;  ///< metres along the light's axis; NaN: no surface
};

/// Cross-section of a pixel's shadow test, in metres, along the light ray of the pixel's look-up. The origin is the
/// surface point. The axis y points towards the light along this ray; x points across the ray, towards larger map
/// coordinates. Points off the cut are projected along its normal.
struct Section {
    /// Shadow-map texel in a cross-section, drawn as a step at its stored depth.
    struct Step {
        int texel = 0;                                ///< index along the cut
        glm::dvec2 from{0}, to{0};                    ///< both sides at the stored depth
        glm::dvec2 from_ray{0, 1}, to_ray{0, 1};      ///< unit vectors towards the light at both sides
        glm::dvec2 compared_from{0}, compared_to{0};  ///< both sides at the compared depth
        double stored = 0, stored_m = 0;              ///< stored depth: raw, and metres along the light's axis
        double weight = 0;                            ///< share of the kernel; 0: not read
        bool lit = false;                             ///< result of the comparison, also when not read
        bool in_map = true;
        KernelTap::Meets meets = KernelTap::Meets::Nothing;
    };
    /// Bias term in a cross-section: one segment of the drawn line from the depth at the look-up to the compared depth.
    struct Term {
        std::string name;
        DepthShift amount;
        glm::dvec2 from{0}, to{0};
    };
    /// Mean and spread of the depths that a moment kernel read, drawn in a cross-section.
    struct Moments {
        double mean = 0, spread = 0;  ///< y of the mean; one standard deviation, NaN: unknown
        double bound = 1;             ///< upper bound of visibility
    };

    SectionCut cut;
    int row = 0;                       ///< index of the row or column of texels that the cut shows
    double row_offset_texels = 0;      ///< signed distance from the cut to the middle line of `row`
    double surface_offset_texels = 0;  ///< signed distance from the cut to the surface point
    double texel_m = 0;                ///< width of a texel at the look-up, across the light's ray
    double texel_long_m = 0;           ///< width of a texel along the map; larger for oblique rays
    LightType light = LightType::Directional;
    double light_m = 0;     ///< distance from light to surface along the axis; parallel rays: from the near plane
    bool lit = true;        ///< visibility is at least one half
    bool shadowed = false;  ///< the cut has texels
    double visibility = 1, theta_rad = 0;
    std::vector<Step> steps;
    /// Plane of the surface in the cut: a point and a unit direction. With surface_offset_texels the plane misses the
    /// surface point.
    glm::dvec2 surface_at{0}, surface_along{1, 0};
    glm::dvec2 light_ray{0, 1};  ///< unit vector from the surface point towards the light
    glm::dvec2 moved{0};         ///< point after the normal offset
    glm::dvec2 compared{0};      ///< point after normal offset and depth bias
    double normal_offset_m = 0;
    std::vector<Term> terms;                       ///< depth bias by term, without zeros
    DepthShift raster;                             ///< shift of the stored depths by polygon offset
    bool per_texel = false;                        ///< each texel has its own compared depth
    std::optional<Moments> moments;                ///< for moment kernels
    std::vector<std::vector<glm::dvec2>> profile;  ///< first surfaces from the light, by rays; one polyline per surface

    // From the pixel diagnosis, where there is one.
    bool classified = false;       ///< a pixel diagnosis is known
    std::string artefact;          ///< label of the error; empty: none
    std::string verdict;           ///< a sentence
    bool reference_lit = true;     ///< result of the reference for a light without size
    bool tested = true;            ///< false: lit or dark without a look-up
    DepthShift least, has, shift;  ///< as in PixelDiagnosis
    /// Ends of the range of right biases, metres from the surface along its light ray (PixelDiagnosis::least and
    /// occluder). With a right bias, the equivalent depth bias `has` is at least window_from, and the shift towards the
    /// light `shift` is below window_to.
    double window_from = 0, window_to = std::numeric_limits<double>::infinity();
    bool has_window = false;
    /// Returns true when some depth bias is right for the pixel.
    bool window_open() const { return window_from < window_to; }
    std::optional<glm::dvec2> occluder;  ///< occluder nearest the light, by rays
    double occluder_m = 0;               ///< distance to the occluder, metres along the light's ray
    bool occluder_in_map = true;         ///< false: removed by culling or the near plane

    /// Returns the drawn step of a shadow-map texel in this cross-section: a line at the texel's stored depth. Null
    /// when the cut does not contain the texel.
    /// @param texel index along the cut
    const Step* find_step(int texel) const;
    /// Returns the step of the texel that the look-up falls into; null: the map has no texel there.
    const Step* lookup_step() const { return find_step(lookup_texel); }
    int lookup_texel = 0;  ///< index along the cut of the texel that the look-up falls into
};

/// Chooses the row or column of shadow-map texels whose cross-section shows a pixel's shadow test best. Near a shadow
/// edge, or in shadow, the cut crosses the nearest edge. Elsewhere it runs along the map axis on which the surface's
/// depth changes faster. SectionCut::count is 0 when the light has no map or the map does not cover the point.
/// @param light the probe's result for the light @param diagnosis diagnosis of the pixel; null: none
/// @param size texels of the map
SectionCut section_cut(const Probe::PerLight& light, const PixelDiagnosis* diagnosis, const Settings& settings,
                       MapSize size);

/// Traces rays from a light through a row or column of shadow-map texels to the first surface, eight rays per texel. A
/// cross-section draws the hit points beside the stored depths.
/// @param light the probe's result for the light @param cut the row or column @param size texels of the map
std::vector<ReferencePoint> reference_profile(const ReferenceScene& scene, const Probe::PerLight& light,
                                              const SectionCut& cut, MapSize size);

/// Computes the cross-section of a pixel's shadow test along a row or column of texels.
/// @param light the probe's result for the light
/// @param diagnosis diagnosis of the pixel; null: none, and the section lacks the ray-traced reference
/// @param size texels of the map
/// @param profile points of reference_profile(); empty: surfaces are not drawn
Section cross_section(const Probe::PerLight& light, const PixelDiagnosis* diagnosis, const SectionCut& cut,
                      MapSize size, std::span<const ReferencePoint> profile = {});

/// Computes the cross-section of one light's shadow test at a probed pixel. Chooses the row or column of texels, and
/// traces the first surfaces from the light by rays.
/// @param light index into Probe::lights
/// @param diagnoses diagnoses of the probe's lights; lights beyond their number are drawn without the ray-traced
/// reference
/// @param casters ray-tracing hierarchy of the scene; null: no surfaces are traced
Section pixel_section(const Probe& probe, std::size_t light, std::span<const PixelDiagnosis> diagnoses,
                      const Settings& settings, const ReferenceScene* casters);

}  // namespace si
