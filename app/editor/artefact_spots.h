// Where the wrong pixels of the editor's picture are, cluster by cluster.
#pragma once

#include "renderer/frame/renderer.h"
#include "ui/panels/artefact_tour.h"

namespace si {

/// Of the frame that `request` asks for, whose truth is in it, those of the cause that is wished for.
/// Draws that frame again, so that Renderer::holds() may no longer hold for others. @throws Error
ArtefactSpots find_artefact_spots(Renderer& renderer, const Scene& scene, const Settings& settings,
                                  const FrameRequest& request, const ArtefactRequest& wanted);

}  // namespace si
