// Preprocessor for GLSL: texts of shaders/ become plain code without directives, macros and unused declarations.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "renderer/gl/program_cache.h"

namespace si {

/// Returns the text that a GLSL compiler would see after preprocessing: directives carried out, macros replaced. Line
/// comments stay.
/// @param defines macros that are known before the first line @throws Error for a directive that is not closed
std::string preprocess_glsl(std::string_view text, std::span<const gl::Define> defines);

/// Returns the declarations of a preprocessed GLSL text that functions of these names need, in the order of the text,
/// each with its comment.
std::string used_glsl(std::string_view text, std::span<const std::string> roots);

/// Returns true when a GLSL text contains a name as a whole word outside comments.
bool names_in_code(std::string_view text, std::string_view name);

}  // namespace si
