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

/// Result of comparing an imported shadow map with the map that this program draws: both maps with their differences as
/// numbers, a picture, and the message if the comparison failed.
struct MapComparisonFacts {
    std::shared_ptr<const ComparedMap> map;
    Image picture;
    double scale_m = 0;
    std::string problem;
};

/// Comparison of an engine's imported shadow map with the map that this program draws from the same light, for the
/// panel Imported. Compares again only when scene, maps or settings have changed.
class EditorMapComparison {
public:
    /// Compares the imported and the drawn maps of the shown light while a panel requests it; else drops the result.
    /// Returns true if the result has changed. @param frame the shown frame, with its imported maps
    bool update(const Scene& scene, const PictureState& state, const EditorRequests& requests,
                const FrameResult& frame);
    /// Drops the comparison of imported and drawn maps, its picture and its renderer, to free their memory.
    void clear();
    const MapComparisonFacts& facts() const { return facts_; }

private:
    /// Compares all imported maps of a light with the drawn ones, if scene, maps, settings or `left_out` have changed.
    /// Returns true if the maps were compared again.
    /// @param maps imported maps by light @param light the index of the light @param left_out texels that do not count
    bool compare(const Scene& scene, const Settings& settings,
                 const std::vector<std::shared_ptr<const ImportedMaps>>& maps, int light, ImportedLeftOut left_out);
    /// Uploads one picture of the comparison for a view of the light (cascade, cube face), unless it is shown already.
    /// Returns true if a picture was uploaded. @param view the index of the view
    bool paint(std::size_t view, ImportedPicture picture);

    MapComparisonFacts facts_;
    // A second renderer, so that the shown frame keeps its images.
    std::unique_ptr<Renderer> renderer_;
    gl::Texture texture_;
    std::vector<std::shared_ptr<const ComparedMap>> compared_;  ///< compared maps by view of the light; empty: none
    // State that the comparison and the picture belong to.
    Settings settings_;  ///< without camera and view
    std::uint64_t scene_ = 0, maps_ = 0;
    int light_ = -1;
    ImportedLeftOut left_out_;
    std::size_t painted_view_ = 0;
    std::optional<ImportedPicture> painted_;
};

}  // namespace si
