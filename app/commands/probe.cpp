#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <cstdio>
#include <memory>
#include <utility>

#include "app/base/notes.h"
#include "app/base/output.h"
#include "app/commands/commands.h"
#include "app/commands/interruptible.h"
#include "app/context/headless_context.h"
#include "app/report/diagnosed_lights.h"
#include "app/report/fixes_json.h"
#include "app/report/health_report.h"
#include "app/report/probe_json.h"
#include "app/report/report.h"
#include "app/report/section_svg.h"
#include "app/report/views.h"
#include "renderer/base/command_text.h"
#include "renderer/base/error.h"
#include "renderer/base/lengths_text.h"
#include "renderer/inspect/lost_casters.h"
#include "renderer/reference/ray_scenes.h"
#include "renderer/reference/reference_scene.h"
#include "renderer/render/renderer.h"
#include "renderer/settings/param.h"

namespace si {
namespace {

/// Formats a number that may be infinite, as of a surface edge-on to the light. @param digits significant digits
std::string number_text(double value, int digits) {
    if (std::isfinite(value)) return fmt::format("{:.{}g}", value, digits);
    return value > 0 ? "infinite" : "-infinite";
}

/// Formats the kernel as a grid with one letter a tap, the map's top row first.
void print_taps(const Probe::PerLight& p) {
    if (p.taps.size() < 2) return;
    std::vector<std::string> rows(std::size_t(p.taps_size.y), std::string(2 * std::size_t(p.taps_size.x), ' '));
    for (const KernelTap& t : p.taps) {
        const glm::ivec2 at = t.texel - p.taps_first;
        rows[std::size_t(at.y)][2 * std::size_t(at.x) + 1] = t.lit ? '.' : t.meets == KernelTap::Meets::Own ? 'S' : '#';
    }
    for (std::size_t y = rows.size(); y-- > 0;)
        fmt::print("    {}{}\n", rows[y], y + 1 == rows.size() ? "    . lit, # in shadow, S self-shadowed" : "");
}

/// Prints the shadow test of a pixel, one step a line.
void print_light(const Probe::PerLight& p, const Settings& s) {
    fmt::print("\nlight {}", p.light);
    if (!p.casts) {
        fmt::print(": visibility {:.4g}\n  {}\n", p.visibility, p.verdict);
        return;
    }
    const LightReceiver& r = p.account.receiver;
    const bool strict = s.map.compare == Compare::Less, reversed = s.map.reversed_z;
    const char* const than = reversed ? (strict ? ">" : ">=") : (strict ? "<" : "<=");
    fmt::print(", {}\n", p.view.empty() ? "its only map" : p.view);
    fmt::print("  1 light clip space   ({:.6g}, {:.6g}, {:.6g}, w {:.6g})\n", r.clip.x, r.clip.y, r.clip.z, r.clip.w);
    fmt::print("  2 divided by w       ({:.6g}, {:.6g}, {:.6g})\n", r.ndc.x, r.ndc.y, r.ndc.z);
    fmt::print("  3 in [0,1]           u {:.6g}  v {:.6g}  depth {:.8g}   ({})\n", r.uvd.x, r.uvd.y, r.uvd.z,
               place_name(p.place));
    fmt::print("  4 own depth          {:.8g}   = {:.6g} m from the light along its axis\n", p.own, r.own_m);
    fmt::print("  5 N·L                {:.6g}\n", r.n_dot_l);
    fmt::print("  6 bias               {} of depth = {} texels = {} m; normal offset {:.4g} m\n",
               number_text(r.bias_depth, 6), number_text(p.bias_texels, 4), number_text(r.bias_m, 4),
               r.normal_offset_m);
    fmt::print("  7 compared depth     {}\n", number_text(p.compared, 8));
    fmt::print("  8 stored depth       {:.8g}   = {:.6g} m, texel {},{} ({:.4g} m wide)\n", p.stored, p.stored_m,
               p.texel.x, p.texel.y, r.texel_m);
    const auto [nearer, farther] =
        reversed ? std::pair(p.stored, p.compared_nearest) : std::pair(p.compared_nearest, p.stored);
    const bool lit = strict ? nearer < farther : nearer <= farther;
    fmt::print("  9 nearest texel      {} {} {:.8g} is {}\n", number_text(p.compared_nearest, 8), than, p.stored,
               lit ? "true: lit" : "false: in shadow");
    fmt::print(" 10 kernel             visibility {:.4g}{}\n", p.visibility,
               p.causes.has_contact ? ", with contact shadows" : "");
    if (!std::isnan(p.kernel.blocker_m))
        fmt::print("    occluder {:.4g} m before it along the light's axis: penumbra {} ({:.4g} m) wide\n",
                   p.kernel.blocker_m, texels_text(p.kernel.penumbra_texels), p.penumbra_m());
    if (!std::isnan(p.kernel.variance))
        fmt::print("    variance of depths {:.4g} of the map's range squared\n", p.kernel.variance);
    for (const std::string& line : p.kernel.lines) fmt::print("    {}\n", line);
    print_taps(p);
    if (const std::string_view text = engine_bias_text(p.engine_bias); !text.empty())
        fmt::print("    the engine's bias: {}\n", text);
    fmt::print("  {}\n", p.verdict);
}

/// Prints an amount of bias in texels, depth units and metres. @param endless text for an infinite amount
void print_amount(const char* name, const DepthShift& a, const char* about = "", const char* endless = "infinite") {
    if (std::isfinite(a.depth))
        fmt::print("    {:<23} {:>10.4g} texels {:>11.4g} m {:>12.5g} of depth   {}\n", name, a.texels, a.metres,
                   a.depth, about);
    else
        fmt::print("    {:<23} {:>10}                                       {}\n", name, endless, about);
}

void print_diagnosis(const Probe::PerLight& p, const PixelDiagnosis& d) {
    fmt::print("  verdict: {}\n", d.verdict);
    if (!p.casts || d.reference.state == PixelState::ShadowTerminator) return;
    const BiasBreakdown& a = p.account;
    fmt::print("  bias\n");
    print_amount("constant", a.amount(a.constant));
    print_amount("slope", a.amount(a.slope));
    if (a.bias_of_kind != 0)
        print_amount("of itself", a.amount(a.bias_of_kind), "bias that bias.kind itself adds, at any numbers");
    print_amount("normal offset", a.amount(a.normal));
    if (a.raster != 0)
        print_amount("while drawing", a.amount(a.raster),
                     "bias.raster_*, the least that a driver may add, and an engine's shift of casters");
    print_amount("have", d.has, "against acne");
    print_amount("needed", d.least, "of kernel, format, sub-pixel grid and single precision:");
    print_amount("  kernel", a.amount(a.least.kernel));
    print_amount("  format", a.amount(a.least.quantum));
    print_amount("  sub-pixel grid", a.amount(a.least.snapping));
    print_amount("  rounding", a.amount(a.least.rounding));
    print_amount("shift towards the light", d.shift, "a surface nearer than this is lost");
    print_amount("occluder", d.occluder, "the surface nearest the light: this much bias loses its shadow", "none");
    fmt::print("  reference: {}", d.reference.lit ? "lit" : "in shadow");
    if (d.reference.share > 0 && d.reference.share < 1)
        fmt::print(", {:.1f} % of the light seen (light.size)", 100 * d.reference.share);
    if (!std::isfinite(d.least.depth))
        fmt::print("; no bias window: the light sees the surface edge-on\n");
    else if (!std::isfinite(d.occluder.depth))
        fmt::print("; bias window [{:.4g}, no end) texels\n", d.least.texels);
    else
        fmt::print("; bias window [{:.4g}, {:.4g}) texels{}\n", d.least.texels, d.occluder.texels,
                   d.window_open() ? "" : ": empty");
}

/// Returns the casters between the probed point and a light that leave nothing in its map.
std::vector<LostCaster> lost_before(const Session& session, const Probe& probe, const Probe::PerLight& light) {
    return lost_casters_before(session.scene, lost_casters(session.scene, session.settings, light.fitted), light.fitted,
                               probe.position_ws);
}

/// Searches a fix of the probed pixel under view.light, if the pixel is wrong. Stops at the first one.
std::optional<FixTable> fixes(Renderer& renderer, const Session& session, const Probe& probe,
                              const std::vector<PixelDiagnosis>& found) {
    const auto light = std::size_t(std::max(session.settings.view.light, 0));
    if (light >= found.size() || !found[light].wants_fix()) return {};
    FixOptions options{.pixel = glm::ivec2(probe.x, probe.y), .first = true, .list = FixList::Whole};
    for (const auto& fix : {found[light].fix, found[light].fix_of_map})
        if (fix) options.more.push_back(suggested_candidate(*fix, session.settings));
    ReferenceCache cache;
    return interruptible("no change was tried", [&](const Workers& workers, const auto& report) {
        return find_fixes(
            {renderer, session.scene, probe.width, probe.height, cache, workers, report, session.engine.profile},
            session.settings, options);
    });
}

}  // namespace

std::pair<int, int> parse_pixel(const std::string& text, const PictureSize& size, const char* option) {
    int x = 0, y = 0;
    const char* const end = text.data() + text.size();
    const auto first = std::from_chars(text.data(), end, x);
    const bool has_comma = first.ec == std::errc() && first.ptr != end && *first.ptr == ',';
    const auto second = has_comma ? std::from_chars(first.ptr + 1, end, y) : first;
    if (!has_comma || second.ec != std::errc() || second.ptr != end)
        throw UsageError(fmt::format("{} {}: must be X,Y from the top left, such as 640,360", option, text));
    if (x < 0 || y < 0 || x >= size.width || y >= size.height)
        throw UsageError(fmt::format("{} {}: outside of the picture of {} x {} pixels; the last one is {},{}", option,
                                     text, size.width, size.height, size.width - 1, size.height - 1));
    return {x, y};
}

void run_probe(const ProbeOptions& options) {
    const auto [x, y] = parse_pixel(options.pixel, options.size);
    const std::string& section = options.output;
    if (!section.empty()) require_output(section, "the drawing", {".svg"});
    const Session session = open_session(options.session);
    const HeadlessContext context;
    Renderer renderer;
    const PaneGrid grid = picture_grid(session.settings, options.size.width, options.size.height);
    const auto place = grid.pane_at({x, y});
    if (!place) throw UsageError(fmt::format("--pixel {},{}: lies between two panes (view.panes)", x, y));
    FrameRequest request{.width = grid.width, .height = grid.height};
    ReferenceCache sources;
    trace_sources(renderer, session.scene, session.settings, request, sources, workers_with_progress());
    Probe probe = renderer.probe(session.scene, session.settings, request, place->pixel.x, place->pixel.y);
    std::vector<PixelDiagnosis> found;
    std::optional<FixTable> table;
    std::shared_ptr<const ReferenceScene> casters;
    if (options.reference && probe.hit) {
        casters = ray_scenes().get(ray_scenes().geometry(session.scene, session.settings));
        found = diagnose_lights(probe, session.scene, session.settings, renderer.driver(), *casters);
    }
    const auto find_fixes = [&] {  // uses the pixel within the pane
        if (options.reference && probe.hit && section.empty()) table = fixes(renderer, session, probe, found);
    };
    Probe shown = probe;
    shown.x = x;
    shown.y = y;  // pixel of the whole picture, as on the command line
    if (options.json) {
        find_fixes();
        nlohmann::ordered_json json = probe_json(shown, found, table ? table->fix() : nullptr);
        if (probe.hit && options.reference && section.empty()) {
            json["cures"] = table ? fixes_json(*table, session.engine) : nlohmann::ordered_json::array();
            json["cures_stopped"] = table && table->stopped;
        }
        if (session.engine.profile && table && table->fix())
            json["engine"] = engine_changes_json(session.engine, table->fix()->changes);
        fmt::print("{}", json_text(json));
    } else if (!probe.hit) {
        fmt::print("pixel {},{}: nothing there\n", x, y);
    } else {
        fmt::print("pixel {},{}: {}\n", x, y, probe.object.empty() ? "(unnamed)" : probe.object);
        fmt::print("position ({:.6g}, {:.6g}, {:.6g}) m, normal ({:.4g}, {:.4g}, {:.4g})\n", probe.position_ws.x,
                   probe.position_ws.y, probe.position_ws.z, probe.normal_ws.x, probe.normal_ws.y, probe.normal_ws.z);
        for (std::size_t i = 0; i < probe.lights.size(); ++i) {
            print_light(probe.lights[i], session.settings);
            if (i < found.size()) print_diagnosis(probe.lights[i], found[i]);
        }
        std::fflush(stdout);  // the search for fixes takes seconds
        find_fixes();
        if (table) print_fixes(*table, 8, session.engine);
    }
    print_notes(session.notes);
    for (const Probe::PerLight& light : probe.lights)
        print_notes(lost_caster_remarks(session.scene, lost_before(session, probe, light), light.light));
    if (!section.empty()) {
        if (!probe.hit)
            throw Error(
                fmt::format("{}: not written, as pixel {},{} shows no surface; name one that does", section, x, y));
        const auto light = std::size_t(std::max(session.settings.view.light, 0));
        if (light >= shown.lights.size())
            throw Error(fmt::format("view.light is {}: there is no such light to draw", light));
        write_file(section, section_svg(pixel_section(shown, light, found, session.settings, casters.get())));
    }
    if (options.check_numeric)
        require_sound(*search_numbers(renderer, session.scene, session.settings, request, workers_with_progress()));
    end_if_interrupted("not everything was tried");
}

}  // namespace si
