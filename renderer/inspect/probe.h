// Probe of one pixel: its shadow test written out, with surface, look-up, every kernel tap and every bias term.
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "renderer/bias/account.h"
#include "renderer/bundle/engine_bias.h"
#include "renderer/frame/frame.h"
#include "renderer/projection/camera.h"

namespace si {

/// Depth comparison of a shadow kernel with one texel: the texel, its weight, stored and compared depth, and the
/// result.
struct KernelTap {
    /// Class of the surface that the light meets at a shadow-map texel, by its stored depth relative to the receiver's
    /// plane there.
    enum class Meets {
        Nothing,  ///< the texel is empty or outside the map
        Own,      ///< the receiver's plane, within rounding errors; a dark result is acne
        Nearer,   ///< a surface nearer to the light than the plane: an occluder
        Farther,  ///< a surface behind the plane
    };
    glm::ivec2 texel{0};  ///< x to the right, y up, before map.wrap
    double weight = 0;    ///< share of the kernel's result
    double stored = 0;    ///< depth in the map, 0..1
    double stored_m = 0;  ///< stored depth in metres along the light's axis
    double plane = 0;     ///< depth of the receiver's plane at the texel's centre
    double compared = 0;  ///< depth of the surface point after bias, which is compared with the stored depth
    bool lit = false;     ///< the comparison's result
    Meets meets = Meets::Nothing;
};

/// Intermediate results of a shadow kernel at one pixel, such as blocker distance, penumbra width and moments. Numbers
/// that the kernel does not compute are NaN.
struct KernelFacts {
    static constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
    /// Mean distance from the surface to its occluders, metres along the light's axis.
    double blocker_m = kUnknown;
    double penumbra_texels = kUnknown;  ///< width of the penumbra, in shortest sides of a texel
    double texels = 0;                  ///< number of fetched texels
    double variance = kUnknown;         ///< variance of depths, in squares of the map's depth range
    // The rest is known for moment kernels only.
    std::array<double, 4> moments{kUnknown, kUnknown, kUnknown, kUnknown};  ///< fetched moments; unused ones NaN
    double mean = kUnknown;          ///< mean depth by the moments, as a share of the map's range
    double own = kUnknown;           ///< compared depth, as a share of the map's range
    double margin = kUnknown;        ///< validity of the moments; below 0: no distribution of depths has these moments
    double bound = kUnknown;         ///< upper bound of visibility by the moments, before light-bleed reduction
    std::vector<std::string> lines;  ///< the same numbers in words, with the formula of the bound
};

/// Number of texels to either side of the look-up whose stored depths a probe keeps.
inline constexpr int kProbeRowReachTexels = 32;

/// Probe of one pixel: the surface that the pixel shows, and the shadow test of this surface for every light.
struct Probe {
    bool hit = false;  ///< the pixel shows a surface
    int x = 0, y = 0;  ///< pixel, from the top left
    glm::uvec2 id{0};  ///< object and triangle of the pixel, as in SurfaceIds
    Camera camera;
    int width = 0, height = 0;  ///< size of the picture in pixels
    int map_resolution = 0;     ///< texels of a map's longer side
    MapSize map_size;           ///< texels of a map
    SurfaceIds around;          ///< object and triangle of the pixels within kRunReach, clipped to the picture
    glm::ivec2 around_at{0};    ///< top left pixel of `around` in the picture
    glm::dvec3 position_ws{0}, normal_ws{0};
    std::string object;    ///< path of the object
    bool may_cast = true;  ///< the object is drawn into maps: see can_cast()
    /// Shadow test of the probed pixel for one light: look-up, compared depths, bias, taps, verdict.
    struct PerLight {
        int light = 0;  ///< index of the light in the settings light.*
        int face = 0;   ///< cube face or cascade of the look-up; the numbers below belong to its view
        /// Name of the view, such as "cascade 2 of 4", with the other cascade in a blend band; empty for a single view.
        std::string view;
        bool casts = false;                        ///< the light has a shadow map
        EngineBias engine_bias = EngineBias::Own;  ///< knowledge of the bias with which an engine reads its map
        bool receives = true;                      ///< the surface receives shadows (object.PATH.receive)
        FittedLight fitted;
        SurfacePoint point;
        BiasBreakdown account;            ///< depth bias by setting, with the look-up in BiasBreakdown::receiver
        glm::ivec2 texel{0};              ///< texel at the kernel's centre
        double stored = 0, stored_m = 0;  ///< depth in the nearest texel: raw, and metres along the light's axis
        double own = 0;                   ///< depth of the pixel's surface before bias
        /// Distance from the surface to the stored depth, metres along the light's ray. Above 0: the stored depth is
        /// nearer to the light.
        double gap_m = 0;
        /// Stored depth of the texel and own depth of the surface, linear in distance: 0 at the near plane, 1 at the
        /// far plane.
        double stored_linear = 0, own_linear = 0;
        double bias_texels = 0;            ///< depth bias, texels
        glm::dvec3 offset_position_ws{0};  ///< surface position after the normal offset
        double compared = 0;               ///< depth after bias at the look-up; within [0,1] for 16 and 24-bit maps
        double compared_nearest = 0;       ///< depth after bias at the centre of the nearest texel
        KernelFacts kernel;
        std::vector<KernelTap> taps;             ///< bottom row first, each texel once; empty for moment kernels
        glm::ivec2 taps_first{0}, taps_size{0};  ///< bounding rectangle of the taps, texels
        /// Texels within kProbeRowReachTexels of the look-up's `texel`, along u and along v, each with its comparison.
        /// Texels outside the kernel have weight 0. Empty where the map does not cover the point.
        std::array<std::vector<KernelTap>, 2> rows;
        double visibility = 1;   ///< drawn visibility, cascades blended and darkened by contact shadows
        CauseEvidence evidence;  ///< trials of the pixel; gaps, run_m and edge_m come from the reference
        CauseContext causes;
        std::optional<MapPlace> place;  ///< place of the point in the map; none: the light has no map
        std::string verdict;            ///< a sentence
        /// Returns the width of the penumbra in metres across the light; NaN where the kernel computes none.
        double penumbra_m() const { return kernel.penumbra_texels * account.receiver.texel_short_m; }
    };
    std::vector<PerLight> lights;
};

}  // namespace si
