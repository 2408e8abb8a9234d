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

/// Returns a define for each setting that selects shader code (Cost::Program rows): "map_wrap" 3.
std::vector<gl::Define> settings_defines(const Settings& s);
/// Returns GLSL text that declares the settings for shaders, independent of their values. It has a define per choice
/// ("map_wrap_range" 3) and a member of a std140 block per other setting.
/// @param as_image true: the numbers are texels of a buffer image in place of block members
std::string settings_block_text(bool as_image);
/// Returns the contents of the settings block or image for these settings; a multiple of 16 bytes.
std::vector<std::byte> settings_block_bytes(const Settings& s);
/// Adds to `key` the value of one setting.
void add_value(Key& key, const Settings& s, const SettingRef& ref);
/// Adds to `key` the value of every setting that shaders see.
void add_shader_settings(Key& key, const Settings& s);

}  // namespace si
