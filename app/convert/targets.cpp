#include "app/convert/targets.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>

#include "renderer/base/did_you_mean.h"
#include "renderer/base/error.h"
#include "renderer/settings/param.h"

namespace si {
namespace {

constexpr std::array<ConvertTarget, 20> kTargets{{
    {"glsl", "GLSL", "//", ".glsl"},
    {"cpp", "C++", "//", ".h"},
    {"three", "three.js", "//", ".js", three_code},
    {"babylon", "Babylon.js", "//", ".js", babylon_code},
    {"playcanvas", "PlayCanvas", "//", ".js", playcanvas_code},
    {"godot", "Godot 4", "#", ".gd", godot_code},
    {"urp", "Unity URP, depth bias (legacy)", "//", ".cs", urp_code},
    {"urp-slope", "Unity URP, slope-scale", "//", ".cs", urp_slope_code},
    {"hdrp", "Unity HDRP", "//", ".cs", hdrp_code},
    {"unreal", "Unreal Engine 5", ";", ".ini", unreal_code},
    {"filament", "Filament", "//", ".cpp", filament_code},
    {"bevy", "Bevy", "//", ".rs", bevy_code},
    {"o3de", "O3DE", "//", ".cpp", o3de_code},
    {"opengl", "OpenGL", "//", ".c", opengl_code},
    {"vulkan", "Vulkan", "//", ".c", vulkan_code},
    {"d3d12", "Direct3D 12", "//", ".cpp", d3d12_code},
    {"webgpu", "WebGPU", "//", ".js", webgpu_code},
    {"godot3", "Godot 3", "#", ".gd", godot3_code},
    {"ogre", "OGRE 1.12", "//", ".cpp", ogre_code},
    {"filament19", "Filament 1.9", "//", ".cpp", filament19_code},
}};

}  // namespace

std::span<const ConvertTarget> convert_targets() {
    return kTargets;
}

const ConvertTarget& convert_target(std::string_view name) {
    const auto found = std::ranges::find(kTargets, name, &ConvertTarget::name);
    if (found != kTargets.end()) return *found;
    std::vector<std::string> names;
    for (const ConvertTarget& row : kTargets) names.emplace_back(row.name);
    throw UsageError(fmt::format("--to: no target '{}'; there are {}{}", name, fmt::join(names, ", "),
                                 did_you_mean(nearest_name(name, names))));
}

}  // namespace si
