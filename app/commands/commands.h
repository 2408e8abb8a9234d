// The commands, as the command line calls them. Each throws Error or UsageError with one line.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "app/session/session.h"
#include "app/sweep/timing.h"
#include "renderer/measure/shimmer.h"
#include "renderer/reference/metrics.h"
#include "renderer/reference/truth.h"

namespace si {

struct PictureSize {
    int width = 1280, height = 720;
};

/// "1280x720". @throws UsageError
PictureSize parse_size(const std::string& text);

/// "X,Y" within a picture of `size`. @param option its name, for the message. @throws UsageError
std::pair<int, int> parse_pixel(const std::string& text, const PictureSize& size, const char* option = "--pixel");

struct RenderOptions {
    SessionOptions session;
    std::string output, view = "shaded", report;
    bool view_given = false;
    PictureSize size;
    std::string against;         ///< "truth" or a preset: the picture is held against that one; empty: it stands alone
    double swipe = -1;           ///< where the line between the two stands, 0..1; negative: beside each other
    bool difference = false;     ///< |A - B| instead
    bool check_numeric = false;  ///< and fail where a number is none, or lies where none can
    std::string fit_camera;      ///< a preset: maps that follow a camera are made for its own; empty: for the picture's
};
void run_render(const RenderOptions& options);

struct ReferenceCommandOptions {
    SessionOptions session;
    std::string output, report;
    PictureSize size;
    ReferenceOptions reference;
    int threads = 0;  ///< 0: all
    bool check_numeric = false;
};
/// The ray-traced visibility of view.light as a picture.
void run_reference(const ReferenceCommandOptions& options);

struct MeasureOptions {
    SessionOptions session;
    PictureSize size;
    bool time = true, json = false;
    bool check_numeric = false;
    bool fixes = false;  ///< and what would put wrong pixels right
    CostCase cost = kDefaultCost;
};
/// How far the shadows of view.light are from the truth, and what they cost, in numbers.
void run_measure(const MeasureOptions& options);

struct PlanOptions {
    SessionOptions session;
    PictureSize size;
    bool measure = false;  ///< what each saving is worth, in ms
    int rounds = 15;       ///< of frames in turns
    bool check_numeric = false;
    bool waste = false;  ///< what changes nothing when it is left out
    bool json = false;
};
/// What a frame of the scene simulates, and what not and why.
void run_plan(const PlanOptions& options);

struct PrecisionOptions {
    SessionOptions session;
    PictureSize size{640, 360};
    std::string over;  ///< one of precision_series(); empty: as the settings are
    bool json = false;
};
/// What single precision costs by each way of computing places in the map.
void run_precision(const PrecisionOptions& options);
/// What it can be told over.
std::vector<std::string_view> precision_series();

struct ShimmerCommandOptions {
    SessionOptions session;
    PictureSize size{640, 360};
    ShimmerOptions shimmer;
    std::string output;  ///< how often each pixel flips a step, .png or .pfm; empty: no picture
    bool json = false;
};
/// How much edges of shadows crawl while camera or light move by parts of a texel.
void run_shimmer(const ShimmerCommandOptions& options);

struct TuneOptions {
    SessionOptions session;
    std::string output, error;  ///< error: one of tuned_errors(); empty: the first
    std::optional<double> most_error, most_ms;
    PictureSize size;
    CostCase cost = kDefaultCost;
    bool json = false;
    bool check_numeric = false;
};
/// Writes a preset with the least bias that leaves no acne; with limits, with the kernel and resolution that suit them.
void run_tune(const TuneOptions& options);
/// Keys of the metrics() that a limit can bound.
std::vector<std::string_view> tuned_errors();

/// @throws UsageError naming those that there are @param key empty: the first
const Metric& tuned_error(const std::string& key);

struct AdviseOptions {
    SessionOptions session;
    std::string output, error;  ///< as of TuneOptions; output: the preset that the autopilot writes
    std::optional<double> most_error, most_ms;
    std::vector<std::string>
        vary;  ///< what the autopilot chooses among, as in a sweep; empty: what the scene leaves open
    double most_seconds = 100;
    PictureSize size;
    CostCase cost = kDefaultCost;
    bool json = false;
    bool check_numeric = false;
};
/// What the scene says may be changed, measured; with a bound the autopilot.
void run_advise(const AdviseOptions& options);

struct ProbeOptions {
    SessionOptions session;
    std::string pixel;  ///< "X,Y" from the top left
    PictureSize size;
    std::filesystem::path section;  ///< where the cross-section of view.light's test goes, .svg; empty: nowhere
    bool json = false, reference = true, check_numeric = false;
};
void run_probe(const ProbeOptions& options);

struct ListOptions {
    std::string kind;    ///< settings, filters, fits, views, overlays, scenes, presets
    std::string prefix;  ///< of the keys to list
    bool json = false;
};
void run_list(const ListOptions& options);
const std::vector<std::string>& list_kinds();

void run_info(bool json);
/// What is in a scene, and what of its file was dropped or approximated and why.
/// @param file_scene which scene of a glTF file; -1: its default
void run_scene(const std::string& scene, int file_scene, bool json);

struct ContactSheetOptions {
    std::string folder, output;
    int columns = 8;
    PictureSize size{256, 192};  ///< of each tile
    bool check_numeric = false;
};
/// Draws every .gltf and .glb file below a folder into one picture, and writes an index beside it (.txt).
void run_contact_sheet(const ContactSheetOptions& options);

void run_preset_check(const std::string& file);
void run_preset_show(const std::string& file);
/// Says in words what differs. Each of the two is a preset file, a built-in preset, or "default".
void run_preset_diff(const std::string& before, const std::string& after, bool json);
/// What a preset says to people.
struct PresetTexts {
    std::string title, topic, about;
};
/// Writes the composed settings as a preset.
void run_preset_save(const SessionOptions& session, const PresetTexts& texts, const std::string& output);
void run_export(const SessionOptions& session, const std::string& output);

/// docs/settings.md or docs/presets.md: to `output`, or to stdout when empty; `check` compares and throws when they
/// differ. @param what "settings" or "presets"
void run_docs(const std::string& what, const std::string& output, bool check);
/// Draws and measures every technique: a page, and its pictures in a folder of its name beside it. Takes minutes.
void run_docs_techniques(const std::string& output);
/// A text as a cell of a table in Markdown.
std::string cell(std::string_view text);
/// The text of docs/settings.md and of docs/presets.md.
std::string settings_page();
std::string presets_page();
std::string metrics_page();
std::string hard_cases_page();
/// The table of settings as --help shows it.
std::string settings_help();

struct SweepOptions {
    SessionOptions session;
    std::vector<std::string> vary;  ///< "KEY=V1,V2,..." or "KEY=from:to:step"
    std::string folder, shard;
    PictureSize size{640, 360};
    SweepTiming timing;
    bool fresh = false, retry = false;
    bool check_numeric = false;  ///< of the cases that are measured now
};
/// Error, cost and time of every combination, and a report of them.
void run_sweep(const SweepOptions& options);

struct MergeOptions {
    std::vector<std::string> parts;  ///< folders of shards
    std::string folder;
    bool fresh = false;
};
/// Puts shards of a sweep together.
void run_merge(const MergeOptions& options);

struct OverviewOptions {
    SessionOptions session;
    std::string folder = "out";
    PictureSize size;
    bool check_numeric = false;
};
/// The editor, the scene, its shadow map and visibility as pictures, and a table of passes and times.
void run_overview(const OverviewOptions& options);

}  // namespace si
