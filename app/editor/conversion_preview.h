// Conversion of the editor's settings into code of another program, for its dialog.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/convert/measured_conversion.h"
#include "ui/state/editor_ui.h"

namespace si {

/// Code for the target that the dialog shows. It is made again when settings, frame or target change.
class ConversionPreview {
public:
    /// @param state of the editor, which lives longer
    explicit ConversionPreview(EditorState& state);

    /// Makes the code if the dialog is open. Returns true if it has changed. @param frame facts of the last frame
    /// @param measuring progress of a measurement under way @param measured result for the present settings; null: none
    bool update(const EditorFrame& frame, const std::optional<SearchProgress>& measuring,
                const MeasuredConversion* measured);
    /// Writes the code into a file, whole or not at all. A file that exists is replaced only with `replace`. The dialog
    /// shows what went wrong.
    void save(const std::string& path, const Scene* scene, bool replace);
    /// Returns the facts for the dialog; null while it is closed.
    const ConvertFacts* facts() const { return shown_ ? &*shown_ : nullptr; }

private:
    /// Values that the code depends on.
    struct Input {
        Settings settings;
        std::string target;
        double angle_deg = 0;
        const FrameResult* frame = nullptr;
        std::optional<ConvertedMeasure> measure;
        bool operator==(const Input&) const = default;
    };
    EditorState& state_;
    std::vector<ConvertTargetLabel> labels_;
    std::optional<Input> made_from_;
    std::optional<ConvertedMeasure> angle_taken_from_;  ///< measurement whose angle the dialog has
    std::optional<ConvertFacts> shown_;
};

}  // namespace si
