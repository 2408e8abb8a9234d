// The ray-traced truth in the editor: traced in the background while something that is shown asks for it, so that
// numbers and overlays follow bias and kernel at once. Light maps are baked in the same way.
#pragma once

#include <memory>
#include <set>
#include <string>
#include <vector>

#include "app/base/job.h"
#include "renderer/reference/light_map.h"
#include "renderer/reference/truth_picture.h"
#include "ui/state/editor_ui.h"

namespace si {

/// One job computes at a time. All calls from the renderer's thread.
class EditorReference {
public:
    /// What was last traced of a light, for FrameRequest::truth; null: nothing.
    std::shared_ptr<const ReferencePicture> picture(int light) const;
    /// The same of all lights, for FrameRequest::traced.
    const std::vector<std::shared_ptr<const ReferencePicture>>& pictures() const { return pictures_; }

    /// What was last baked of each light, for FrameRequest::light_maps.
    const std::vector<std::shared_ptr<const LightMap>>& light_maps() const { return light_maps_; }

    struct Wishes {
        bool cancel = false;                    ///< forget it until something changes
        std::optional<std::string> save_error;  ///< all metrics of the frame as JSON into this file
    };
    /// Starts what `frame` lacks and takes what is done. @param drawn the frame is a new one: while frames follow each
    /// other (a drag), nothing is started. Returns whether the scene is to be drawn anew, or the facts changed. @throws
    /// Error
    bool update(Renderer& renderer, const Scene& scene, const Settings& settings, const FrameRequest& request,
                const FrameResult& frame, bool drawn, const Wishes& wishes);
    /// There is no frame.
    void clear();
    /// Lets go of what it keeps for views that are no longer shown.
    void rest();

    ReferenceFacts facts(const FrameResult& frame, int shown_light) const;
    bool busy() const { return job_.busy(); }
    /// Something is done: update() has news; or its progress is to be drawn anew.
    bool moved() const { return job_.moved(); }
    /// Until what runs has ended.
    void wait() const { job_.wait(); }
    /// "Wrote F.json", once, after Wishes::save_error.
    std::string take_remark() { return std::exchange(remark_, {}); }

private:
    struct Found {
        int light = 0;
        std::shared_ptr<const ReferencePicture> picture;  ///< of the light; null: as it was
        std::string remark;
        std::shared_ptr<const LightMap> light_map;  ///< of the light; null: as it was
    };
    /// Takes what the job found. Returns whether there was one.
    bool poll();
    void start_trace(Renderer& renderer, const Scene& scene, const Settings& settings, const FrameRequest& request,
                     int light);
    void start_bake(const Scene& scene, const Settings& settings, const FrameResult& frame, int light);
    void start_save(Renderer& renderer, const Scene& scene, const Settings& settings, const FrameRequest& request,
                    const std::string& path);

    ReferenceCache cache_;                                           ///< used by the job while there is one
    std::vector<std::shared_ptr<const ReferencePicture>> pictures_;  ///< by light; of no longer wanted ones null
    std::vector<std::shared_ptr<const LightMap>> light_maps_;        ///< the same
    std::set<std::uint64_t> given_up_;                               ///< keys of what failed or was cancelled
    std::string problem_, remark_;
    std::optional<std::string> save_next_;
    const char* doing_ = "";
    std::uint64_t doing_key_ = 0;  ///< of what the job works on
    Job<Found> job_;               ///< last: joined first
};

}  // namespace si
