// Description of a drawn frame: images, ranges in use, camera, lights.
#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "renderer/reference/live_error.h"
#include "renderer/render/renderer_impl.h"
#include "renderer/settings/filters.h"
#include "renderer/settings/map_storage.h"

namespace si {
namespace {

void describe_panes(const FrameState& f, PanePasses& panes, FrameResult& result) {
    const Outputs& o = f.request.outputs;
    for (const FrameState::ShownPane& shown : f.panes) {
        Pane pane{.overlay = shown.overlay, .lacks_reference = shown.lacks_reference};
        if (o.colour) pane.picture = image_of(f.result(f.pane_picture_result(shown)));
        if (shown.row()) {
            if (o.colour || o.overlay) pane.values = image_of(f.result({Result::Overlay, shown.slot}));
            const ValueRange range = panes.range_of(f, shown);
            pane.tinted = o.colour && f.tints(shown);
            pane.overlay_min = range.min;
            pane.overlay_max = range.max;
        }
        result.panes.push_back(pane);
    }
    const Pane& first = result.panes.front();
    result.colour = first.picture;
    result.overlay = first.values;
    result.overlay_min = first.overlay_min;
    result.overlay_max = first.overlay_max;
}

void describe_map_view(FrameState& f, const MapViewPasses& map_view, FrameResult& result) {
    const ViewSettings& v = f.settings.view;
    const bool camera = v.map_source == MapSource::Camera;
    const int faces = camera ? 1 : int(f.gl.fitted[std::size_t(v.light)].views.size());
    result.shown_map = {v.map_source, v.light, std::clamp(v.face, 0, faces - 1)};
    if (const int channel = shown_channel(f.settings); channel > 0) {
        result.shown_map.channel = channel;
        result.shown_map.name = filter_of(f.settings).moments.names[std::size_t(channel - 1)];
        result.shown_map.mip = f.shown_mip();
    }
    result.map_view = image_of(f.result(Result::MapView));
    result.map_view_size = camera ? glm::ivec2(f.request.width, f.request.height) : f.map_size.sides();
    result.shown_map.texels = glm::max(result.map_view_size >> result.shown_map.mip, 1);
    result.map_view_curve = *f.shown_curve();
    const glm::vec2 greys = map_view.grey_range(f);
    result.map_fitted = f.fits_grey_range();
    result.map_black = greys.x;
    result.map_white = greys.y;
}

}  // namespace

void RendererImpl::describe_frame(FrameState& f, FrameResult& result) {
    std::set<Result> made;
    for (std::size_t i = 0; i < result.passes.size(); ++i)
        if (result.passes[i].state != PassState::Skipped)
            for (const ResultRef& of : f.plan.passes()[i].writes) made.insert(of.what);
    const auto put = [&](Result of, Image& image) {
        if (made.contains(of)) image = image_of(f.result(of));
    };
    result.contacts_darkened = f.request.outputs.colour && f.studio;
    describe_panes(f, passes.panes, result);
    if (made.contains(Result::MapView)) describe_map_view(f, passes.map_view, result);
    if (made.contains(Result::Visibility)) result.visibility = passes.visibility.layer_image(f.settings.view.light);
    if (made.contains(Result::Error)) result.error = passes.reference.error();
    if (result.error && made.contains(Result::Flip)) {
        LiveError error = *result.error;
        error.metrics.flip = passes.flip.mean();
        result.error = std::make_shared<const LiveError>(error);
    }
    if (made.contains(Result::Precision)) result.precision = passes.precision.found();
    if (made.contains(Result::Evidence)) {
        for (std::size_t i = 0; i < result.evidence.size(); ++i)
            result.evidence[i] = image_of(f.result(Result::Evidence, i));
        result.mask_levels = f.mask_levels;
    }
    put(Result::Smooth, result.smooth);
    put(Result::Compared, result.classified);
    put(Result::Classified, result.classified);
    put(Result::ReferenceLitPicture, result.true_colour);
    put(Result::SurfaceIds, result.surface_ids);
    put(Result::TexelsRead, result.texels_read);
    put(Result::MapCoordinates, result.map_coordinates);
    if (f.paged && made.contains(Result::ShadowMaps)) {
        const PassInfo* pages = result.pass(Result::Pages);
        result.pages = passes.pages.page_facts(pages && pages->state == PassState::Drawn);
        if (result.pages->coarser > 0)
            f.notes.push_back(
                fmt::format("map.page_pool of {} pages is full: coarser pages replace {} of {}; raise it, or "
                            "map.virtual_bias",
                            f.settings.map.page_pool, result.pages->coarser, result.pages->wanted));
    }
    result.reference = f.reference;
    result.traced = f.traced;
    result.light_maps = f.light_maps;
    result.camera = f.camera;
    result.lights = f.gl.fitted;
    result.imported = f.request.imported;
    result.notes = std::move(f.notes);
    result.map_resolution = f.map_size.longest();
    result.map_size = f.map_size;
    result.map_holds_distances = holds_distances(f.settings.map.format);
    result.maps_are_whole = f.maps_are_whole;
}

}  // namespace si
