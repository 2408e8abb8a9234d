#include <fmt/format.h>

#include "app/commands/commands.h"
#include "app/context/headless_context.h"
#include "app/report/report.h"
#include "renderer/base/large_pages.h"
#include "renderer/render/renderer.h"
#include "renderer/settings/param.h"

namespace si {

void run_info(const CommandOptions& options) {
    const HeadlessContext context;
    const Renderer renderer;
    const DriverInfo& d = renderer.driver();
    if (options.json) {
        nlohmann::ordered_json facts = {
            {"program", "shadow-inspector"}, {"version", SI_VERSION}, {"context", context.description()}};
        facts["memory_pages"] = memory_pages();
        facts["driver"] = driver_json(d);
        fmt::print("{}", json_text(facts));
        return;
    }
    fmt::print("shadow-inspector {}\n", SI_VERSION);
    fmt::print("context        {}\n", context.description());
    fmt::print("memory pages   {}\n", memory_pages());
    fmt::print("driver         {} ({})\n", d.renderer, d.vendor);
    fmt::print("OpenGL         {}, GLSL {}\n", d.version, d.glsl);
    fmt::print("kind           {}\n", d.software ? "a CPU rasteriser: times are not those of a GPU" : "hardware");
    fmt::print("clock          {} (queries show {:.0f} % of wall time)\n", d.clock, d.query_share * 100);
    fmt::print("limits         textures {0} x {0}, {1} samples, {2} sub-pixel bits\n", d.max_texture_size,
               d.max_samples, d.subpixel_bits);
    const auto formats = find_setting("map.format")->param->choices();
    for (std::size_t i = 0; i < formats.size(); ++i) {
        const PolygonOffset& o = d.offset[i];
        fmt::print("{:<15}{:<6} 1 unit is {}, slope by the {} (x {:.3f})\n", i == 0 ? "polygon offset" : "",
                   formats[i].key,
                   o.unit_depth > 0 ? fmt::format("{:.4g} of depth", o.unit_depth)
                                    : fmt::format("{:.4g} steps of depth", o.unit_steps),
                   o.slope_is_length ? "length" : "larger axis", o.slope_gain);
    }
    fmt::print("extensions     glPolygonOffsetClamp {}, anisotropic filtering {}\n",
               d.polygon_offset_clamp ? "yes" : "no", d.anisotropy ? "yes" : "no");
}

}  // namespace si
