// The lit/shadow test of one pixel written out: surface, look-up, every tap of the kernel, every term of the bias.
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "renderer/bias/account.h"
#include "renderer/frame/frame.h"
#include "renderer/projection/camera.h"

namespace si {

/// One comparison of the kernel.
struct KernelTap {
    enum class Meets {
        Nothing,  ///< nothing was drawn there, or it is outside of the map
        Own,      ///< the receiver's plane, up to what storing it may err: dark here is acne
        Nearer,   ///< a surface nearer to the light than the plane: an occluder
        Farther,  ///< a surface behind the plane
    };
    glm::ivec2 texel{0};              ///< x to the right, y up, before map.wrap
    double weight = 0;                ///< share of the kernel's result
    double stored = 0, stored_m = 0;  ///< depth, and metres along the light's axis
    double plane = 0;                 ///< depth of the receiver's plane at the texel's centre
    double compared = 0;              ///< depth that the texel is compared with
    bool lit = false;                 ///< the comparison's result
    Meets meets = Meets::Nothing;
};

/// What a kernel learned besides visibility; not a number where it does not say.
struct KernelFacts {
    static constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
    /// How far along the light's axis the occluder that it found lies before the surface, on average.
    double blocker_m = kUnknown;
    double penumbra_texels = kUnknown;  ///< width of the penumbra that it made
    double texels = 0;                  ///< that it fetched
    double variance = kUnknown;         ///< of depths, in squares of the map's depth range
    // Of kernels that read moments; NaN elsewhere.
    std::array<double, 4> moments{kUnknown, kUnknown, kUnknown, kUnknown};  ///< that it read, as many as it stores
    double mean = kUnknown;          ///< the depth that they say, as a share of the map's range
    double own = kUnknown;           ///< the depth that it compared, as a share of the range
    double margin = kUnknown;        ///< of the moments: below 0, no distribution of depths has them
    double bound = kUnknown;         ///< the most that can be lit by them, before light-bleed reduction
    std::vector<std::string> lines;  ///< the same in words, with the formula of the bound
};

/// How far to either side of the look-up a probe keeps what the map stores, in texels.
inline constexpr int kProbeRowReachTexels = 32;

struct Probe {
    bool hit = false;
    int x = 0, y = 0;
    glm::uvec2 id{0};  ///< of the triangle, as in SurfaceIds
    Camera camera;
    int width = 0, height = 0;  ///< of the picture that x and y count in
    int map_resolution = 0;
    SurfaceIds around;        ///< of the pixels within kRunReach of this one, as far as the picture goes
    glm::ivec2 around_at{0};  ///< the place of its top left pixel in the picture
    glm::dvec3 position_ws{0}, normal_ws{0};
    std::string object;
    struct PerLight {
        int light = 0, face = 0;  ///< the face or cascade that it is looked up in
        /// "cascade 2 of 4", in a band with what is blended in; empty for a light's only view. All below is of this
        /// one.
        std::string view;
        bool casts = false, receives = true;
        FittedLight fitted;
        SurfacePoint point;
        BiasBreakdown account;
        glm::dvec4 clip{0};   ///< light clip space
        glm::dvec3 ndc{0};    ///< after division by w
        glm::dvec3 uvd{0};    ///< [0,1]: map coordinates and depth
        glm::dvec3 tap{0};    ///< the same after the normal offset: where the kernel is centred
        glm::ivec2 texel{0};  ///< that the kernel is centred in
        double n_dot_l = 0;
        double stored = 0, stored_m = 0;  ///< nearest texel, raw and metres along the light's axis
        double own = 0, own_m = 0;        ///< the fragment's own depth before bias
        double gap_m = 0;  ///< how much nearer to the light the texel's surface is, metres along the light's ray
        double stored_linear = 0, own_linear = 0;  ///< 0 at the near plane, 1 at the far plane
        double bias_depth = 0, bias_texels = 0, bias_m = 0;
        double normal_offset_m = 0;
        glm::dvec3 offset_position_ws{0};  ///< after the normal offset
        double texel_m = 0;
        double compared = 0;          ///< depth after bias, of 16 and 24-bit maps within [0,1], at the look-up
        double compared_nearest = 0;  ///< the one that the nearest texel is compared with
        KernelFacts kernel;
        std::vector<KernelTap> taps;  ///< row by row from the lowest, each texel once; none of kernels that are no sum
        glm::ivec2 taps_first{0}, taps_size{0};  ///< the rectangle of texels that holds all of them
        /// The texels within kProbeRowReachTexels of `texel` along the map's u and along its v, each as the kernel
        /// would compare it; those that it does not weigh 0. Empty where the point has no place in a map.
        std::array<std::vector<KernelTap>, 2> rows;
        double visibility = 1;   ///< what the renderer's filter computed, another cascade blended in
        CauseEvidence evidence;  ///< trials of the pixel; gaps, run_m and edge_m are the truth's to fill in
        CauseContext causes;
        std::optional<MapPlace> place;  ///< nothing: the light has no map
        std::string verdict;            ///< a sentence
    };
    std::vector<PerLight> lights;
};

}  // namespace si
