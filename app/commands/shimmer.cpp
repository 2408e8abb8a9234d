#include "renderer/measure/shimmer.h"

#include <fmt/format.h>

#include "app/base/notes.h"
#include "app/base/output.h"
#include "app/commands/commands.h"
#include "app/commands/interruptible.h"
#include "app/context/headless_context.h"
#include "app/report/report.h"

namespace si {
namespace {

struct Measured {
    ShimmerVariant variant;
    Shimmer shimmer;
};

Json measured_json(const Measured& m) {
    return {{"variant", m.variant.key},
            {"places", m.shimmer.places},
            {"flips_a_step", m.shimmer.flips_a_step},
            {"most_flips", m.shimmer.max_flips},
            {"restless", m.shimmer.flipping_pixels},
            {"change", m.shimmer.change},
            {"flips", m.shimmer.flips}};
}

}  // namespace

void run_shimmer(const ShimmerCommandOptions& options) {
    const Session session = open_session(options.session);
    if (!options.output.empty()) require_writable(options.output);
    const HeadlessContext context;
    Renderer renderer;
    const auto measured = interruptible("nothing was printed", [&](const Workers& workers, const auto& report) {
        std::vector<Measured> out;
        for (const ShimmerVariant& variant : shimmer_variants(session.settings))
            out.push_back({variant, measure_shimmer(renderer, session.scene, variant.settings, options.size.width,
                                                    options.size.height, options.shimmer, workers,
                                                    [&](double share) { report(share, std::string(variant.label)); })});
        return out;
    });
    if (!options.output.empty()) {
        FloatImage picture = measured.front().shimmer.flips_of;
        for (float& flips : picture.data) flips /= float(std::max(options.shimmer.steps, 1));
        write_scalar_image(options.output, picture);
    }
    const ShimmerMotionRow& motion = shimmer_motions()[std::size_t(options.shimmer.motion)];
    if (options.json) {
        Json json = {{"format", "shadow-inspector-shimmer"}, {"version", 1},
                     {"scene", session.scene_name},          {"width", options.size.width},
                     {"height", options.size.height},        {"motion", motion.key},
                     {"steps", options.shimmer.steps},       {"step_texels", options.shimmer.step_texels}};
        for (const Measured& m : measured) json["variants"].push_back(measured_json(m));
        json["driver"] = driver_json(renderer.driver());
        fmt::print("{}", json_text(json));
    } else {
        fmt::print("{}, {} steps of {:g} texels, {} places on surfaces\n", motion.label, options.shimmer.steps,
                   options.shimmer.step_texels, measured.front().shimmer.places);
        fmt::print("  {:<26} {:>13} {:>11} {:>10} {:>22}\n", "", "flips per step", "at most", "flipping",
                   "visibility changes by");
        for (const Measured& m : measured)
            fmt::print("  {:<26} {:>13.2f} {:>11} {:>10} {:>22.3g}\n", m.variant.label, m.shimmer.flips_a_step,
                       m.shimmer.max_flips, m.shimmer.flipping_pixels, m.shimmer.change);
    }
    print_notes(session.notes);
}

}  // namespace si
