// Preprocessor for GLSL: texts of shaders/ become plain code without directives, macros and unused declarations.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "renderer/gl/program_cache.h"

namespace si {

/// Preprocesses a GLSL text as a compiler does: carries out directives and replaces macros. Line comments stay. Used to
/// export shaders as plain code.
/// @param defines macros that are known before the first line
/// @throws Error for a condition that cannot be read, and for #if, #else or #endif without counterpart
std::string preprocess_glsl(std::string_view text, std::span<const gl::Define> defines);

/// Extracts from a preprocessed GLSL text the declarations that some functions need, directly or indirectly. They keep
/// their order and comments.
/// @param roots names of the functions, which are extracted too
std::string used_glsl(std::string_view text, std::span<const std::string> roots);

/// Returns true if a GLSL text contains `name` as a whole word outside comments.
bool names_in_code(std::string_view text, std::string_view name);

}  // namespace si
