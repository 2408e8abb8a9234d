// Frames with the rays that they ask for: traced on the renderer's thread before they are drawn.
#pragma once

#include <optional>

#include "renderer/reference/reference_picture.h"
#include "renderer/render/renderer.h"

namespace si {

/// Collects the input for tracing a reference: draws the triangle ids of all pixels, and takes the scene's geometry
/// from ray_scenes() or the scene. Call on the renderer's thread.
/// @param light index of light.*. @throws Error when there is no such light, or as Renderer::render() does
ReferenceTask reference_task(Renderer& renderer, const Scene& scene, const Settings& settings,
                             const FrameRequest& request, int light, const ReferenceOptions& options = {});

/// Traces the shadows of all lights whose source (light.source) is ray tracing or a light map, unless `request`,
/// `cache` or light_maps() has them. Returns true when there is such a light.
/// @param request receives the results, for the next frame @throws Cancelled, Error
bool trace_sources(Renderer& renderer, const Scene& scene, const Settings& settings, FrameRequest& request,
                   ReferenceCache& cache, const Workers& workers = {});

/// Draws a frame with its reference, and with the ray-traced lights of trace_sources(): traces them unless `request` or
/// `cache` has them.
/// @param request receives the reference, for the next frame
/// @param options override reference_options() of the settings
/// @throws Cancelled, Error
FrameResult render_with_reference(Renderer& renderer, const Scene& scene, const Settings& settings,
                                  FrameRequest& request, ReferenceCache& cache, const Workers& workers = {},
                                  const std::optional<ReferenceOptions>& options = {});

}  // namespace si
