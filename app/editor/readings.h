// What the editor's panels show as numbers: the probe, the depth image's values and statistics, which pixel reads which
// texel. Each is read back only while a panel shows it, and once for each drawn frame.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "app/editor/dossier.h"
#include "app/editor/frame_facts.h"
#include "renderer/frame/renderer.h"
#include "renderer/inspect/probe.h"
#include "ui/state/editor_ui.h"

namespace si {

class EditorReadings {
public:
    /// Brings up to date what `actions` ask for. `drawn`: the frame is a new one. Returns whether the editor now shows
    /// something else. Needs the renderer's OpenGL context. @throws Error
    bool update(Renderer& renderer, const Scene& scene, const PictureState& state, const EditorActions& actions,
                const FrameRequest& request, const FrameResult& result, bool drawn);
    /// Brings up to date which texels the frozen camera reads. Returns whether it drew a frame of its own for
    /// that, which may have taken the place of the last one (Renderer::holds()). @throws Error
    bool update_frozen(Renderer& renderer, const Scene& scene, const PictureState& state, const EditorActions& actions);
    /// There is no frame.
    void clear();
    /// The truth of the probed pixel is there: update() has news.
    bool has_news() const { return diagnosis_.ready(); }
    /// Waits for it.
    bool finish_tracing() const;
    ReadingFacts facts() const;

private:
    /// The objects that culling takes out of the map, while the list of objects is shown.
    bool update_lost(const Scene& scene, const PictureState& state, const FrameResult& result);
    bool update_probe(Renderer& renderer, const Scene& scene, const PictureState& state, const FrameRequest& request,
                      const FrameResult& result);
    bool update_loupe(const PictureState& state, const FrameResult& result);
    bool update_map(Renderer& renderer, const PictureState& state, const EditorActions& actions,
                    const FrameResult& result);
    bool update_overlay(Renderer& renderer, const PictureState& state, const EditorActions& actions,
                        const FrameResult& result);
    bool update_exact(Renderer& renderer, const EditorActions& actions, const FrameResult& result);
    bool update_links(Renderer& renderer, const PictureState& state, const EditorActions& actions,
                      const FrameResult& result);

    std::uint64_t frame_ = 0;  ///< number of the drawn frame
    std::uint64_t probe_of_ = 0, map_of_ = 0, facts_of_ = 0, links_of_ = 0, exact_of_ = 0, overlay_of_ = 0,
                  lost_of_ = 0, loupe_of_ = 0;  ///< frames they belong to
    int overlay_pane_ = 0, loupe_pane_ = 0;
    ReadingFacts facts_;  ///< but what the dossiers' work knows
    EditorDiagnosis diagnosis_;
    std::optional<glm::ivec2> probed_pixel_;
    HeldMemory held_;           ///< what the numbers take
    Settings frozen_settings_;  ///< that the frozen camera's texels were found under, as far as they depend on them
    std::uint64_t frozen_scene_ = 0;  ///< Scene::id
};

}  // namespace si
