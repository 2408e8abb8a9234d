// Benchmarks of waiting times in the editor, drawn without a window: the longest frame of a first action, with and
// without a thread for frames, and of the second; and the first use of each tool. Each has an empty shader cache of its
// own.
#include <benchmark/benchmark.h>
#include <epoxy/gl.h>
#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <memory>
#include <thread>

#include "app/editor/headless_editor.h"
#include "app/editor/shader_warmup.h"
#include "renderer/base/error.h"
#include "renderer/render/renderer.h"
#include "renderer/settings/param.h"
#include "tests/bench/rounds.h"
#include "ui/scene_view/light_handles.h"

namespace si {
namespace {

namespace fs = std::filesystem;

/// Empty folder for Mesa's shader cache. The process keeps the folder of its first context, so the folder is emptied.
struct EmptyShaderCache {
    EmptyShaderCache() {
        static const fs::path folder = [] {
            const fs::path made = fs::temp_directory_path() / fmt::format("si-bench-shaders-{}", ::getpid());
            fs::create_directories(made);
            ::setenv("MESA_SHADER_CACHE_DIR", made.c_str(), 1);
            std::atexit([] { fs::remove_all(std::getenv("MESA_SHADER_CACHE_DIR")); });
            return made;
        }();
        for (const auto& entry : fs::recursive_directory_iterator(folder))
            if (entry.is_regular_file() && entry.path().filename() != "index") fs::remove(entry.path());
    }
};

/// Times of a first use, milliseconds.
struct Use {
    double took = 0;     ///< longest frame in which the mouse or a key acted, or of the two after
    double longest = 0;  ///< longest frame until everything was shown
    double until = 0;    ///< time from the beginning until everything was shown
};

struct Hands {
    EmptyShaderCache cache;
    double start_ms = 0;
    std::unique_ptr<HeadlessEditor> editor;

