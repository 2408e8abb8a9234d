#include "app/editor/picture_comparison.h"

#include <fmt/format.h>

#include <algorithm>

#include "app/editor/upload_picture.h"
#include "app/report/picture_comparison.h"

namespace si {
namespace {

constexpr const char* kLacksRays =
    "The other side's shadow is ray traced, and rays are traced for the settings shown alone: show that side itself, "
    "or compare the two by render --against";

}  // namespace

bool same_inputs(const FrameRequest& a, const FrameRequest& b) {
    return a.width == b.width && a.height == b.height && a.reference == b.reference && a.traced == b.traced &&
           a.light_maps == b.light_maps && a.map_camera == b.map_camera && a.with_look == b.with_look;
}

void EditorPictureComparison::clear() {
    hide();
    other_.reset();
    other_scene_ = 0;
    other_request_ = {};
}

void EditorPictureComparison::hide() {
    facts_.reset();
    difference_.reset();
}

void EditorPictureComparison::draw_other(const Scene& scene, const PictureState& state, const FrameRequest& request,
                                         const ComparisonFacts* comparison) {
    if (!comparison || comparison->with != state.compare) return;  // the settings are loaded with the next frame
    if (!comparison->problem.empty()) {
        facts_->problem = comparison->problem;
        return;
    }
    Settings settings = settings_with_shadows_of(state.settings, comparison->settings);
    settings.view.panes = Panes::One;
    const FrameRequest wanted{.width = request.width,
                              .height = request.height,
                              .map_camera = request.map_camera,
                              .with_look = request.with_look,
                              .reference = request.reference,
                              .traced = request.traced,
                              .light_maps = request.light_maps};
    const bool same = other_ && other_drawn_ == settings && other_scene_ == scene.id &&
                      same_inputs(other_request_, wanted) && (facts_->picture.texture || !other_problem_.empty());
    if (same) {
        facts_->problem = other_problem_;
        return;
    }
    if (!other_) other_ = std::make_unique<Renderer>();
    other_drawn_ = settings;
    other_scene_ = scene.id;
    other_request_ = wanted;
    facts_->picture = facts_->difference = {};  // a failure leaves no old picture either
    try {
        const FrameResult drawn = other_->render(scene, settings, wanted);
        const auto lacks = [](const auto& n) { return n.key != 0 && !n.met; };
        const bool rays = std::ranges::any_of(drawn.traced, lacks) || std::ranges::any_of(drawn.light_maps, lacks);
        other_problem_ = rays ? kLacksRays : "";
        if (!rays) facts_->picture = drawn.colour;
    } catch (const std::exception& e) {
        other_problem_ = e.what();  // reported once; the same settings are not tried again
        facts_->problem = other_problem_;
        throw;
    }
    facts_->problem = other_problem_;
}

void EditorPictureComparison::find_difference(Renderer& renderer, const FrameResult& frame) {
    const ByteImage a = renderer.read_colour(frame.colour), b = renderer.read_colour(facts_->picture);
    if (a.width != b.width || a.height != b.height) return;
    difference_ = upload_picture(difference_image(a, b));
    facts_->difference = {difference_.id(), a.width, a.height};
    facts_->mae = mean_difference(a, b);
}

bool EditorPictureComparison::update(Renderer& renderer, const Scene& scene, const PictureState& state,
                                     const FrameRequest& request, const FrameResult& frame, bool drawn,
                                     const ComparisonFacts* comparison) {
    const bool had = facts_.has_value();
    if (state.comparison.view == ComparisonView::Off) {
        // Maps of the pinned settings stay cached, because they are shown repeatedly.
        if (state.pinned)
            hide();
        else
            clear();
        return had;
    }
    const std::string label =
        state.comparison.reference ? "ray-traced reference" : compared_settings_name(state.compare);
    if (!had || facts_->label != label) {
        if (state.comparison.reference) other_.reset();
        facts_ = PictureComparisonFacts{.label = label};
    }
    const unsigned before = facts_->picture.texture;
    const bool known = before != 0;
    facts_->problem.clear();
    if (state.comparison.reference)
        facts_->picture = frame.true_colour;
    else
        draw_other(scene, state, request, comparison);
    const bool wants_difference = state.comparison.view == ComparisonView::Difference;
    const bool there = facts_->picture.texture != 0;
    if (!there || !wants_difference) {
        facts_->difference = {};
        difference_.reset();
    } else if (drawn || !known || !difference_ || before != facts_->picture.texture) {
        find_difference(renderer, frame);
        return true;
    }
    return drawn || there != known || !had;
}

}  // namespace si
