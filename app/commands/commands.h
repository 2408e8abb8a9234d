// Options and functions of all commands. Each command throws Error or UsageError with a one-line message.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "app/sweep/spec.h"
#include "renderer/measure/shimmer.h"
#include "renderer/reference/flip.h"
#include "renderer/reference/metrics.h"

namespace si {

/// Width and height of a picture in pixels.
struct PictureSize {
    int width = 1280, height = 720;
};

/// Parses the value of --size, such as "1280x720". @throws UsageError
PictureSize parse_size(const std::string& text);

/// Bytes of memory that a command takes for each pixel of its picture, by kind of work. Measured with the software
/// rasteriser.
enum PixelBytes : std::uint64_t {
    kDrawnPixelBytes = 20,     ///< a picture is drawn, read back and written
    kComparedPixelBytes = 40,  ///< two pictures are
    kTracedPixelBytes = 170,   ///< rays are traced
    kMeasuredPixelBytes = 250  ///< wrong pixels are classified
};

/// Returns what a large picture takes ("16384 x 16384 pixels take about 5120 MiB of memory; 9000 MiB are free"); empty
/// for less than 1 GiB. @param available free memory, bytes; 0: unknown @throws Error if the picture cannot fit
std::string picture_memory_note(const PictureSize& size, std::uint64_t bytes_per_pixel, std::uint64_t available);
/// Prints the note of picture_memory_note() for this machine. Call before the work. @throws Error
void require_picture_memory(const PictureSize& size, std::uint64_t bytes_per_pixel);

/// Parses a pixel "X,Y" (from the top left) within a picture of `size`. @param option name of the option, for the
/// message @throws UsageError
std::pair<int, int> parse_pixel(const std::string& text, const PictureSize& size, const char* option = "--pixel");

/// Options that several commands share. Each command uses those that its command line offers.
struct CommandOptions {
    SessionOptions session = {};
    std::string output = {};  ///< file or folder to write; empty: none
    PictureSize size = {};
    bool size_given = false;       ///< false: `size` is the default
    CostCase cost = kDefaultCost;  ///< kind of frames to time
    bool json = false;             ///< print JSON instead of text
    bool check_numeric = false;    ///< fail on NaN, infinite and out-of-range numbers
};

/// Options of the command `render`.
struct RenderOptions : CommandOptions {
    std::string view;         ///< key of a view; empty: the picture with the overlays and panes of the settings
    std::string report;       ///< JSON file for facts of the frame; empty: none
    std::string against;      ///< "truth" or a preset to compare the picture with; empty: no comparison
    double swipe = -1;        ///< place of the line between both pictures, 0..1; negative: side by side
    bool difference = false;  ///< write |A - B| instead
    bool look = false;        ///< draw with view.look and view.overlay_blend, as the editor does
    bool fit = false;         ///< fit the contrast of a depth view to the stored depths, and print its range
    std::string fit_camera;   ///< preset whose camera view-dependent maps are fitted to; empty: the picture's camera
};
/// Runs the command `render`: draws one view of a scene into a picture or float file.
void run_render(const RenderOptions& options);

/// Options of the command `truth`.
struct ReferenceCommandOptions : CommandOptions {
    std::string report;          ///< JSON file for counts and times; empty: none
    bool as_rasterised = false;  ///< leave out the faces that culling leaves out of the map
    int threads = 0;             ///< 0: all
};
/// Runs the command `truth`: writes the ray-traced visibility of the light `view.light` as a picture or float file.
void run_reference(const ReferenceCommandOptions& options);

/// Options of the command `measure`.
struct MeasureOptions : CommandOptions {
    bool time = true;    ///< time frames
    bool fixes = false;  ///< also try fixes and measure each
};
/// Runs the command `measure`: prints the error of the shadows of `view.light` against the reference, and their time
/// and memory.
void run_measure(const MeasureOptions& options);

/// Options of the command `plan`.
struct PlanOptions : CommandOptions {
    bool measure = false;  ///< time what each optimisation saves, in ms
    int rounds = 15;       ///< rounds of alternating frames per measurement
    bool waste = false;    ///< list work that changes no pixel when it is left out
};
/// Runs the command `plan`: prints which passes and smaller pieces of work (Effect) a frame draws, which it skips, and
/// why.
void run_plan(const PlanOptions& options);

/// Options of the command `precision`.
struct PrecisionOptions : CommandOptions {
    std::string over;  ///< one of precision_series(); empty: one measurement with the given settings
};
/// Runs the command `precision`: prints the error of single against double precision for each way to compute map
/// coordinates.
void run_precision(const PrecisionOptions& options);
/// Returns the keys of the series that `precision --over` accepts (distance, scale, ...).
std::vector<std::string_view> precision_series();

/// Options of the command `shimmer`. Its output is a picture of flips per pixel and step, .png or .pfm.
struct ShimmerCommandOptions : CommandOptions {
    ShimmerOptions shimmer;
};
/// Runs the command `shimmer`: prints how many pixels flip while camera or light move by fractions of a texel.
void run_shimmer(const ShimmerCommandOptions& options);

/// Limits of error and frame time for the searches that `tune` and `advise` run.
struct SearchLimits {
    std::string error;  ///< metric that max_error limits, one of tuned_errors(); empty: the first
    std::optional<double> max_error, max_ms;
};

/// Options of the command `tune`.
struct TuneOptions : CommandOptions, SearchLimits {
    bool no_acne = false;           ///< least bias among those without acne
    std::optional<double> max_gap;  ///< largest gap at casters, metres
};
/// Runs the command `tune`: writes a preset with the least bias of all rows of the bias table. With limits the search
/// also picks kernel and resolution.
void run_tune(const TuneOptions& options);
/// Returns the keys of the metrics that `tune --error` accepts.
std::vector<std::string_view> tuned_errors();

/// Finds a metric that `tune --error` accepts. @param key empty: the first one @throws UsageError listing the known
/// keys
const Metric& tuned_error(const std::string& key);

/// Options of the command `advise`. Its output is the preset that the autopilot writes.
struct AdviseOptions : CommandOptions, SearchLimits {
    std::vector<std::string> vary;  ///< settings that the autopilot varies, as in a sweep; empty: chosen from the scene
    double max_seconds = 100;
};
/// Runs the command `advise`: prints changes of settings that the scene allows, each measured. With a limit the
/// autopilot runs instead.
void run_advise(const AdviseOptions& options);

/// Options of the command `probe`. Its output is the cross-section of the shadow test of view.light, .svg.
struct ProbeOptions : CommandOptions {
    std::string pixel;      ///< "X,Y" from the top left
    bool reference = true;  ///< trace rays, for a verdict and fixes
};
/// Runs the command `probe`: prints the shadow test of one pixel step by step, its verdict and its fixes.
void run_probe(const ProbeOptions& options);

/// Options of the command `list`.
struct ListOptions : CommandOptions {
    std::string kind;    ///< one of list_kinds()
    std::string prefix;  ///< lists only keys that begin with it
};
/// Runs the command `list`: prints the rows of one table (settings, filters, presets, ...).
void run_list(const ListOptions& options);
/// Returns the names of the tables that `list` prints: settings, filters, fits, views, overlays, scenes, presets, ...
std::vector<std::string> list_kinds();

/// Runs the command `info`: prints the OpenGL driver, its limits and the program's version.
void run_info(const CommandOptions& options);

/// Runs the command `scene`: prints what a scene holds, and which parts of its file were dropped or approximated and
/// why.
void run_scene(const CommandOptions& options);

/// Options of the command `contact-sheet`. The size is that of each tile.
struct ContactSheetOptions : CommandOptions {
    std::string folder;  ///< folder of the models
    int columns = 8;
};
/// Runs the command `contact-sheet`: draws every model below a folder into one picture, and writes an index
/// (.txt) next to it.
void run_contact_sheet(const ContactSheetOptions& options);

/// Options of the commands below `preset`.
struct PresetOptions : CommandOptions {
    std::string file, other_file;     ///< presets to read: files or built-in ones
    std::string title, topic, about;  ///< texts of a preset to save
};
/// Runs the command `preset check`: reads a preset file and reports the first fault.
void run_preset_check(const PresetOptions& options);
/// Runs the command `preset show`: prints a preset's settings that differ from the defaults.
void run_preset_show(const PresetOptions& options);
/// Runs the command `preset diff`: prints the differences of two presets in words. Each is a preset file, a built-in
/// preset, or "default".
void run_preset_diff(const PresetOptions& options);
/// Runs the command `preset save`: writes the session's settings as a preset.
void run_preset_save(const PresetOptions& options);
/// Options of the command `compare-pictures`. Its output is a heat map, .png.
struct ComparePicturesOptions : CommandOptions {
    std::string picture, other_picture;               ///< PNG files of equal size
    double pixels_per_degree = kFlipPixelsPerDegree;  ///< of visual angle
};
/// Runs the command `compare-pictures`: prints the difference of two pictures as a person sees it (LDR-FLIP).
void run_compare_pictures(const ComparePicturesOptions& options);

/// Options of the command `compare-maps`. Its output is a picture of differences, .png.
struct CompareMapsOptions : CommandOptions {
    std::optional<int> light;       ///< index of light.*; none: all lights with imported maps
    int border_texels = 0;          ///< MapCompareOptions::border_texels
    bool leave_out_masked = false;  ///< MapCompareOptions::leaves_out_masked
    bool check = false;             ///< an error where a map fails the gate
};
/// Runs the command `compare-maps`: prints how imported maps differ from maps drawn with the same views.
void run_compare_maps(const CompareMapsOptions& options);

/// Options of the command `import-map`. Its output is a bundle. Empty texts: not given.
struct ImportMapOptions : CommandOptions {
    std::string image, light;  ///< image of a map; JSON file of its light
    std::string scene;         ///< built-in key or path of the scene that the map shows
    std::string depth_range, reversed, first_row, matrix, product, stored, up, mirrored;  ///< words of conventions
    double unit = 0;  ///< lengths of the scene in one of the light's file; 0: not given
    int pick = 0;     ///< row of the list of readings, from 1; 0: the one that fits
};
/// Runs the command `import-map`: makes a bundle of one depth map of another engine. Finds the conventions that nothing
/// states: depth range, first row, matrix order, axes and unit.
void run_import_map(const ImportMapOptions& options);

/// Options of the command `import-capture`. Its output is a folder, .bundle.
struct ImportCaptureOptions : CommandOptions {
    std::string capture;     ///< file that RenderDoc wrote, .rdc
    bool list = false;       ///< print the shadow maps of the capture and write nothing
    std::vector<int> picks;  ///< numbers of the list; empty: all
};
/// Runs the command `import-capture`: opens a RenderDoc capture and writes its shadow maps, scene, camera and picture
/// as a bundle.
void run_import_capture(const ImportCaptureOptions& options);

/// Options of the command `export`.
struct ExportOptions : CommandOptions {
    std::string bundle;  ///< bundle to write in place of a glTF file: a .bundle folder or a .zip file; empty: none
    std::string maps = "pfm";  ///< file format of the bundle's maps: pfm or exr
};
/// Runs the command `export`: writes the session's scene as a glTF file, or its frame as a bundle.
void run_export(const ExportOptions& options);

/// Options of the command `docs`. Without an output the page goes to standard output.
struct DocsOptions : CommandOptions {
    std::string what = "settings";  ///< page: settings, presets, metrics, hard-cases or techniques
    std::string only;               ///< "filter.kernel=pcf": only that row of docs/techniques.md; empty: the whole page
    bool check = false;             ///< compares with the file instead of writing it
};
/// Runs the command `docs`: generates a page of docs/ from the program's tables. @throws Error where the file differs
/// under `check` @throws UsageError for unknown pages and rows
void run_docs(const DocsOptions& options);
/// Draws and measures all techniques, or one, for docs/techniques.md and its folder of pictures. The whole page takes a
/// minute. The same program on the same driver writes the same bytes.
void run_docs_techniques(const DocsOptions& options);
/// Escapes a text for a cell of a Markdown table.
std::string markdown_cell(std::string_view text);
/// Generates the Markdown text of docs/settings.md.
std::string settings_page();
/// Generates the Markdown text of docs/presets.md.
std::string presets_page();
/// Generates the Markdown text of docs/metrics.md.
std::string metrics_page();
/// Generates the Markdown text of docs/hard-cases.md.
std::string hard_cases_page();
/// Formats the table of settings that --help prints.
std::string settings_help();

/// Options of the command `sweep`. Its output is a folder.
struct SweepOptions : CommandOptions {
    std::vector<std::string> vary;  ///< "KEY=V1,V2,..." or "KEY=from:to:step"
    std::string shard;              ///< "I/N"; empty: all cases
    SweepTiming timing;             ///< timing.cost is not read: CommandOptions::cost is the kind of timed frames
    bool fresh = false, retry = false;
};
/// Runs the command `sweep`: measures error, cost and time of every combination of settings, and writes a report.
void run_sweep(const SweepOptions& options);

/// Options of the command `merge`, which joins shards of a sweep. Its output is a folder.
struct MergeOptions : CommandOptions {
    std::vector<std::string> parts;  ///< folders of shards
    bool fresh = false;
};
/// Runs the command `merge`: joins the shards of a sweep into one folder with one report.
void run_merge(const MergeOptions& options);

/// Runs the command `overview`: writes pictures of the editor, the scene, its shadow map and visibility into a folder,
/// by default out, and prints a table of passes and times.
void run_overview(const CommandOptions& options);

}  // namespace si
