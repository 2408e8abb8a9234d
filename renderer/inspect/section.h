// The shadow test of a probed pixel as a cross-section along the light's ray: the map's stair-step of texels, the
// surface's line, what is compared with what, and where it should lie. Pure CPU, no ImGui, no GL.
#pragma once

#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "renderer/inspect/pixel_diagnosis.h"
#include "renderer/inspect/probe.h"

namespace si {

class ReferenceScene;

/// Which row of the map's texels is cut, and how much of it.
struct SectionCut {
    int axis = 0;              ///< of the map: 0 along u, 1 along v
    int first = 0, count = 0;  ///< texels along it, all of them in Probe::PerLight::rows
    double reach_texels = 0;   ///< of the kernel, to either side of the look-up
    bool operator==(const SectionCut&) const = default;
};

/// Where the cut meets a surface that the light sees first, by rays.
struct ReferencePoint {
    double along = 0;   ///< map coordinate along the cut
    double axis_m = 0;  ///< metres along the light's axis; NaN: nothing stands there
};

/// Lengths are metres. Points count from where the light's ray meets the surface: y towards the light along the ray of
/// the look-up, x across it, the way that map coordinates grow. The cut runs through the look-up; a surface that a
/// normal offset has left beside it is seen along the cut's normal.
struct Section {
    /// A texel of the row, cut along its middle line in the other direction.
    struct Step {
        int texel = 0;                                ///< along the row
        glm::dvec2 from{0}, to{0};                    ///< its two sides at the stored depth
        glm::dvec2 from_ray{0, 1}, to_ray{0, 1};      ///< unit, towards the light, of its two sides
        glm::dvec2 compared_from{0}, compared_to{0};  ///< its sides at the depth that it is compared with
        double stored = 0, stored_m = 0;              ///< raw, and metres along the light's axis
        double weight = 0;                            ///< in the kernel, of all its texels; 0: not read
        bool lit = false;                             ///< the comparison's result, were it read
        bool in_map = true;
        KernelTap::Meets meets = KernelTap::Meets::Nothing;
    };
    /// A part of the way from the look-up to the compared depth.
    struct Term {
        std::string name;
        DepthShift amount;
        glm::dvec2 from{0}, to{0};
    };
    /// Mean and spread of the depths that a kernel of moments read.
    struct Moments {
        double mean = 0, spread = 0;  ///< y of the mean; one standard deviation, NaN: not known
        double bound = 1;             ///< the most that can be lit by them
    };

    SectionCut cut;
    int row = 0;                       ///< texel in the other direction
    double row_offset_texels = 0;      ///< by how many texels the middle line of the row lies beside the cut
    double surface_offset_texels = 0;  ///< by how many texels the surface itself lies beside the cut
    double texel_m = 0;                ///< width of a texel along the cut, at the look-up, across its ray
    double texel_long_m = 0;           ///< the same along the map, to which rays off its axis are slanted
    LightType light = LightType::Directional;
    double light_m = 0;  ///< along its axis from the light to the surface; directional: from the map's near plane
    bool lit = true, shadowed = false;  ///< what the kernel answers, above one half; whether the cut has any texels
    double visibility = 1, theta_rad = 0;
    std::vector<Step> steps;
    /// The surface's plane in the cut: a point of it, and unit. It misses the surface's own point where that lies
    /// beside the cut.
    glm::dvec2 surface_at{0}, surface_along{1, 0};
    glm::dvec2 light_ray{0, 1};        ///< unit, from the surface's point towards the light
    glm::dvec2 moved{0}, compared{0};  ///< the point after the normal offset, and after the depth bias
    double normal_offset_m = 0;
    std::vector<Term> terms;                       ///< of the depth bias, those that are not 0
    DepthShift raster;                             ///< by which polygon offset has moved the stored depths
    bool per_texel = false;                        ///< each texel is compared with a depth of its own
    std::optional<Moments> moments;                ///< of kernels that read them
    std::vector<std::vector<glm::dvec2>> profile;  ///< what the light sees in truth, each surface a line

    // By the dossier, where there is one.
    bool classified = false;
    std::string artefact;  ///< label; empty: nothing is wrong
    std::string verdict;   ///< a sentence
    bool reference_lit = true;
    bool tested = true;  ///< else the surface is dark, or lit, without a look at the map
    DepthShift least, has, lifted;
    /// Metres from the surface along its own ray of the light, as the dossier's `least` and `occluder` have them: bias
    /// must bring its depth towards the light at least so far, and less than so far. With an offset, too: `has` is what
    /// meets the near end, `lifted` what meets the far one.
    double window_from = 0, window_to = std::numeric_limits<double>::infinity();
    bool has_window = false;
    bool window_open() const { return window_from < window_to; }
    std::optional<glm::dvec2> occluder;  ///< what stands in the light's way in truth, nearest to the light
    double occluder_m = 0;               ///< metres along the light's ray to it
    bool occluder_in_map = true;         ///< else culling or the near plane leaves it out

    const Step* step_at(int texel) const;
    /// The texel that the look-up lies in; null where the map has none there.
    const Step* looked_up() const { return step_at(lookup_texel); }
    int lookup_texel = 0;
};

/// Which cut shows best why the pixel is as it is: along the map's direction in which the surface falls away from the
/// light faster, or, where an edge of shadow decides, in which that edge is nearer. A count of 0 where the light has no
/// map or the point no place in it.
/// @param dossier null: none @param resolution of the map
SectionCut section_cut(const Probe::PerLight& light, const PixelDiagnosis* diagnosis, const Settings& settings,
                       int resolution);

/// What the light sees first along the cut, eight rays a texel.
std::vector<ReferencePoint> reference_profile(const ReferenceScene& scene, const Probe::PerLight& light,
                                              const SectionCut& cut, int resolution);

/// @param dossier null: none, and nothing of the truth is known
/// @param profile reference_profile(), or empty
Section cross_section(const Probe::PerLight& light, const PixelDiagnosis* diagnosis, const SectionCut& cut,
                      int resolution, std::span<const ReferencePoint> profile = {});

/// All of that of one of a probe's lights.
/// @param dossiers of its lights, or fewer: of the others nothing of the truth is known @param casters null: no profile
Section pixel_section(const Probe& probe, std::size_t light, std::span<const PixelDiagnosis> diagnoses,
                      const Settings& settings, const ReferenceScene* casters);

}  // namespace si
