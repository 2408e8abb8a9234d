// Runs sweeps over a meter with made-up results, for tests without a GPU.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "app/report/measure_json.h"
#include "app/sweep/journal.h"
#include "app/sweep/results.h"
#include "app/sweep/runner.h"
#include "renderer/base/error.h"
#include "tests/support/number_at.h"

namespace si {

namespace fs = std::filesystem;

/// Meter of sweep cases that draws nothing. The error falls and the time grows with the map resolution.
struct FakeMeter : CaseMeter {
    std::string run_id = "first";
    std::string machine = "m";
    int fails_at_resolution = 0;        ///< map resolution at which facts() throws; 0: none
    int max_resolution = 1 << 30;       ///< limit of the reported map resolution, texels
    double drift = 1;                   ///< factor of all times; grows by 5 % per sample
    std::vector<std::string> measured;  ///< case ids passed to facts(), in order
    std::vector<std::string> timed;     ///< case ids passed to time(), in order
    /// Returns the made-up description of the machine and the run.
    RunInfo run() override { return {run_id, "2026-01-01T00:00:00Z", machine, "driver", "1", "clock", true, 0}; }
    /// Returns made-up error and cost of a sweep case. @throws Error at `fails_at_resolution`
    DrawnCase facts(const SweepCase& c) override {
        measured.push_back(c.id);
        const int n = c.settings.map.resolution;
        if (n == fails_at_resolution) throw Error("no memory for\nthis map");
        DrawnCase f;
        f.notes = {"a note"};
        f.picture_jpg = "jpg";
        f.artefacts_png = "png";
        if (n > max_resolution) {
            f.map_resolution = max_resolution;
            f.notes.push_back("smaller, for reasons");
        }
        f.error.metrics.mae = 100.0 / n;
        f.cost.map_texels = std::uint64_t(n) * std::uint64_t(n);
        f.cost.bytes_touched = 4 * f.cost.map_texels;
        return f;
    }
    /// Returns `frames` made-up times of a sweep case, milliseconds.
    CaseTimes time(const SweepCase& c, int frames, CostCase, ShadowFrames) override {
        timed.push_back(c.id);
        TimeSamples s;
        for (int i = 0; i < frames; ++i) {
            drift *= 1.05;
            s.total_ms.push_back(drift * c.settings.map.resolution);
            s.maps_ms.push_back(1);
        }
        s.clock = "clock";
        return {s};
    }
};

/// Sweep of eight cases (four map resolutions, two kernels) whose journal lies in a folder.
struct FakeSweep {
    fs::path folder;
    std::vector<SweepAxis> axes = {parse_axis("map.resolution=256:2048:*2"), parse_axis("filter.kernel=hard,pcf3")};
    SweepPlan plan = plan_sweep(Settings{}, axes);
    SweepSpec spec;
    /// Plans the sweep. @param f folder of the journal
    explicit FakeSweep(fs::path f) : folder(std::move(f)) {
        spec.scene = "stage";
        spec.axes = axes;
        spec.width = 8;
        spec.height = 8;
    }
    /// Returns the sweep's description as the journal stores it.
    nlohmann::ordered_json spec_text() const { return spec_json(spec); }
    /// Runs at most `steps` steps of the sweep, from the journal's state.
    /// @param retry repeats failed cases
    /// @returns the journal's state after the run
    SweepState run(FakeMeter& meter, int steps = 10'000, SweepTiming timing = {.rounds = 4}, bool retry = false) const {
        Journal journal(folder, spec_text(), plan_key(plan));
        SweepRunner runner(plan, spec.shard, timing, retry, meter, journal, folder);
        while (steps-- > 0 && runner.step()) {
        }
        return journal.state();
    }
    /// Runs the whole sweep without times, with a meter of its own. @returns the meter with what it measured
    FakeMeter measure() const {
        FakeMeter meter;
        run(meter, 10'000, {.on = false});
        return meter;
    }
    /// Reads the sweep's results from the journal.
    SweepResults measured() const { return sweep_results(read_journal(folder), plan); }
    /// Returns the sweep's results in the format of results.json.
    nlohmann::ordered_json results() const { return results_json(measured()); }
};

}  // namespace si
