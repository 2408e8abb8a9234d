// How much the edges of shadows crawl while camera or light move by parts of a texel: the picture stands still, so that
// each pixel is a place on a surface, and what moves is the camera that the maps are made for, or the light.
#pragma once

#include <functional>
#include <span>
#include <string_view>
#include <vector>

#include "renderer/base/workers.h"
#include "renderer/render/renderer.h"

namespace si {

enum class ShimmerMotion { CameraMoves, CameraTurns, LightTurns };

struct ShimmerMotionRow {
    ShimmerMotion motion;
    std::string_view key, label, help;
};
std::span<const ShimmerMotionRow> shimmer_motions();

struct ShimmerOptions {
    ShimmerMotion motion = ShimmerMotion::CameraMoves;
    int steps = 32;
    double step_texels = 0.3;  ///< of the first map of view.light: what each step moves what is looked at by
};

/// Of one setting. A place flips when its visibility crosses one half between two steps.
struct Shimmer {
    std::size_t places = 0;           ///< pixels that show a surface
    std::vector<std::size_t> flips;   ///< by step
    double flips_a_step = 0;          ///< mean
    std::size_t max_flips = 0;        ///< of a step
    std::size_t flipping_pixels = 0;  ///< places that ever flip
    double change = 0;                ///< mean of |visibility changed by| over places and steps
    FloatImage flips_of;              ///< a channel: how often each pixel flips
};

/// @param report hears of the share done. @throws Error where view.light has no map; Cancelled
Shimmer measure_shimmer(Renderer& renderer, const Scene& scene, const Settings& settings, int width, int height,
                        const ShimmerOptions& options, const Workers& workers = {},
                        const std::function<void(double)>& report = {});

/// The settings as they are, and the light's map snapped to whole texels and not.
struct ShimmerVariant {
    std::string_view key, label;
    Settings settings;
};
std::vector<ShimmerVariant> shimmer_variants(const Settings& settings);

}  // namespace si