    /// Starts an editor. @param tab front tab at the start; empty: the first
    explicit Hands(bool apart, const std::string& tab = {}) {
        EditorOptions options;
        options.session.scene = "stage";
        options.headless = true;
        options.tab = tab;
        if (apart) options.frame_patience = kFramePatience;
        start_ms = wall_ms([&] {
            editor = std::make_unique<HeadlessEditor>(options);
            editor->model().finish_loading();
            while (!editor->model().facts().result) {
                frame();
                editor->model().finish_tracing();
            }
        });
        editor->settle();
    }
    /// Draws one frame of the editor to its end and returns its milliseconds.
    double frame() {
        return wall_ms([&] {
            editor->frame();
            glFinish();
        });
    }
    void settle() {
        editor->settle();
        if (const ShaderWarmup* r = editor->model().warmup()) r->wait();
        for (int i = 0; i < 4; ++i) frame();
    }
    /// Returns the longest frame until the effect of `act` is shown, while the mouse moves. @param until gets the sum
    /// of the frames
    double longest(const std::function<void()>& act, std::vector<double>* until = nullptr) {
        act();
        double ms = 0, shown_ms = 0;
        const auto begin = std::chrono::steady_clock::now();
        const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(20);
        for (int still = 0; still < 4 && std::chrono::steady_clock::now() < end;) {
            ms = std::max(ms, frame());
            still = editor->model().drawing() ? 0 : still + 1;
            if (still == 0 || shown_ms == 0) {
                shown_ms = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count();
            }
            if (editor->model().drawing()) std::this_thread::sleep_for(std::chrono::milliseconds(16));
        }
        if (until) until->push_back(shown_ms);
        return ms;
    }
    /// Performs one step a frame and waits for all results, rays too.
    Use use(const std::vector<std::function<void(Hands&)>>& steps) {
        Use u;
        const auto begin = std::chrono::steady_clock::now(), end = begin + std::chrono::seconds(20);
        const auto since_ms = [&] {
            return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count();
        };
        for (std::size_t i = 0; i < steps.size() + 2; ++i) {
            if (i < steps.size()) steps[i](*this);
            u.took = std::max(u.took, frame());
        }
        u.longest = u.took;
        u.until = since_ms();
        for (int still = 0; still < 4 && std::chrono::steady_clock::now() < end;) {
            const bool waits = editor->model().tracing() || state().artefact_tour.waits_for != 0;
            if (waits) std::this_thread::sleep_for(std::chrono::milliseconds(16));
            u.longest = std::max(u.longest, frame());
            still = waits ? 0 : still + 1;
            if (waits) u.until = since_ms();
        }
        return u;
    }
    /// Times a frame of an idle editor.
    double usual_ms() {
        std::vector<double> ms;
        for (int i = 0; i < 9; ++i) ms.push_back(frame());
        return median(ms);
    }
    EditorState& state() { return editor->model().state; }
    /// Returns handles of the shown light that take presses.
    std::vector<PlacedHandle> handles() {
        const FittedLight& fitted = editor->model().facts().result->lights[0];
        return place_handles(light_pose(state().settings.lights[0], fitted, 0), *state().viewport.view);
    }
    /// Returns a point on surfaces in the lower half of the scene's picture, as far from handles as possible.
    glm::vec2 free_place() {
        const PictureView& view = *state().viewport.view;
        const std::vector<PlacedHandle> taken = handles();
        glm::dvec2 best(0);
        double farthest = -1;
        for (const double x : {0.25, 0.35, 0.45, 0.55, 0.65, 0.75})
            for (const double y : {0.55, 0.65, 0.75}) {
                const glm::dvec2 at = view.origin + glm::dvec2(x, y) * view.size;
                double nearest = 1e9;
                for (const PlacedHandle& h : taken) nearest = std::min(nearest, glm::distance(at, h.on_screen));
                if (nearest > farthest) {
                    farthest = nearest;
                    best = at;
                }
            }
        return glm::vec2(best);
    }
};

/// First use of one tool.
struct Tool {
    using Step = std::function<void(Hands&)>;
    std::string name;
    std::vector<Step> steps;  ///< steps, one a frame
    Step before = {};         ///< preparing step, performed and waited for
    std::string tab = {};     ///< front tab at the start; empty: the first
};

void over_scene(Hands& h) {
    h.editor->mouse.at = h.free_place();
}
void over_map(Hands& h) {
    const ScreenRect& map = h.state().shots.map_rect;
    h.editor->mouse.at = map.lo + 0.5f * map.size;
}
Tool::Step left_button(bool down) {
    return [down](Hands& h) { h.editor->mouse.left = down; };
}
Tool::Step move_by(float x, float y) {
    return [x, y](Hands& h) { *h.editor->mouse.at += glm::vec2(x, y); };
}
/// Presses a key. The window's key codes equal ASCII.
Tool::Step hold_key(int code, bool down) {
    return [code, down](Hands&) { ImGui::GetIO().KeysDown[code] = down; };
}
Tool::Step hold_shift_and(int code, bool down) {
    return [code, down](Hands& h) { h.editor->mouse.shift = ImGui::GetIO().KeysDown[code] = down; };
}
/// Presses a key while the mouse is over the scene.
Tool press_key(const std::string& name, int code, Tool::Step before = over_scene) {
    return {.name = name, .steps = {hold_key(code, true), hold_key(code, false)}, .before = std::move(before)};
}
/// Moves the mouse to the handle that turns the light, or to another visible handle.
void over_handle(Hands& h) {
    const std::vector<PlacedHandle> all = h.handles();
    const auto turns = std::ranges::find(all, LightHandle::Direction, &PlacedHandle::handle);
    if (all.empty()) throw Error("no handle of the light is in the picture");
    h.editor->mouse.at = glm::vec2((turns == all.end() ? all.front() : *turns).on_screen);
}
void pin_and_change(Hands& h) {
    over_scene(h);
    h.state().pinned = PinnedSettings{h.state().settings, h.state().scene_name};
    h.state().settings.bias.normal += 1;
}
/// Shows a tab as a click does.
Tool::Step open_page(Page page) {
    return [page](Hands& h) { h.state().window.open_page = page; };
}

std::vector<Tool> all_tools() {
    constexpr int kF11 = 300;  // as the window feeds it (GLFW)
    std::vector<Tool> all = {
        {.name = "hover", .steps = {over_scene}},
        {.name = "probe", .steps = {left_button(true), left_button(false)}, .before = over_scene},
        {.name = "turn_camera",
         .steps = {left_button(true), move_by(9, 4), move_by(9, 4), left_button(false)},
         .before = over_scene},
        {.name = "zoom", .steps = {[](Hands& h) { h.editor->mouse.wheel = 1; }}, .before = over_scene},
        {.name = "drag_light",
         .steps = {left_button(true), move_by(8, -5), move_by(8, -5), left_button(false)},
         .before = over_handle},
        {.name = "hover_handle", .steps = {over_handle}},
        {.name = "hover_map", .steps = {over_map}},
        {.name = "zoom_map", .steps = {[](Hands& h) { h.editor->mouse.wheel = 1; }}, .before = over_map},
        press_key("loupe", 'G'),
        press_key("pin_a", 'P'),
        {.name = "flicker_to_a", .steps = {hold_key('A', true)}, .before = pin_and_change},
        press_key("compare_with_truth", 'B'),
        {.name = "compare_with_a",
         .steps = {[](Hands& h) {
             h.state().comparison = {.view = ComparisonView::SideBySide, .reference = false};
             h.state().compare = {CompareKind::Pinned, {}};
         }},
         .before = pin_and_change},
        press_key("freeze_view", 'K'),
        {.name = "through_light",
         .steps = {hold_shift_and('L', true), hold_shift_and('L', false)},
         .before = over_scene},
        press_key("frame_scene", 'F'),
        press_key("overlay_depth_difference", '4'),
        {.name = "overlay_artefacts",
         .steps = {hold_shift_and('3', true), hold_shift_and('3', false)},
         .before = over_scene},
        {.name = "two_panes",
         .steps = {[](Hands& h) { h.state().settings.view.panes = Panes::Two; }},
         .before = over_scene},
        press_key("next_artefact", 'X'),
        press_key("texel_quads", 'Q'),
        press_key("next_light_type", 'T'),
        press_key("twice_the_texels", ']'),
        press_key("no_bias", 'U'),
        press_key("map_elsewhere", 'N'),
        press_key("map_view", 'M'),
        press_key("scene_alone", kF11),
    };
    for (const PageRow& row : kPageTable)
        all.push_back({.name = fmt::format("tab_{}", row.key),
                       .steps = {open_page(row.page)},
                       .tab = row.page == Page::Settings ? "lights" : ""});
    return all;
}

/// Times a tool's first use in a fresh editor, compared with the usual frame: over_ms should be below 50.
void first_use(benchmark::State& state, const Tool& tool) {
    std::vector<double> usual, took, over, longest, until;
    for (auto _ : state) {
        Hands hands(true, tool.tab);
        hands.settle();
        try {
            if (tool.before) {
                tool.before(hands);
                hands.settle();
            }
        } catch (const Error& e) {
            return state.SkipWithError(e.what());
        }
        usual.push_back(hands.usual_ms());
        const Use use = hands.use(tool.steps);
        took.push_back(use.took);
        longest.push_back(use.longest);
        until.push_back(use.until);
        over.push_back(took.back() - usual.back());
        state.SetIterationTime(took.back() / 1000);
    }
    state.counters["usual_ms"] = median(usual);
    state.counters["took_ms"] = median(took);
    state.counters["over_ms"] = median(over);
    state.counters["over_worst_ms"] = *std::max_element(over.begin(), over.end());
    state.counters["longest_ms"] = median(longest);
    state.counters["until_ms"] = median(until);
}

/// Times each of a few kernels for the first time, then each again.
void switch_filter(benchmark::State& state, bool apart) {
    std::vector<double> first, again, until;
    for (auto _ : state) {
        Hands hands(apart);
        for (auto* ms : {&first, &again})
            for (const char* kernel : {"pcf5", "pcss", "vsm"}) {
                ms->push_back(hands.longest([&] { set_setting(hands.state().settings, "filter.kernel", kernel); },
                                            ms == &first ? &until : nullptr));
                if (ms == &first) state.SetIterationTime(first.back() / 1000);
            }
    }
    state.counters["first_ms"] = median(first);
    state.counters["until_ms"] = median(until);
    state.counters["first_worst_ms"] = *std::max_element(first.begin(), first.end());
    state.counters["again_ms"] = median(again);
    state.counters["again_worst_ms"] = *std::max_element(again.begin(), again.end());
}

/// Times the start until the first picture, then the first and second hover and click.
void first_touch(benchmark::State& state, bool apart) {
    std::vector<double> start, hover, hover_again, click, click_again, hover_until, click_until;
    for (auto _ : state) {
        Hands hands(apart);
        start.push_back(hands.start_ms);
        hands.settle();  // a person looks before touching
        const auto move = [&](float x) { return [&hands, x] { hands.editor->mouse.at = {x, 380.f}; }; };
        hover.push_back(hands.longest(move(700), &hover_until));
        hover_again.push_back(hands.longest(move(720)));
        const auto probe = [&](int x) { return [&hands, x] { hands.state().probe_pixel = glm::ivec2(x, 200); }; };
        click.push_back(hands.longest(probe(300), &click_until));
        click_again.push_back(hands.longest(probe(330)));
        state.SetIterationTime(start.back() / 1000);
    }
    state.counters["start_ms"] = median(start);
    state.counters["hover_ms"] = median(hover);
    state.counters["hover_again_ms"] = median(hover_again);
    state.counters["click_ms"] = median(click);
    state.counters["hover_until_ms"] = median(hover_until);
    state.counters["click_until_ms"] = median(click_until);
    state.counters["click_again_ms"] = median(click_again);
}

/// Times the editor's own work in processor time. A frame after the light turned, with each tab in front, minus the
/// renderer's time for the same picture. A frame without changes. The threads of an idle editor. Background work (rays,
/// the frontier's dot) is waited for; its part inside the measured frame counts.
void editor_overhead(benchmark::State& state) {
    Hands hands(false);
    std::vector<double> idle, over;
    double worst = 0;
    const auto taken = [](const auto& work) {
        const double before = processor_ms();
        work();
        glFinish();
        return processor_ms() - before;
    };
    for (auto _ : state) {
        Renderer alone;
        for (const PageRow& row : kPageTable) {
            hands.state().window.open_page = row.page;
            hands.state().probe_pixel = row.page == Page::Pixel ? std::optional(glm::ivec2(300, 200)) : std::nullopt;
            hands.settle();
            idle.push_back(taken([&] { hands.frame(); }));
            std::vector<double> own;
            for (int round = 0; round < 4; ++round) {
                hands.state().settings.lights[0].azimuth += 1;
                const double whole = taken([&] { hands.frame(); });
                hands.editor->model().finish_tracing();
                hands.editor->model().finish_measuring();
                const EditorFrame shown = hands.editor->model().facts();
                const FrameRequest request{.width = shown.result->colour.width, .height = shown.result->colour.height};
                const double bare = taken([&] { alone.render(*shown.scene, hands.state().settings, request); });
                if (round > 0) own.push_back(whole - bare);  // the first makes programs
            }
            over.push_back(median(own));
            worst = std::max(worst, over.back());
            state.counters[fmt::format("tab_{}_ms", row.key)] = over.back();
        }
        state.SetIterationTime(median(over) / 1000);
    }
    state.counters["idle_ms"] = median(idle);
    state.counters["over_ms"] = median(over);
    state.counters["over_worst_ms"] = worst;
    hands.settle();
    const double before = processor_ms();
    std::this_thread::sleep_for(std::chrono::seconds(1));
    state.counters["still_ms_a_second"] = processor_ms() - before;
}

const bool registered_hitches = [] {
    const auto add = [](const char* name, auto work) {
        benchmark::RegisterBenchmark(name, work)
            ->UseManualTime()
            ->Unit(benchmark::kMillisecond)
            ->Iterations(bench_rounds(3));
    };
    for (const bool apart : {false, true}) {
        add(apart ? "switch_filter/on_a_thread" : "switch_filter/at_once",
            [apart](benchmark::State& s) { switch_filter(s, apart); });
        add(apart ? "first_touch/on_a_thread" : "first_touch/at_once",
            [apart](benchmark::State& s) { first_touch(s, apart); });
    }
    add("editor_overhead", editor_overhead);
    for (const Tool& tool : all_tools())
        add(("first_use/" + tool.name).c_str(), [tool](benchmark::State& s) { first_use(s, tool); });
    return true;
}();

}  // namespace
}  // namespace si
