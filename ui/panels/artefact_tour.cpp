#include "ui/panels/artefact_tour.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "renderer/measure/axes.h"
#include "renderer/reference/artefact_picture.h"
#include "renderer/reference/live_error.h"
#include "renderer/settings/overlays.h"
#include "renderer/view/cameras/make_camera.h"
#include "ui/scene_view/camera_gesture.h"
#include "ui/scene_view/camera_steering.h"
#include "ui/state/editor_ui.h"
#include "ui/state/quick_changes.h"

namespace si {
namespace {

constexpr double kShareOfHeight = 0.2;  ///< share of the picture's height that a cluster fills
constexpr double kClosest =
    0.25;  ///< smallest share of the former distance, so that the surroundings stay in the picture

int artefact_overlay() {
    const auto all = overlays();
    const auto it = std::ranges::find_if(all, [](const Overlay& o) { return o.names_causes; });
    return it == all.end() ? 0 : int(it - all.begin()) + 1;
}

std::string_view cause_label(Artefact cause) {
    for (const ArtefactStyle& style : artefact_styles())
        if (style.artefact == cause) return style.label;
    return "an unknown cause";
}

std::uint64_t scene_id(const EditorFrame& frame) {
    return frame.scene ? frame.scene->id : 0;
}

/// Returns true if the tour's clusters are those of the present picture and its shown light. Display aids (view.*) do
/// not matter.
bool is_of_present_picture(const EditorState& state, const EditorFrame& frame) {
    const ArtefactTour& tour = state.artefact_tour;
    return !tour.of.spots.empty() && tour.scene == scene_id(frame) &&
           measured_settings(tour.left) == measured_settings(state.settings);
}

/// Moves the camera towards a cluster along the ray of its pixel, so that no surface comes between.
void look_at_spot(CameraSettings& camera, const ArtefactSpots& of, const ArtefactSpot& spot) {
    const glm::ivec2 size = spot.last - spot.first + 1;
    const double closer =
        std::clamp(double(std::max(size.x, size.y)) / (kShareOfHeight * std::max(of.height, 1)), kClosest, 1.0);
    set_target(camera, spot.position_ws);
    if (of.camera.orthographic) {
        camera.height = of.camera.height * closer;
        return;
    }
    const glm::dvec3 back = of.camera.eye - spot.position_ws;
    const double distance = glm::length(back);
    if (!(distance > 0)) return;
    camera.azimuth = std::atan2(back.x, back.z) * 180 / std::numbers::pi;
    camera.elevation = std::asin(std::clamp(back.y / distance, -1.0, 1.0)) * 180 / std::numbers::pi;
    camera.distance = distance * closer;
}

/// Moves the camera by part of a pixel, so that the target lies in the middle of a pixel and is probed exactly.
void centre_on_pixel(EditorState& state, const EditorFrame& frame, const glm::dvec3& point) {
    if (!frame.scene || !frame.result) return;
    const Image& picture = frame.result->colour;
    const Camera made = make_camera(*frame.scene, state.settings, frame.result->camera.aspect);
    const PictureView view{made, {0, 0}, glm::dvec2(picture.width, picture.height), 1};
    const glm::dvec4 at = made.project(point, picture.width, picture.height);
    const glm::dvec2 off = glm::dvec2(at) - glm::round(glm::dvec2(at));
    const glm::dvec3 move = view.metres_per_pixel(point) * (off.x * made.axes[0] - off.y * made.axes[1]);
    CameraSettings& camera = state.settings.camera;
    set_target(camera, target_of(camera) + move);
}

/// Moves the camera to a cluster of the tour, probes its middle, and reports it in the log.
void go_to_spot(EditorState& state, const EditorFrame& frame, std::size_t at) {
    ArtefactTour& tour = state.artefact_tour;
    tour.at = at;
    const ArtefactSpot& spot = tour.of.spots[at];
    take_camera(state, frame);
    look_at_spot(state.settings.camera, tour.of, spot);
    centre_on_pixel(state, frame, spot.position_ws);
    // The probe follows the surface point into the new picture.
    state.probe_pixel = spot.pixel;
    state.probe_anchor = ProbeAnchor{spot.position_ws, spot.normal_ws, state.scene_name, spot.pixel};
    state.keyboard.probe_has_arrows = true;
    if (!state.shows(Page::Error)) show_pixel(state);
    tour.left = state.settings;
    tour.scene = scene_id(frame);
    state.log.add(LogKind::Info, "At " + artefact_tour_text(state, frame));
}

}  // namespace

Artefact artefact_tour_cause(const EditorState& state, const EditorFrame& frame) {
    if (state.artefact_tour.cause) return *state.artefact_tour.cause;
    if (!frame.error) return Artefact::None;
    Artefact most = Artefact::None;
    std::size_t pixels = 0;
    for (const ArtefactStyle& style : artefact_styles())
        if (const std::size_t n = frame.error->metrics.artefacts[std::size_t(style.artefact)]; n > pixels) {
            most = style.artefact;
            pixels = n;
        }
    return most;
}

void toggle_tour_cause(EditorState& state, Artefact cause) {
    ArtefactTour& tour = state.artefact_tour;
    const int overlay = artefact_overlay();
    if (tour.cause == cause && state.settings.view.overlay == overlay) {
        tour = {.asked = tour.asked};
        state.settings.view.overlay = 0;
        return;
    }
    if (tour.cause != cause) tour = {.cause = cause, .asked = tour.asked};
    state.settings.view.overlay = overlay;
}

void next_artefact(EditorState& state, const EditorFrame& frame) {
    ArtefactTour& tour = state.artefact_tour;
    if (!frame.result) return;
    if (tour.waits_for != 0)
        return state.log.add(LogKind::Info, "Still looking for where the picture is wrong: X again when it is found");
    if (is_of_present_picture(state, frame)) return go_to_spot(state, frame, (tour.at + 1) % tour.of.spots.size());
    tour.of = {};
    tour.waits_for = ++tour.asked;
    state.log.add(LogKind::Info, "Looking for where the picture is wrong …");
}

bool follow_artefact_tour(EditorState& state, const EditorFrame& frame) {
    ArtefactTour& tour = state.artefact_tour;
    if (tour.waits_for == 0) return false;
    const auto give_up = [&](const std::string& why) {
        state.log.add(LogKind::Info, why);
        tour.waits_for = 0;
        return false;
    };
    if (frame.reference && !frame.reference->problem.empty())
        return give_up("Where the picture is wrong is not known: " + frame.reference->problem);
    // Clusters need the reference of this picture.
    if (state.artefacts.number != tour.waits_for) {
        if (!frame.error) return true;
        const Artefact cause = artefact_tour_cause(state, frame);
        if (cause == Artefact::None) return give_up("No pixel of this picture is wrong");
        state.artefacts = {cause, tour.waits_for};
        return true;
    }
    if (!frame.artefacts || frame.artefacts->number != tour.waits_for) return true;
    tour.of = *frame.artefacts;
    tour.at = 0;
    if (tour.of.spots.empty())
        return give_up(fmt::format("No pixel of this picture is wrong by {}", cause_label(state.artefacts.cause)));
    tour.waits_for = 0;
    go_to_spot(state, frame, 0);
    return false;
}

std::string artefact_tour_text(const EditorState& state, const EditorFrame& frame) {
    const ArtefactTour& tour = state.artefact_tour;
    if (tour.waits_for != 0) return "looking for it";
    if (!is_of_present_picture(state, frame)) return {};
    const ArtefactSpot& spot = tour.of.spots[tour.at];
    return fmt::format("{}, {} of {}: {} pixel{}", cause_label(state.artefacts.cause), tour.at + 1,
                       tour.of.spots.size(), spot.pixels, spot.pixels == 1 ? "" : "s");
}

}  // namespace si
