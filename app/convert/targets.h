// Table of the targets of a conversion. A new target is one row and one file with its code template.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "app/convert/code_text.h"

namespace si {

/// Target into whose code shadow settings are converted: an engine, a graphics API or a language. Row of
/// convert_targets().
struct ConvertTarget {
    std::string_view name, title;
    std::string_view comment;    ///< beginning of a comment up to the line's end
    std::string_view extension;  ///< usual ending of a file with such code
    /// Writes the code of an engine profile of the same name; null: the target is a language.
    std::string (*code)(const CodeInput&) = nullptr;
};

/// Returns all targets of the command `convert`, which writes shadow settings as code: engines, graphics APIs, GLSL and
/// C++.
std::span<const ConvertTarget> convert_targets();
/// Finds the target of a conversion by name, such as "three". @throws UsageError with the nearest name and all names
const ConvertTarget& convert_target(std::string_view name);

// Code templates, one function a file. Each returns code that sets the target's parameters to the converted numbers.
/// Formats converted shadow settings as JavaScript code for three.js.
std::string three_code(const CodeInput& in);
/// Formats converted shadow settings as JavaScript code for Babylon.js.
std::string babylon_code(const CodeInput& in);
/// Formats converted shadow settings as JavaScript code for PlayCanvas.
std::string playcanvas_code(const CodeInput& in);
/// Formats converted shadow settings as GDScript code for Godot 4.
std::string godot_code(const CodeInput& in);
/// Formats converted shadow settings as GDScript code for Godot 3.
std::string godot3_code(const CodeInput& in);
/// Formats converted shadow settings as C# code for Unity URP with the legacy depth bias.
std::string urp_code(const CodeInput& in);
/// Formats converted shadow settings as C# code for Unity URP with the slope-scale depth bias.
std::string urp_slope_code(const CodeInput& in);
/// Formats converted shadow settings as C# code for Unity HDRP.
std::string hdrp_code(const CodeInput& in);
/// Formats converted shadow settings as configuration lines (.ini) for Unreal Engine 5.
std::string unreal_code(const CodeInput& in);
/// Formats converted shadow settings as C++ code for Filament.
std::string filament_code(const CodeInput& in);
/// Formats converted shadow settings as C++ code for Filament 1.9.
std::string filament19_code(const CodeInput& in);
/// Formats converted shadow settings as Rust code for Bevy.
std::string bevy_code(const CodeInput& in);
/// Formats converted shadow settings as C++ code for O3DE.
std::string o3de_code(const CodeInput& in);
/// Formats converted shadow settings as C++ code for OGRE 1.12.
std::string ogre_code(const CodeInput& in);
/// Formats converted shadow settings as C code for OpenGL.
std::string opengl_code(const CodeInput& in);
/// Formats converted shadow settings as C code for Vulkan.
std::string vulkan_code(const CodeInput& in);
/// Formats converted shadow settings as C++ code for Direct3D 12.
std::string d3d12_code(const CodeInput& in);
/// Formats converted shadow settings as JavaScript code for WebGPU.
std::string webgpu_code(const CodeInput& in);

}  // namespace si
