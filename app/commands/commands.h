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

/// Parses the value of the option --size, such as "1280x720". @throws UsageError
PictureSize parse_size(const std::string& text);

/// Bytes of memory that a command needs per pixel of its picture, by kind of work. Used to refuse pictures that cannot
/// fit into memory. The numbers were measured with the software rasteriser.
enum PixelBytes : std::uint64_t {
    kDrawnPixelBytes = 20,     ///< a picture is drawn, read back and written
    kComparedPixelBytes = 40,  ///< two pictures are drawn and compared
    kTracedPixelBytes = 170,   ///< the reference is traced by rays
    kMeasuredPixelBytes = 250  ///< wrong pixels are classified
};

/// Returns a note on the memory that a large picture needs; empty below 1 GiB. Example: "16384 x 16384 pixels take
/// about 5120 MiB of memory; 9000 MiB are free".
/// @param bytes_per_pixel a value of PixelBytes @param available free memory, bytes; 0: unknown
/// @throws Error if the picture needs more than the free memory
std::string picture_memory_note(const PictureSize& size, std::uint64_t bytes_per_pixel, std::uint64_t available);
/// Checks that a picture fits into the free memory of this machine, and prints the note of picture_memory_note() for a
/// large one. Call before the work. @param bytes_per_pixel a value of PixelBytes @throws Error if the picture cannot
/// fit
void require_picture_memory(const PictureSize& size, std::uint64_t bytes_per_pixel);

/// Parses a pixel "X,Y", counted from the top left. @param size size of the picture that contains the pixel
/// @param option name of the command-line option, for the error message @throws UsageError, also for a pixel outside
/// the picture
std::pair<int, int> parse_pixel(const std::string& text, const PictureSize& size, const char* option = "--pixel");

/// Options that several commands share, as the user gave them on the command line. Each command uses only those that it
/// offers.
struct CommandOptions {
    SessionOptions session = {};
    std::string output = {};  ///< file or folder to write; empty: none
    PictureSize size = {};
    bool size_given = false;       ///< false: `size` is the default
    CostCase cost = kDefaultCost;  ///< kind of frames to time
    bool json = false;             ///< print JSON instead of text
    bool check_numeric = false;    ///< fail on NaN, infinite and out-of-range numbers
};

/// Options of the command `render`, which draws one view of a scene into a file.
struct RenderOptions : CommandOptions {
    std::string view;         ///< key of a view; empty: the picture with the overlays and panes of the settings
    std::string report;       ///< JSON file for facts of the frame; empty: none
    std::string against;      ///< "truth" or a preset to compare the picture with; empty: no comparison
    double swipe = -1;        ///< place of the line between both pictures, 0..1; negative: side by side
    bool difference = false;  ///< write the picture of 2 |A - B| instead
    bool look = false;        ///< draw with view.look and view.overlay_blend, as the editor does
    bool fit = false;         ///< fit the contrast of a depth view to the stored depths, and print its range
    std::string fit_camera;   ///< preset whose camera view-dependent maps are fitted to; empty: the picture's camera
};
/// Runs the command `render`: draws one view of a scene, such as the picture, a shadow map or an overlay, into a
/// picture or float file.
void run_render(const RenderOptions& options);

/// Options of the command `truth`, which traces the reference of a light's shadows by rays.
struct ReferenceCommandOptions : CommandOptions {
    std::string report;          ///< JSON file for counts and times; empty: none
    bool as_rasterised = false;  ///< leave out the faces that culling leaves out of the map
    int threads = 0;             ///< 0: all
};
/// Runs the command `truth`: traces by rays how much light reaches each pixel from the light that view.light selects.
/// Writes this visibility as a picture or float file.
void run_reference(const ReferenceCommandOptions& options);

/// Options of the command `measure`, which prints error, time and memory of a light's shadows.
struct MeasureOptions : CommandOptions {
    bool time = true;    ///< time frames
    bool fixes = false;  ///< also try fixes and measure each
};
/// Runs the command `measure`: compares the shadows of the light that view.light selects with the ray-traced reference.
/// Prints their error, time and memory.
void run_measure(const MeasureOptions& options);

