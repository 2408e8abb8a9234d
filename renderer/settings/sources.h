// The table of sources of visibility: where a light's shadows come from.
#pragma once

#include <span>
#include <string_view>

#include "renderer/settings/param.h"
#include "renderer/settings/settings.h"

namespace si {

/// What the frame brings for a source.
struct SourceNeeds {
    bool map = false;           ///< shadow maps
    bool stencil = false;       ///< a stencil buffer of its own
    bool before = false;        ///< in which it counts faces before the surface, not those behind it
    bool camera_depth = false;  ///< the depth that the camera sees
    bool reference = false;     ///< FrameRequest::traced
    bool blobs = false;         ///< a blob below each caster
    bool light_map = false;     ///< FrameRequest::light_maps
};

/// Where a light's visibility comes from: 1 lit to 0 in shadow, a layer of the visibility texture a light.
struct Source {
    std::string_view key, label, help, paper;
    /// Shading can evaluate it by itself; else it reads the visibility texture.
    bool fused = false;
    SourceNeeds needs;
    /// Below shaders/, with `float source_visibility(Surface s, int light)`. Empty: nothing is drawn for it. What rays
    /// found is copied as it is, else all is lit.
    std::string_view file;
    std::span<const std::string_view> settings = {};  ///< keys that it alone reads
    /// Why it does not tell where light reaches; empty: it does, as far as its samples do.
    std::string_view stands_for = {};
};

std::span<const Source> sources();
std::span<const Choice> source_choices();

/// Of light.<i>, whether that casts or not.
const Source& source_of(const Settings& settings, int light);
/// Whether the source of any light that casts has this need.
bool any_source_needs(const Settings& settings, bool SourceNeeds::*what);
/// Whether settings of shadow maps act on no light, as no light's source is a map.
bool no_source_is_map(const Settings& settings);

}  // namespace si
