// Shimmering of shadow edges while camera or light move by parts of a texel. The picture's camera stands still, so that
// each pixel shows one surface point. The camera for which maps are fitted moves, or the light.
#pragma once

#include <functional>
#include <span>
#include <string_view>
#include <vector>

#include "renderer/base/workers.h"
#include "renderer/render/renderer.h"

namespace si {

/// Motion under which shimmering shadow edges are measured.
enum class ShimmerMotion { CameraMoves, CameraTurns, LightTurns };

/// Row of the table of motions under which shimmering shadow edges are measured: key, label and help.
struct ShimmerMotionRow {
    ShimmerMotion motion;
    std::string_view key, label, help;
};
/// Returns the table of motions of camera or light under which shimmering shadow edges are measured.
std::span<const ShimmerMotionRow> shimmer_motions();

/// Options for measuring shimmering shadow edges: motion, number and length of steps.
struct ShimmerOptions {
    ShimmerMotion motion = ShimmerMotion::CameraMoves;
    int steps = 32;            ///< number of steps
    double step_texels = 0.3;  ///< length of a step at the scene's centre, in texels of the first map of view.light
};

/// Measured shimmering of shadow edges under one set of settings. A pixel flips when its visibility crosses one half
/// from one step of the motion to the next.
struct Shimmer {
    std::size_t places = 0;           ///< number of pixels that show a surface
    std::vector<std::size_t> flips;   ///< flipped pixels per step
    double flips_a_step = 0;          ///< mean of `flips`
    std::size_t max_flips = 0;        ///< largest of `flips`
    std::size_t flipping_pixels = 0;  ///< number of pixels that flip at least once
    double change = 0;                ///< mean absolute change of visibility per pixel and step
    FloatImage flips_of;              ///< flips per pixel, one channel
};

/// Measures the shimmering of shadow edges: draws the same picture in small steps of camera or light, and counts pixels
/// that flip between lit and shadow.
/// @param width, height size of the picture in pixels @param report receives the share done, 0..1
/// @throws Error when view.light has no map; Cancelled
Shimmer measure_shimmer(Renderer& renderer, const Scene& scene, const Settings& settings, int width, int height,
                        const ShimmerOptions& options, const Workers& workers = {},
                        const std::function<void(double)>& report = {});

/// Named settings for a comparison of shimmering shadow edges.
struct ShimmerVariant {
    std::string_view key, label;
    Settings settings;
};
/// Returns the settings to compare for shimmering shadow edges: the given settings first. For a directional light, adds
/// the same settings with light.fit stabilised twice: with light.snap on, and with it off.
std::vector<ShimmerVariant> shimmer_variants(const Settings& settings);

}  // namespace si
