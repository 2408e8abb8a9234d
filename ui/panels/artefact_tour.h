// From one cluster of wrong pixels to the next.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "renderer/measure/artefact_clusters.h"
#include "renderer/settings/settings.h"
#include "renderer/view/camera.h"

namespace si {

/// The clusters of a cause in the picture shown are asked for.
struct ArtefactRequest {
    Artefact cause = Artefact::None;
    int number = 0;  ///< another one for each wish; 0: none was made
};

/// A cluster, and where its surface is.
struct ArtefactSpot : ArtefactCluster {
    glm::dvec3 position_ws{0}, normal_ws{0, 1, 0};  ///< of its middle
};

struct ArtefactSpots {
    int number = 0;                   ///< of the wish
    std::vector<ArtefactSpot> spots;  ///< largest first
    Camera camera;                    ///< of the picture that they are in
    int height = 0;                   ///< of it, pixels
};

/// Which spot is shown. They are those of the picture in which the tour began.
struct ArtefactTour {
    std::optional<Artefact> cause;  ///< chosen; none: the most frequent one
    int waits_for = 0;              ///< number of the wish that is not fulfilled yet; 0: none
    int asked = 0;                  ///< number of the last wish
    ArtefactSpots of;
    std::size_t at = 0;
    Settings left;      ///< what the settings were after the last step: where others are shown, it begins anew
    std::string scene;  ///< the same
};

struct EditorState;
struct EditorFrame;

/// The cause whose clusters are shown: the one that was chosen, or the one that most pixels are wrong by. None where
/// nothing is known, or nothing is wrong.
Artefact touring_cause(const EditorState& state, const EditorFrame& frame);
/// Chooses the cause and has the picture show what is wrong; the same one again: neither.
void choose_cause(EditorState& state, Artefact cause);
/// Takes the camera to the next cluster and probes its middle, once it is known where it is.
void next_artefact(EditorState& state, const EditorFrame& frame);
/// Goes where it was waited to go. Call once a frame. Returns whether it is still waited for.
bool follow_artefact_tour(EditorState& state, const EditorFrame& frame);
/// "2 of 7: 153 pixels"; empty: none is shown.
std::string artefact_tour_text(const EditorState& state);

}  // namespace si
