// Clusters of wrong pixels in the editor's picture.
#pragma once

#include "renderer/render/renderer.h"
#include "ui/panels/artefact_tour.h"

namespace si {

/// Finds clusters of wrong pixels of one cause in the editor's picture. Draws the frame of `request` once more, so that
/// the renderer drops the images of other frames (Renderer::has_images_of()). @param request frame with its ray-traced
/// reference @param wanted cause to look for @throws Error
ArtefactSpots find_artefact_spots(Renderer& renderer, const Scene& scene, const Settings& settings,
                                  const FrameRequest& request, const ArtefactRequest& wanted);

}  // namespace si
