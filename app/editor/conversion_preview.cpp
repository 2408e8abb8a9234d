#include "app/editor/conversion_preview.h"

#include <fmt/format.h>

#include <filesystem>
#include <utility>

#include "app/base/output.h"
#include "app/convert/conversion.h"
#include "app/session/session.h"
#include "renderer/base/error.h"
#include "renderer/base/printable.h"
#include "renderer/view/fits/engine_facts.h"

namespace si {
namespace {

/// Returns the input of a conversion of the shown frame.
ConversionInput shown_input(const EditorState& state, const EditorFrame& frame, const MeasuredConversion* measured) {
    ConversionInput in{.preset = printable(state.files.preset_path, std::string::npos),
                       .title = printable(state.files.guide.title, std::string::npos),
                       .scene = printable(state.scene_name, std::string::npos),
                       .settings = state.settings};
    in.lookup = lookup_facts(state.settings);
    in.facts = facts_of_settings(state.settings, in.facts_source);
    const auto index = std::size_t(state.settings.view.light);
    if (frame.result && index < frame.result->lights.size() && frame.result->lights[index].casts) {
        const FittedLight& light = frame.result->lights[index];
        in.lookup = lookup_facts(state.settings, light, frame.result->map_size,
                                 frame.driver ? frame.driver->subpixel_bits : in.lookup.subpixel_bits);
        in.facts = map_facts(&light, state.settings, frame.result->map_size);
        in.maps = converted_maps(state.settings, light, frame.result->map_size);
        in.facts_source = "as the shown map is fitted";
    }
    in.facts.angle_deg = state.convert.angle_deg;
    in.angle_source = "chosen in the dialog";
    if (measured) {
        in.measure = measured->measure;
        if (measured->angle_deg == state.convert.angle_deg) in.angle_source = angle_source(*measured);
    }
    return in;
}

}  // namespace

ConversionPreview::ConversionPreview(EditorState& state) : state_(state) {
    for (const ConvertTarget& row : convert_targets()) labels_.push_back({row.name, row.title});
}

bool ConversionPreview::update(const EditorFrame& frame, const std::optional<SearchProgress>& measuring,
                               const MeasuredConversion* measured) {
    if (!state_.convert.shown) {
        const bool changed = shown_.has_value();
        shown_.reset();
        made_from_.reset();
        return changed;
    }
    if (state_.convert.target.empty()) state_.convert.target = labels_.front().name;
    const auto measure = measured ? std::optional(measured->measure) : std::nullopt;
    if (measure && angle_taken_from_ != measure) {
        angle_taken_from_ = measure;
        state_.convert.angle_deg = measured->angle_deg.value_or(state_.convert.angle_deg);
    }
    const bool moved = measuring || (shown_ && shown_->measuring);
    Input input{state_.convert.target, shown_input(state_, frame, measured)};
    if (made_from_ == input) {
        shown_->measuring = measuring;
        return moved;
    }
    made_from_ = std::move(input);
    shown_ = ConvertFacts{.targets = labels_, .measuring = measuring, .measured = measured != nullptr};
    try {
        Conversion made = convert_settings(convert_target(made_from_->target), made_from_->conversion);
        shown_->text = std::move(made.text);
        shown_->notes = std::move(made.notes);
    } catch (const Error& e) {
        shown_->problem = e.what();
    }
    return true;
}

void ConversionPreview::save(const std::string& path, const Scene* scene, bool replace) {
    if (!shown_ || shown_->text.empty()) return;
    shown_->problem.clear();
    shown_->taken.clear();
    try {
        const std::vector<std::filesystem::path> outputs{path};
        require_outputs_not_read(outputs,
                                 std::vector<std::filesystem::path>{state_.files.preset_path, state_.scene_name});
        if (scene) require_outputs_not_read(outputs, *scene, state_.files.preset_path);
        require_writable(path);
        if (!replace && is_taken(path)) {
            shown_->taken = path;
            shown_->problem =
                fmt::format("{}: the file exists; press Replace, or choose another name", printable(path));
            return;
        }
        write_regular_file(path, shown_->text);
        state_.log.add(LogKind::Info, "Wrote " + path);
    } catch (const Error& e) {
        shown_->problem = e.what();
    }
}

}  // namespace si
