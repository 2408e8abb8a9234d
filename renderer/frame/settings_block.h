// Settings as shaders see them, made from the settings table: defines for choices of code, a uniform block for numbers.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "renderer/base/key.h"
#include "renderer/gl/program_cache.h"
#include "renderer/settings/param.h"
#include "renderer/settings/settings.h"

namespace si {

/// Returns the shader defines of all settings that select shader code: rows of the settings table with Cost::Program or
/// with choices. Each define has the setting's name and value, such as map_wrap 3.
std::vector<gl::Define> settings_defines(const Settings& s);
/// Returns GLSL text that declares the settings for shaders, independent of their values. The text has a define for
/// each choice, such as map_wrap_range with value 3, and a std140 block with a member for each numeric setting.
/// @param as_image true: the numbers are texels of a buffer image in place of block members
std::string settings_block_text(bool as_image);
/// Returns the contents of the uniform block (or buffer image) that holds numeric settings for shaders; a multiple of
/// 16 bytes.
std::vector<std::byte> settings_block_bytes(const Settings& s);
/// Adds the value of one setting to a cache key, so that a result depends on that setting.
void add_value(Key& key, const Settings& s, const SettingRef& ref);
/// Adds the values of all settings that shaders see to a cache key, except settings that no chosen technique reads.
void add_shader_settings(Key& key, const Settings& s);

}  // namespace si