/// Options of the command `plan`, which prints the work of a frame and the work that it skips.
struct PlanOptions : CommandOptions {
    bool measure = false;  ///< time what each optimisation saves, in ms
    int rounds = 15;       ///< rounds of alternating frames per measurement
    bool waste = false;    ///< list work that changes no pixel when it is left out
};
/// Runs the command `plan`: prints the passes and smaller pieces of work (Effect) of a frame. Each is drawn, cached or
/// skipped, with the reason.
void run_plan(const PlanOptions& options);

/// Options of the command `precision`, which measures rounding errors of shadow-map coordinates.
struct PrecisionOptions : CommandOptions {
    std::string over;  ///< one of precision_series(); empty: one measurement with the given settings
};
/// Runs the command `precision`: prints the rounding error of shadow-map coordinates in single against double
/// precision, for each way to compute the coordinates.
void run_precision(const PrecisionOptions& options);
/// Returns the names of the series that `precision --over` accepts: distance, scale and stretch. Each series varies one
/// setting: scene.distance, scene.scale or light.stretch.
std::vector<std::string_view> precision_series();

/// Options of the command `shimmer`, which measures shimmering edges. `output` is a picture file (.png, .pfm or .exr)
/// with the share of steps in which each pixel flips.
struct ShimmerCommandOptions : CommandOptions {
    ShimmerOptions shimmer;
};
/// Runs the command `shimmer`: moves camera or light by fractions of a texel, and prints how many pixels flip between
/// light and shadow.
void run_shimmer(const ShimmerCommandOptions& options);

/// Upper limits of error and frame time for the settings that `tune` and `advise` search.
struct SearchLimits {
    std::string error;  ///< metric that max_error limits, one of tuned_errors(); empty: the first
    std::optional<double> max_error, max_ms;
};

/// Options of the command `tune`, which searches the best bias of a scene and writes it as a preset.
struct TuneOptions : CommandOptions, SearchLimits {
    bool no_acne = false;           ///< least bias among those without acne
    std::optional<double> max_gap;  ///< largest gap at casters, metres
};
/// Runs the command `tune`: searches the bias with the least error score (wrong pixels and faint errors) over all kinds
/// of bias. Writes it as a preset. With limits of error or time the search also picks kernel and resolution.
void run_tune(const TuneOptions& options);
/// Returns the keys of the error metrics that the option --error of `tune`, `advise` and `sweep` accepts.
std::vector<std::string_view> tuned_errors();

/// Finds an error metric that the option --error of `tune`, `advise` and `sweep` accepts.
/// @param key key of the metric; empty: the first one @throws UsageError listing the known keys
const Metric& tuned_error(const std::string& key);

/// Options of the command `advise`, which suggests cheaper settings. With limits its autopilot searches the best
/// settings and writes them as a preset, `output`.
struct AdviseOptions : CommandOptions, SearchLimits {
    std::vector<std::string> vary;  ///< settings that the autopilot varies, as in a sweep; empty: chosen from the scene
    double max_seconds = 100;
};
/// Runs the command `advise`: prints changes of settings that save time in this scene, each drawn and measured. With a
/// limit of error or time the autopilot searches the best settings instead.
void run_advise(const AdviseOptions& options);

/// Options of the command `probe`, which explains the shadow test of one pixel. `output` is an .svg file: a drawing of
/// the shadow test in a cross-section along the ray of the light that view.light selects.
struct ProbeOptions : CommandOptions {
    std::string pixel;      ///< "X,Y" from the top left
    bool reference = true;  ///< trace rays, for a verdict and fixes
};
/// Runs the command `probe`: prints the shadow test of one pixel step by step. With the reference it also says whether
/// the pixel is right, and prints fixes (changes of settings) for a wrong pixel.
void run_probe(const ProbeOptions& options);

/// Options of the command `list`, which prints one table of the program, such as settings or presets.
struct ListOptions : CommandOptions {
    std::string kind;    ///< one of list_kinds()
    std::string prefix;  ///< lists only keys that begin with it
};
/// Runs the command `list`: prints the rows of one table of the program, such as settings, filters or presets.
void run_list(const ListOptions& options);
/// Returns the names of the tables that the command `list` prints: settings, filters, fits, views, overlays, scenes,
/// presets, ...
std::vector<std::string> list_kinds();

