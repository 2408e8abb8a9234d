#include <fmt/format.h>

#include <charconv>

#include "app/commands/commands.h"
#include "app/headless_context.h"
#include "app/notes.h"
#include "app/report.h"
#include "app/views.h"
#include "renderer/error.h"
#include "renderer/param.h"
#include "renderer/renderer.h"

namespace si {
namespace {

/// The lectures' lit/shadow test, one step a line.
void print_light(const Probe::PerLight& p, const Settings& s) {
    fmt::print("\nlight {}", p.light);
    if (!p.casts) {
        fmt::print(": visibility {:.4g}\n  {}\n", p.visibility, p.verdict);
        return;
    }
    const char* const than = s.map.reversed_z ? (s.map.compare == int(Compare::Less) ? ">" : ">=")
                                              : (s.map.compare == int(Compare::Less) ? "<" : "<=");
    fmt::print(", map face {}\n", p.face);
    fmt::print("  1 light clip space   ({:.6g}, {:.6g}, {:.6g}, w {:.6g})\n", p.clip.x, p.clip.y, p.clip.z, p.clip.w);
    fmt::print("  2 divided by w       ({:.6g}, {:.6g}, {:.6g})\n", p.ndc.x, p.ndc.y, p.ndc.z);
    fmt::print("  3 in [0,1]           u {:.6g}  v {:.6g}  depth {:.8g}   ({})\n", p.uvd.x, p.uvd.y, p.uvd.z, p.where);
    fmt::print("  4 own depth          {:.8g}   = {:.6g} m from the light along its axis\n", p.own, p.own_m);
    fmt::print("  5 n.l                {:.6g}\n", p.n_dot_l);
    fmt::print("  6 bias               {:.6g} of depth = {:.4g} texels = {:.4g} m; normal offset {:.4g} m\n",
               p.bias_depth, p.bias_texels, p.bias_m, p.normal_offset_m);
    fmt::print("  7 compared depth     {:.8g}\n", p.compared);
    fmt::print("  8 stored depth       {:.8g}   = {:.6g} m, texel {},{} ({:.4g} m wide)\n", p.stored, p.stored_m,
               p.texel.x, p.texel.y, p.texel_m);
    const bool lit = s.map.reversed_z
                         ? (s.map.compare == int(Compare::Less) ? p.compared > p.stored : p.compared >= p.stored)
                         : (s.map.compare == int(Compare::Less) ? p.compared < p.stored : p.compared <= p.stored);
    fmt::print("  9 nearest texel      {:.8g} {} {:.8g} is {}\n", p.compared, than, p.stored,
               lit ? "true: lit" : "false: in shadow");
    fmt::print(" 10 kernel             visibility {:.4g}\n", p.visibility);
    fmt::print("  {}\n", p.verdict);
}

}  // namespace

std::pair<int, int> parse_pixel(const std::string& text, const PictureSize& size, const char* option) {
    int x = 0, y = 0;
    const char* const end = text.data() + text.size();
    const auto first = std::from_chars(text.data(), end, x);
    const bool has_comma = first.ec == std::errc() && first.ptr != end && *first.ptr == ',';
    const auto second = has_comma ? std::from_chars(first.ptr + 1, end, y) : first;
    if (!has_comma || second.ec != std::errc() || second.ptr != end) {
        throw UsageError(fmt::format("{} {}: X,Y from the top left is wanted, such as 640,360", option, text));
    }
    if (x < 0 || y < 0 || x >= size.width || y >= size.height) {
        throw UsageError(fmt::format("{} {}: outside of the picture of {} x {} pixels (0,0 to {},{})", option, text,
                                     size.width, size.height, size.width - 1, size.height - 1));
    }
    return {x, y};
}

void run_probe(const ProbeOptions& options) {
    const auto [x, y] = parse_pixel(options.pixel, options.size);
    const Session session = open_session(options.session);
    const HeadlessContext context;
    Renderer renderer;
    FrameRequest request;
    const PaneGrid grid = picture_grid(session.settings, options.size.width, options.size.height);
    const auto place = grid.at({x, y});
    if (!place) throw UsageError(fmt::format("--pixel {},{}: lies between two panes (view.panes)", x, y));
    request.width = grid.width, request.height = grid.height;
    Probe probe = renderer.probe(session.scene, session.settings, request, place->pixel.x, place->pixel.y);
    probe.x = x, probe.y = y;  // of the picture asked for, of which this pane is a part
    if (options.json) {
        fmt::print("{}", json_text(probe_json(probe)));
    } else if (!probe.hit) {
        fmt::print("pixel {},{}: nothing there\n", x, y);
    } else {
        fmt::print("pixel {},{}: {}\n", x, y, probe.object.empty() ? "(unnamed)" : probe.object);
        fmt::print("position ({:.6g}, {:.6g}, {:.6g}) m, normal ({:.4g}, {:.4g}, {:.4g})\n", probe.position_ws.x,
                   probe.position_ws.y, probe.position_ws.z, probe.normal_ws.x, probe.normal_ws.y, probe.normal_ws.z);
        for (const auto& light : probe.lights) print_light(light, session.settings);
    }
    print_notes(session.notes);
}

}  // namespace si
