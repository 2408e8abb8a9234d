#include "renderer/inspect/grey_range.h"

#include <fmt/format.h>

#include "renderer/base/lengths_text.h"

namespace si {

std::string grey_value_text(const ViewSettings& view, const FrameResult& frame, double value) {
    const DepthCurve& curve = frame.map_view_curve;
    const bool moment = frame.shown_map.channel > 0;
    if (moment && view.map == MapView::Raw) return digits_text(value);
    if (moment || view.map == MapView::Linear) return metres_text(curve.near + value * (curve.far - curve.near));
    return fmt::format("{} ({})", digits_text(value), metres_text(curve.curve_at_row(0.5).distance(value)));
}

std::string grey_range_text(const ViewSettings& view, const FrameResult& frame) {
    if (view.map == MapView::Bands) return "bands have colours of their own, and no range of greys";
    return fmt::format("contrast from {} (black) to {} (white), {}", grey_value_text(view, frame, frame.map_black),
                       grey_value_text(view, frame, frame.map_white),
                       frame.map_fitted ? "fitted to the stored depths" : "by view.map_black and view.map_white");
}

}  // namespace si
