#include "app/cli/command.h"

#include <algorithm>
#include <optional>

#include "renderer/base/error.h"
#include "renderer/base/finite_number.h"
#include "renderer/importers/importers.h"
#include "renderer/reference/light_map_cache.h"

namespace si {
namespace {

/// Makes a validator for a finite number. Its message does not name the largest double, as CLI11's does.
/// @param range allowed numbers, for the message: "above 0" @param about allowed numbers, for the help
template <class Test>
CLI::Validator number_that(const Test& is_allowed, const std::string& range, const std::string& about) {
    return {[=](std::string& text) -> std::string {
                if (const auto value = finite_number(text); value && is_allowed(*value)) return {};
                return fmt::format("\"{}\" is not a number {}", text, range);
            },
            about};
}

}  // namespace

CLI::Validator number_between(double min, double max) {
    return number_that([=](double v) { return v >= min && v <= max; }, fmt::format("from {:g} to {:g}", min, max),
                       fmt::format("NUMBER in [{:g} - {:g}]", min, max));
}

CLI::Validator one_of(const std::vector<std::string_view>& words) {
    return {[words](std::string& text) -> std::string {
                if (std::find(words.begin(), words.end(), text) != words.end()) return {};
                return fmt::format("\"{}\" is none of {}", text, fmt::join(words, ", "));
            },
            fmt::format("{}", fmt::join(words, ", ")), kWordsValidator};
}

CLI::Option* CommandParser::add_scene() {
    return app_.add_option("SCENE", options_->session.scene,
                           fmt::format("A model ({}), or a built-in scene (`list scenes`)", importer_extensions()));
}

void CommandParser::add_session(bool scene_required) {
    add_scene()->required(scene_required);
    add_value("--preset", options_->session.preset, "F",
              "Start from a preset: a file or a built-in one (`list presets`)");
    add_value("--set", options_->session.sets, "KEY=VALUE",
              "Set one setting; may be repeated, the last one wins. Another bias.kind brings its starting values")
        ->allow_extra_args(false);
    add_value(
        "--profile", options_->session.profile, "NAME",
        "Draw as another engine does (`list profiles`): its hidden bias and defaults. --set engine.PARAMETER=VALUE "
        "then sets the engine's own parameters (`list profile NAME`)");
    app_.add_flag_callback(
        "--no-cache", [] { light_maps().set_disk_folder({}); },
        "Neither read nor keep baked light maps ($XDG_CACHE_HOME/shadow-inspector, by default below ~/.cache)");
    app_.footer([] { return settings_help(); });
}

void CommandParser::add_size(PictureSize standard, std::uint64_t bytes_per_pixel) {
    options_->size = standard;
    bytes_per_pixel_ = bytes_per_pixel;
    add_value("--size", size_, "WxH",
              fmt::format("Size of the picture in pixels (default {}x{})", standard.width, standard.height));
}

CLI::Option* CommandParser::add_output(const char* type, const char* help) {
    return add_file_to_write("-o,--output", options_->output, type, help);
}

CLI::Option* CommandParser::add_file_to_write(const char* name, std::string& to, const char* type, const char* help) {
    files_to_write_.push_back(&to);
    return add_value(name, to, type, help);
}

void CommandParser::add_numeric() {
    app_.add_flag("--check-numeric", options_->check_numeric,
                  "Search every map, visibility and matrix for NaN, infinite values, depths outside 0 to 1, negative "
                  "variances and overflow; print the place of a fault and exit with 1");
}

void CommandParser::add_cost() {
    const auto parse = [this](const std::string& key) {
        try {
            options_->cost = parse_cost(key);
        } catch (const Error& e) {
            throw CLI::ValidationError("--" + std::string(e.what()));
        }
    };
    app_.add_option_function<std::string>(
            "--cost", parse,
            fmt::format("Kind of frames to time: {} (default: {})", cost_keys(), cost_row(options_->cost).key))
        ->type_name("FRAMES");
}

void CommandParser::add_json(const char* help) {
    app_.add_flag("--json", options_->json, help);
}

void CommandParser::add_area(const char* help) {
    app_.add_flag_callback(
        "--area", [this] { sets_.emplace_back("truth.area=true"); }, help);
}

void CommandParser::add_limits(SearchLimits& limits, const char* error_help, const char* ms_help,
                               const char* metric_help) {
    const CLI::Validator above_zero = number_that([](double v) { return v > 0; }, "above 0", "NUMBER > 0");
    add_value("--max-error", limits.max_error, "E", error_help)->check(above_zero);
    add_value("--max-ms", limits.max_ms, "MS", ms_help)->check(above_zero);
    add_value("--error", limits.error, "NAME",
              fmt::format("{}: {} (default: the first)", metric_help, fmt::join(tuned_errors(), ", ")));
}

void CommandParser::finish() {
    if (!size_.empty()) {
        options_->size = parse_size(size_);
        options_->size_given = true;
        if (bytes_per_pixel_ > 0) require_picture_memory(options_->size, bytes_per_pixel_);
    }
    for (const std::string* file : files_to_write_)
        if (!file->empty()) options_->session.outputs.emplace_back(*file);
    options_->session.sets.insert(options_->session.sets.end(), sets_.begin(), sets_.end());
}

}  // namespace si