/// Runs the command `info`: prints the OpenGL driver, its limits and the program's version.
void run_info(const CommandOptions& options);

/// Runs the command `scene`: prints the contents of a scene. Also prints the parts of its file that were dropped or
/// approximated, with the reason.
void run_scene(const CommandOptions& options);

/// Options of the command `contact-sheet`, which draws many models into one picture. `size` is the size of each tile.
struct ContactSheetOptions : CommandOptions {
    std::string folder;  ///< folder of the models
    int columns = 8;
};
/// Runs the command `contact-sheet`: draws every model below a folder as a tile of one picture. Writes an index (.txt)
/// of the models next to the picture.
void run_contact_sheet(const ContactSheetOptions& options);

/// Options of the commands `preset check`, `preset show`, `preset diff` and `preset save`. Each command uses only some
/// of them.
struct PresetOptions : CommandOptions {
    std::string file, other_file;     ///< presets to read: files or built-in ones
    std::string title, topic, about;  ///< texts of a preset to save
};
/// Runs the command `preset check`: loads a preset and the scene that it names, to find faults, and prints the number
/// of changed settings. @throws UsageError, Error for the first fault
void run_preset_check(const PresetOptions& options);
/// Runs the command `preset show`: prints those settings of a preset that differ from the program's defaults.
void run_preset_show(const PresetOptions& options);
/// Runs the command `preset diff`: prints the settings in which two presets differ, as text or JSON. Each preset is a
/// file, a built-in preset, or "default" (the program's defaults).
void run_preset_diff(const PresetOptions& options);
/// Runs the command `preset save`: writes the settings given on the command line as a preset file.
void run_preset_save(const PresetOptions& options);
/// Options of the command `compare-pictures`, which measures the visible difference of two pictures. `output` is a .png
/// file with a heat map of the difference.
struct ComparePicturesOptions : CommandOptions {
    std::string picture, other_picture;               ///< PNG files of equal size
    double pixels_per_degree = kFlipPixelsPerDegree;  ///< of visual angle
};
/// Runs the command `compare-pictures`: prints the difference of two pictures as a person sees it (LDR-FLIP): 0 none, 1
/// the largest.
void run_compare_pictures(const ComparePicturesOptions& options);

/// Options of the command `compare-maps`, which compares shadow maps of another engine with maps that this program
/// draws. `output` is a .png file with a picture of the differences.
struct CompareMapsOptions : CommandOptions {
    std::optional<int> light;       ///< index of the light in the settings light.*; none: all lights with imported maps
    int border_texels = 0;          ///< MapCompareOptions::border_texels
    bool leave_out_masked = false;  ///< MapCompareOptions::leaves_out_masked
    bool check = false;             ///< fail if a map fails the gate (MapGate)
};
/// Runs the command `compare-maps`: draws a map with the view of each imported shadow map (another engine's), and
/// prints the differences of each pair. Also prints the bias that the imported maps need. @throws Error if
/// CompareMapsOptions::check is set and a map fails the gate (limits of the differences)
void run_compare_maps(const CompareMapsOptions& options);

/// Options of the command `import-map`, which writes one depth map of another engine as a bundle (the files of one
/// frame). Empty texts stand for options that are not given.
struct ImportMapOptions : CommandOptions {
    std::string image, light;  ///< image of a map; JSON file of its light
    std::string scene;         ///< built-in key or path of the scene that the map shows
    std::string depth_range, reversed, first_row, matrix, product, stored, up, mirrored;  ///< words of conventions
    double unit = 0;  ///< scene lengths in one length of the light's file; 0: not given
    int pick = 0;     ///< reading by its row in the printed list, from 1; 0: the one that fits
};
/// Runs the command `import-map`: writes one depth map of another engine with its light as a bundle (the files of one
/// frame). It finds the conventions that neither file nor user states: depth range, first row, matrix order, axes and
/// unit.
void run_import_map(const ImportMapOptions& options);

