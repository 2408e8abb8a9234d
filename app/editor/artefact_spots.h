// Clusters of wrong pixels in the editor's picture.
#pragma once

#include "renderer/render/renderer.h"
#include "ui/panels/artefact_tour.h"

namespace si {

/// Finds the clusters of the wanted cause in the frame of `request`, which holds its ray-traced reference. Draws that
/// frame again: the renderer no longer holds the images of other frames (Renderer::has_images_of()). @throws Error
ArtefactSpots find_artefact_spots(Renderer& renderer, const Scene& scene, const Settings& settings,
                                  const FrameRequest& request, const ArtefactRequest& wanted);

}  // namespace si
