// Frames that need ray-traced data: rays are traced first, then the frame is drawn.
#pragma once

#include <optional>

#include "renderer/reference/reference_picture.h"
#include "renderer/render/renderer.h"

namespace si {

/// Collects the input for tracing the ray-traced reference of a frame. Draws the triangle numbers of all pixels, and
/// takes the scene's geometry from the cache ray_scenes(). Call on the renderer's thread; the task itself may run on
/// another thread.
/// @param light index of the light in the settings light.*
/// @throws Error when there is no such light, or as Renderer::render() does
ReferenceTask reference_task(Renderer& renderer, const Scene& scene, const Settings& settings,
                             const FrameRequest& request, int light, const ReferenceOptions& options = {});

/// Traces the shadows of all lights whose source (light.source) is ray tracing or a light map, unless `request`,
/// `cache` or light_maps() has the results already. Returns true if any light has such a source.
/// @param[in,out] request receives the results, for the next frame
/// @throws Cancelled, Error
bool trace_sources(Renderer& renderer, const Scene& scene, const Settings& settings, FrameRequest& request,
                   ReferenceCache& cache, const Workers& workers = {});

/// Draws a frame with all ray-traced data that it needs: traced lights, light maps and the ray-traced reference. Traces
/// the data that `request` and `cache` lack. Blocks until all rays are traced.
/// @param[in,out] request receives the reference, for the next frame
/// @param options options of the reference, which is then traced in any case; nullopt: reference_options() of the
/// settings
/// @throws Cancelled, Error
FrameResult render_with_reference(Renderer& renderer, const Scene& scene, const Settings& settings,
                                  FrameRequest& request, ReferenceCache& cache, const Workers& workers = {},
                                  const std::optional<ReferenceOptions>& options = {});

}  // namespace si
