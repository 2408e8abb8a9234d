// What a person waits for in the editor, drawn without a window: the longest frame of the editor while something is
// done for the first time, with frames drawn on a thread of their own and without, and when it is done again. Each with
// an empty shader cache of its own.
#include <benchmark/benchmark.h>
#include <epoxy/gl.h>
#include <fmt/format.h>

#include <cstdlib>
#include <filesystem>
#include <thread>

#include "app/editor/headless_editor.h"
#include "app/editor/rehearsals.h"
#include "renderer/frame/renderer.h"
#include "renderer/settings/param.h"
#include "tests/bench/rounds.h"

namespace si {
namespace {

namespace fs = std::filesystem;

/// Mesa keeps what it compiled in a folder, by which the process goes from its first context on. Emptied, it has
/// nothing.
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

struct Hands {
    EmptyShaderCache cache;
    double start_ms = 0;
    std::unique_ptr<HeadlessEditor> editor;

    explicit Hands(bool apart) {
        EditorOptions options;
        options.session.scene = "stage";
        options.headless = true;
        if (apart) options.frame_patience = kFramePatience;
        start_ms = wall_ms([&] {
            editor = std::make_unique<HeadlessEditor>(options);
            editor->model().finish_loading();
            while (!editor->model().facts().result) frame(), editor->model().finish_tracing();
        });
        editor->settle();
    }
    /// One of the editor's, finished.
    double frame() {
        return wall_ms([&] {
            editor->frame();
            glFinish();
        });
    }
    void settle() {
        editor->settle();
        if (const Rehearsals* r = editor->model().rehearsals()) r->wait();
        for (int i = 0; i < 4; ++i) frame();
    }
    /// The longest frame until what `act` changed is shown, while a mouse moves. @param until adds how long that took
    double longest(const std::function<void()>& act, std::vector<double>* until = nullptr) {
        act();
        double ms = 0, shown_ms = 0;
        const auto begin = std::chrono::steady_clock::now();
        const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(20);
        for (int still = 0; still < 4 && std::chrono::steady_clock::now() < end;) {
            ms = std::max(ms, frame());
            still = editor->model().drawing() ? 0 : still + 1;
            if (still == 0 || shown_ms == 0)
                shown_ms = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count();
            if (editor->model().drawing()) std::this_thread::sleep_for(std::chrono::milliseconds(16));
        }
        if (until) until->push_back(shown_ms);
        return ms;
    }
    EditorState& state() { return editor->model().state; }
};

/// The first time, each kernel of a few; then each again.
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

/// From nothing to the first picture; then the first and the second hover and click in the picture.
void first_touch(benchmark::State& state, bool apart) {
    std::vector<double> start, hover, hover_again, click, click_again, hover_until, click_until;
    for (auto _ : state) {
        Hands hands(apart);
        start.push_back(hands.start_ms);
        hands.settle();  // a person who looks before touching
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

/// The editor's own work: a frame in which the light turned, with each tab in front, less the same picture drawn by a
/// renderer alone; a frame in which nothing changes; and what a still editor's threads take while nobody asks for a
/// frame. Processor time. What follows in the background (rays, the frontier's dot) is waited for, and not counted.
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
        for (const BottomTab tab :
             {BottomTab::Effects, BottomTab::Probe, BottomTab::Objects, BottomTab::Compare, BottomTab::Log}) {
            hands.state().open_tab = tab;
            hands.state().probe_pixel = tab == BottomTab::Probe ? std::optional(glm::ivec2(300, 200)) : std::nullopt;
            hands.settle();
            idle.push_back(taken([&] { hands.frame(); }));
            std::vector<double> own;
            for (int round = 0; round < 4; ++round) {
                hands.state().settings.lights[0].azimuth += 1;
                const double whole = taken([&] { hands.frame(); });
                const EditorFrame shown = hands.editor->model().facts();
                const FrameRequest request{.width = shown.result->colour.width, .height = shown.result->colour.height};
                const double bare = taken([&] { alone.render(*shown.scene, hands.state().settings, request); });
                if (round > 0) own.push_back(whole - bare);  // the first makes programs
            }
            over.push_back(median(own));
            worst = std::max(worst, over.back());
            state.counters[fmt::format("tab_{}_ms", int(tab))] = over.back();
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
    return true;
}();

}  // namespace
}  // namespace si
