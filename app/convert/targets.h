// Table of the targets of a conversion. A new target is one row and one file with its code template.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "app/convert/code_text.h"

namespace si {

/// Target of a conversion: an engine, a graphics API or a language.
struct ConvertTarget {
    std::string_view name, title;
    std::string_view comment;    ///< beginning of a comment up to the line's end
    std::string_view extension;  ///< usual ending of a file with such code
    /// Writes the code of an engine profile of the same name; null: the target is a language.
    std::string (*code)(const CodeInput&) = nullptr;
};

/// Returns all targets.
std::span<const ConvertTarget> convert_targets();
/// Returns the conversion target with this name. @throws UsageError with the nearest name and all names
const ConvertTarget& convert_target(std::string_view name);

// Code templates, one function a file. Each returns code that sets the target's parameters to the converted numbers.
std::string three_code(const CodeInput& in);
std::string babylon_code(const CodeInput& in);
std::string playcanvas_code(const CodeInput& in);
std::string godot_code(const CodeInput& in);
std::string godot3_code(const CodeInput& in);
std::string urp_code(const CodeInput& in);
std::string urp_slope_code(const CodeInput& in);
std::string hdrp_code(const CodeInput& in);
std::string unreal_code(const CodeInput& in);
std::string filament_code(const CodeInput& in);
std::string filament19_code(const CodeInput& in);
std::string bevy_code(const CodeInput& in);
std::string o3de_code(const CodeInput& in);
std::string ogre_code(const CodeInput& in);
std::string opengl_code(const CodeInput& in);
std::string vulkan_code(const CodeInput& in);
std::string d3d12_code(const CodeInput& in);
std::string webgpu_code(const CodeInput& in);

}  // namespace si
