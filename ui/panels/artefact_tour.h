// Tour of the clusters of wrong pixels, largest first.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "renderer/measure/artefact_clusters.h"
#include "renderer/projection/camera.h"
#include "renderer/settings/settings.h"

namespace si {

/// Request to find clusters of wrong pixels in the shown picture, for the tour of wrong pixels (ArtefactTour). A wrong
/// pixel's shadow differs from the ray-traced reference. The request names the cause of the difference, such as acne.
struct ArtefactRequest {
    Artefact cause = Artefact::None;
    int number = 0;  ///< different for each request; 0: no request yet
};

/// Cluster of wrong pixels, with world position (metres) and normal of the surface point at the cluster's middle.
struct ArtefactSpot : ArtefactCluster {
    glm::dvec3 position_ws{0};
    glm::dvec3 normal_ws{0, 1, 0};
};

/// Clusters of wrong pixels of one picture, with the camera of the picture: the answer to an ArtefactRequest.
struct ArtefactSpots {
    int number = 0;                   ///< ArtefactRequest::number
    std::vector<ArtefactSpot> spots;  ///< largest first
    Camera camera;                    ///< camera of the picture
    int height = 0;                   ///< height of the picture, pixels
};

/// State of the tour of wrong pixels, in which the camera visits one cluster of wrong pixels after another. The
/// clusters are those of the picture in which the tour began.
struct ArtefactTour {
    std::optional<Artefact> cause;  ///< chosen cause; none: the most frequent one
    int waits_for = 0;              ///< number of the request that is not fulfilled yet; 0: none
    int asked = 0;                  ///< number of the last request
    ArtefactSpots of;
    std::size_t at = 0;       ///< index of the cluster that the camera was moved to last
    Settings left;            ///< settings after the last step; other settings restart the tour
    std::uint64_t scene = 0;  ///< Scene::id after the last step; another one restarts the tour
};

struct EditorState;
struct EditorFrame;

/// Returns the cause of error, such as acne, whose clusters of wrong pixels the tour (ArtefactTour) visits. It is the
/// user's choice, else the most frequent cause. Returns Artefact::None if errors are not known, or no pixel is wrong.
Artefact artefact_tour_cause(const EditorState& state, const EditorFrame& frame);
/// Chooses the cause of error, such as acne, for the tour of wrong pixels, and shows the artefact overlay. In the tour,
/// the camera visits one cluster of pixels wrong by this cause after another. A second call with the same cause hides
/// the overlay and clears the choice.
void toggle_tour_cause(EditorState& state, Artefact cause);
/// Moves the camera to the next cluster of wrong pixels and probes the pixel at the cluster's middle. If the clusters
/// are not known yet, requests them; follow_artefact_tour() then moves the camera.
void next_artefact(EditorState& state, const EditorFrame& frame);
/// Moves the camera to the first cluster of wrong pixels once the clusters that next_artefact() requested are known.
/// Call once a frame. Returns true while the tour waits for the clusters.
bool follow_artefact_tour(EditorState& state, const EditorFrame& frame);
/// Formats the position in the tour of wrong pixels: "acne, 2 of 7: 153 pixels". Returns "looking for it" while the
/// clusters of wrong pixels are not known, and an empty text when no cluster is shown.
std::string artefact_tour_text(const EditorState& state, const EditorFrame& frame);

}  // namespace si
