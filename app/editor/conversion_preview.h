// Conversion of the editor's settings into code of another program, for its dialog.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/convert/measured_conversion.h"
#include "ui/state/editor_ui.h"

namespace si {

/// Generator of the code that the dialog Convert shows: the present settings for another program, such as an engine.
/// The code is generated again when settings, frame or target program change.
class ConversionPreview {
public:
    /// Makes a generator without code; update() generates it. @param state the editor's state, which must outlive this
    /// object
    explicit ConversionPreview(EditorState& state);

    /// Generates the code that the dialog Convert shows, if the dialog is open and an input has changed. Call once a
    /// frame. Returns true if the dialog has to be drawn again.
    /// @param frame data of the last drawn frame
    /// @param measuring progress of measuring the present settings, for the error and frame time in the code's head
    /// comment; none: not running
    /// @param measured result of that measurement for the present settings; null: none
    bool update(const EditorFrame& frame, const std::optional<SearchProgress>& measuring,
                const MeasuredConversion* measured);
    /// Writes the generated code to a file, completely or not at all. Errors are shown in the dialog Convert.
    /// @param scene the shown scene, whose files are never overwritten; null: none
    /// @param replace true: overwrites an existing file; false: the dialog asks first
    void save(const std::string& path, const Scene* scene, bool replace);
    /// Returns the data that the dialog Convert shows; null while the dialog is closed.
    const ConvertFacts* facts() const { return shown_ ? &*shown_ : nullptr; }

private:
    /// Values that the generated code depends on. The code is generated again when one of them changes.
    struct Input {
        std::string target;
        ConversionInput conversion;
        bool operator==(const Input&) const = default;
    };
    EditorState& state_;
    std::vector<ConvertTargetLabel> labels_;
    std::optional<Input> made_from_;
    std::optional<ConvertedMeasure> angle_taken_from_;  ///< measurement that gave the dialog's reference angle
    std::optional<ConvertFacts> shown_;
};

}  // namespace si
