#include "app/convert/measured_conversion.h"

#include <fmt/format.h>

#include <utility>

#include "renderer/base/error.h"
#include "renderer/base/printable.h"
#include "renderer/measure/measure.h"
#include "renderer/settings/param.h"
#include "renderer/view/fits/engine_facts.h"

namespace si {

MeasuredConversion measure_conversion(const SearchTools& whole, const Settings& settings, const std::string& scene_name,
                                      std::optional<CostCase> timed) {
    const SearchTools tools = whole.part();
    MeasuredConversion out;
    Settings tilt = settings;
    set_setting(tilt, "view.overlay", "n-dot-l");
    const FrameRequest request{.width = tools.width,
                               .height = tools.height,
                               .outputs = {.colour = false, .visibility = true, .overlay = true}};
    tools.report(0.1, "tilt of lit pixels");
    const FrameResult frame = tools.renderer.render(tools.scene, tilt, request);
    const FittedLight& light = frame.lights.at(std::size_t(settings.view.light));
    if (!light.casts)
        throw Error(fmt::format("{}: light {} has no shadow map: {}; choose another light or scene",
                                printable(scene_name), settings.view.light, light.reason));
    out.lookup = lookup_facts(settings, light, frame.map_size, tools.renderer.driver().subpixel_bits);
    out.facts = map_facts(&light, settings, frame.map_size);
    out.maps = converted_maps(settings, light, frame.map_size);
    out.angle_deg = reference_angle_deg(tools.renderer.read_float(frame.overlay, 4),
                                        tools.renderer.read_float(frame.visibility, 1));
    tools.report(0.2, "error");
    Measurer measurer(tools.renderer, tools.width, tools.height, tools.workers);
    const Classification classified = measurer.classify(tools.scene, settings);
    out.measure = {.scene = printable(scene_name, std::string::npos),
                   .width = tools.width,
                   .height = tools.height,
                   .area = settings.truth.area,
                   .mae = classified.error.mae,
                   .driver = tools.renderer.driver().renderer};
    out.measure.wrong = classified.error.false_shadow + classified.error.false_light;
    out.measure.acne_px = classified.error.artefacts[std::size_t(Artefact::Acne)];
    out.notes = classified.notes;
    if (timed) {
        tools.report(0.6, "time");
        const TimeMeasurement time = measurer.time(tools.scene, settings, *timed);
        out.measure.frame_ms = time.total_ms.median;
        out.measure.clock = time.clock;
    }
    return out;
}

std::string angle_source(const MeasuredConversion& measured) {
    return measured.angle_deg ? "95 % of the scene's lit pixels are tilted less" : "no pixel of the scene is lit";
}

}  // namespace si