/// Options of the command `import-capture`, which writes a frame that RenderDoc captured as a bundle (the files of one
/// frame). `output` is a new folder, .bundle.
struct ImportCaptureOptions : CommandOptions {
    std::string capture;     ///< file that RenderDoc wrote, .rdc
    bool list = false;       ///< print the shadow maps of the capture and write nothing
    std::vector<int> picks;  ///< numbers of the list; empty: all
};
/// Runs the command `import-capture`: replays a RenderDoc capture and writes its shadow maps, scene, camera and picture
/// as a bundle (the files of one frame).
void run_import_capture(const ImportCaptureOptions& options);

/// Options of the command `export`, which writes a scene as glTF, or a frame with its shadow maps as files (a bundle).
struct ExportOptions : CommandOptions {
    std::string bundle;  ///< bundle to write in place of a glTF file: a .bundle folder or a .zip file; empty: none
    std::string maps = "pfm";  ///< file format of the bundle's maps: pfm or exr
};
/// Runs the command `export`: writes the scene in its pose as a glTF file. With --bundle it writes the frame as a
/// bundle instead, with scene, camera, lights, shadow maps and picture.
void run_export(const ExportOptions& options);

/// Options of the command `docs`, which generates pages of docs/. Without an output file the page goes to standard
/// output.
struct DocsOptions : CommandOptions {
    std::string what = "settings";  ///< settings, presets, metrics, hard-cases, techniques, or a JSON schema
    std::string only;               ///< "filter.kernel=pcf": only that row of docs/techniques.md; empty: the whole page
    bool check = false;             ///< compares with the file instead of writing it
};
/// Runs the command `docs`: generates a page of docs/ from the program's tables. With DocsOptions::check it compares
/// the page with the file instead of writing it.
/// @throws Error if the compared file differs @throws UsageError for unknown pages and rows
void run_docs(const DocsOptions& options);
/// Generates docs/techniques.md with its folder of pictures: draws and measures every technique (kernel, bias, source,
/// fit, overlay), or only one. The whole page takes a minute. The same program on the same driver writes the same
/// bytes.
void run_docs_techniques(const DocsOptions& options);
/// Escapes a text for a cell of a Markdown table.
std::string markdown_cell(std::string_view text);
/// Generates the Markdown page of all settings, docs/settings.md.
std::string settings_page();
/// Generates the Markdown page of the built-in presets, docs/presets.md.
std::string presets_page();
/// Generates the Markdown page of the error metrics, docs/metrics.md.
std::string metrics_page();
/// Generates the Markdown page of the hard cases, docs/hard-cases.md. Hard cases are scenes in which shadow maps break,
/// with and without the fix.
std::string hard_cases_page();
/// Formats the list of all settings that --help prints below the options of a command.
std::string settings_help();

/// Options of the command `sweep`, which measures all combinations of some settings. `output` is the folder for the
/// results.
struct SweepOptions : CommandOptions {
    std::vector<std::string> vary;  ///< "KEY=V1,V2,..." or "KEY=from:to:step"
    std::string shard;              ///< "I/N"; empty: all cases
    SweepTiming timing;             ///< timing.cost is not read: CommandOptions::cost is the kind of timed frames
    bool fresh = false, retry = false;
};
/// Runs the command `sweep`: measures error, cost (texels, draws, triangles) and time of every combination of the
/// varied settings. Writes the results and a report into a folder.
void run_sweep(const SweepOptions& options);

/// Options of the command `merge`, which joins shards (parts of a sweep that several machines measured). `output` is
/// the folder for the joined sweep.
struct MergeOptions : CommandOptions {
    std::vector<std::string> parts;  ///< folders of shards
    bool fresh = false;
};
/// Runs the command `merge`: joins the shards of a sweep, which several machines measured, into one folder with one
/// report.
void run_merge(const MergeOptions& options);

/// Runs the command `overview`: writes pictures of the editor, the scene, its shadow map and its visibility into a
/// folder (`output`, by default "out"). Prints a table of the frame's passes and their times.
void run_overview(const CommandOptions& options);

}  // namespace si
