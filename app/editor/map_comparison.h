// Comparison of the shown imported map with the drawn one, for the panel Imported.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "renderer/gl/handle.h"
#include "renderer/inspect/map_comparison.h"
#include "renderer/render/renderer.h"
#include "ui/state/editor_ui.h"

namespace si {

/// Numbers and picture of a comparison, copied from the thread that made them.
struct MapComparisonFacts {
    std::shared_ptr<const ComparedMap> map;
    Image picture;
    double scale_m = 0;
    std::string problem;
};

/// Painter of the comparison of the shown imported map with the drawn one. Compares again only when scene, maps or
/// settings have changed.
class EditorMapComparison {
public:
    /// Compares the maps of the shown light while the panel requests it. Returns true if the facts have changed.
    /// @param frame the shown frame, with the maps that it was given
    bool update(const Scene& scene, const PictureState& state, const EditorRequests& requests,
                const FrameResult& frame);
    /// Drops the comparison, its picture and its renderer.
    void clear();
    const MapComparisonFacts& facts() const { return facts_; }

private:
    /// Compares all maps of the light, if anything that a comparison depends on has changed.
    bool compare(const Scene& scene, const Settings& settings,
                 const std::vector<std::shared_ptr<const ImportedMaps>>& maps, int light, ImportedLeftOut left_out);
    /// Uploads the picture of a view, if another one is shown.
    bool paint(std::size_t view, ImportedPicture picture);

    MapComparisonFacts facts_;
    // A second renderer, so that the shown frame keeps its images.
    std::unique_ptr<Renderer> renderer_;
    gl::Texture texture_;
    std::vector<std::shared_ptr<const ComparedMap>> compared_;  ///< by view of the light; empty: not compared
    // State that the comparison and the picture belong to.
    Settings settings_;  ///< without camera and view
    std::uint64_t scene_ = 0, maps_ = 0;
    int light_ = -1;
    ImportedLeftOut left_out_;
    std::size_t painted_view_ = 0;
    std::optional<ImportedPicture> painted_;
};

}  // namespace si
