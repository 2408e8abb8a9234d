// Frames with the rays that they ask for: traced on the renderer's thread before they are drawn.
#pragma once

#include <optional>

#include "renderer/reference/reference_picture.h"
#include "renderer/render/renderer.h"

namespace si {

/// Draws which triangle each pixel shows, and shares the scene's triangles unless ray_scenes() have them already.
/// @param light index of light.*. @throws Error when there is no such light, or as Renderer::render() does
ReferenceTask reference_task(Renderer& renderer, const Scene& scene, const Settings& settings,
                             const FrameRequest& request, int light, const ReferenceOptions& options = {});

/// Traces what lights need whose source is ray traced or a light map, unless `request`, `cache` or light_maps() has it.
/// Returns whether any does.
/// @param request keeps what was traced for the next frame @throws Cancelled, Error
bool trace_sources(Renderer& renderer, const Scene& scene, const Settings& settings, FrameRequest& request,
                   ReferenceCache& cache, const Workers& workers = {});

/// Draws a frame that has all rays it asks for, those of trace_sources() too: traced unless `request` or `cache` has
/// them.
/// @param request keeps the truth for the next frame
/// @param options in place of reference_options() of the settings
/// @throws Cancelled, Error
FrameResult render_with_reference(Renderer& renderer, const Scene& scene, const Settings& settings,
                                  FrameRequest& request, ReferenceCache& cache, const Workers& workers = {},
                                  const std::optional<ReferenceOptions>& options = {});

}  // namespace si
