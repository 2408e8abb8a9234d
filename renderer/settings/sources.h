// Table of visibility sources: the techniques that make a light's shadows (light.source).
#pragma once

#include <span>
#include <string_view>

#include "renderer/settings/param.h"
#include "renderer/settings/settings.h"

namespace si {

/// Data that a frame prepares for a visibility source. A source is the technique that makes a light's shadows
/// (light.source: shadow map, shadow volumes, traced rays, blobs, light map).
struct SourceNeeds {
    bool map = false;                 ///< shadow maps
    bool stencil = false;             ///< stencil buffer of its own
    bool counts_front_faces = false;  ///< the stencil counts faces before the surface (z-pass) instead of behind it
    bool camera_depth = false;        ///< camera's depth buffer
    bool reference = false;           ///< ray-traced visibility: FrameRequest::traced
    bool blobs = false;               ///< blob below each caster
    bool light_map = false;           ///< baked light map: FrameRequest::light_maps
};

/// Row of the table of visibility sources, the techniques that make a light's shadows (light.source). A source gives
/// the light's visibility, from 1 (lit) to 0 (in shadow), in one layer of the visibility texture.
struct Source {
    std::string_view key, label, help, paper;
    /// True: shading evaluates the source by itself. False: shading reads the visibility texture.
    bool fused = false;
    SourceNeeds needs;
    /// GLSL file below shaders/ with `float source_visibility(Surface s, int light)`. Empty: no shader evaluates the
    /// source; visibility is copied from traced rays, and is 1 without them.
    std::string_view file;
    std::span<const std::string_view> settings = {};  ///< setting keys that only this source reads
    /// Reason why the source's visibility is only an approximation; empty if it converges to the exact one.
    std::string_view approximation = {};
};

/// Returns all rows of the table of visibility sources, the techniques that make a light's shadows (light.source).
std::span<const Source> sources();

/// Returns the technique that makes the shadows of light number `light` (light.source), even if the light casts no
/// shadow.
const Source& source_of(const Settings& settings, int light);
/// Returns true when the source (technique of shadows) of any light that casts shadows needs `what`, for example
/// &SourceNeeds::map.
bool any_source_needs(const Settings& settings, bool SourceNeeds::*what);
/// Returns true when there are lights, but none gets its shadows from a shadow map (light.source). Settings of shadow
/// maps then have no effect.
bool no_source_is_map(const Settings& settings);

}  // namespace si
