// The settings as shaders see them, made from the table: defines for what chooses code, a uniform block for the rest.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "renderer/base/key.h"
#include "renderer/gl/program_cache.h"
#include "renderer/settings/param.h"
#include "renderer/settings/settings.h"

namespace si {

/// One define per Cost::Program row that shaders see ("map_wrap" 3).
std::vector<gl::Define> settings_defines(const Settings& s);
/// GLSL text that is the same under all settings: a define per choice ("map_wrap_range" 3), and every other row that
/// shaders see by its name, as a member of a std140 block or as a number of an image's texels.
std::string settings_block_text(bool as_image);
/// What the block or the image holds; a multiple of 16 bytes.
std::vector<std::byte> settings_block_bytes(const Settings& s);
/// Adds the value of every setting that shaders see.
void add_shader_settings(Key& key, const Settings& s);

/// Adds what a kind of pass reads itself of the settings, but for those without effect.
void add_settings(Key& key, const Settings& s, ReadBy pass);

}  // namespace si
