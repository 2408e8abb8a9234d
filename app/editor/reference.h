// The ray-traced reference of the editor's picture, traced in the background while a panel or overlay needs it. Errors
// then follow changes of bias and kernel at once. Light maps are baked in the same way.
#pragma once

#include <memory>
#include <set>
#include <string>
#include <vector>

#include "app/base/job.h"
#include "app/base/time_left.h"
#include "app/editor/kept_references.h"
#include "renderer/reference/light_map.h"
#include "renderer/reference/reference_picture.h"
#include "renderer/reference/traced_so_far.h"
#include "ui/state/editor_ui.h"

namespace si {

/// Ray-traced references and baked light maps of the editor's picture, computed by one background job. All calls come
/// from the renderer's thread.
class EditorReference {
public:
    /// Returns the last ray-traced reference of a light, for FrameRequest::reference; null: none. @param light the
    /// index of the light
    std::shared_ptr<const ReferencePicture> picture(int light) const;
    /// Returns the last ray-traced references by light, for FrameRequest::traced.
    const std::vector<std::shared_ptr<const ReferencePicture>>& pictures() const { return pictures_; }

    /// Returns the last baked light maps by light, for FrameRequest::light_maps.
    const std::vector<std::shared_ptr<const LightMap>>& light_maps() const { return light_maps_; }

    /// Stores finished references and light maps, and starts to compute those that `frame` lacks. Returns true if the
    /// scene has to be drawn again, or the facts have changed. @param drawn the frame is a new one; no work starts
    /// then, because a drag may follow @throws Error
    bool update(Renderer& renderer, const Scene& scene, const Settings& settings, const FrameRequest& request,
                const FrameResult& frame, bool drawn, const ReferenceRequests& requests);
    /// Drops all references. Call when there is no frame.
    void clear();
    /// Releases rays of views that are no longer shown. References of earlier views are kept within their limit of
    /// memory. Call when the editor is idle.
    void release_unused_memory();

    /// Returns state, progress and times of the reference of the shown light.
    ReferenceFacts facts(const FrameResult& frame, int shown_light) const;
    bool busy() const { return job_.busy(); }
    /// Returns the pixels traced so far of the reference that the frame lacks, also after Cancel; null: none.
    const TracedSoFar* so_far(const FrameResult& frame) const;
    /// Returns true if the next update() will find a finished result, or the progress has changed.
    bool moved() const { return job_.moved(); }
    /// Waits until no ray is being traced.
    void wait() const { job_.wait(); }
    /// Returns the message after ReferenceRequests::save_error once: "Wrote F.json".
    std::string take_remark() { return std::exchange(remark_, {}); }

private:
    /// Result of the background job: a reference, a light map or a remark.
    struct Found {
        int light = 0;
        std::shared_ptr<const ReferencePicture> picture;  ///< null: unchanged
        std::string remark;
        std::shared_ptr<const LightMap> light_map;  ///< null: unchanged
    };
    /// Stores the result of the background job. Returns true if the job has ended.
    bool poll();
    /// Notes the name and the picture's key of the background job that starts now.
    void begin_work(const char* doing, std::uint64_t key);
    /// Starts the background job that traces a light's reference.
    void start_trace(Renderer& renderer, const Scene& scene, const Settings& settings, const FrameRequest& request,
                     int light);
    /// Starts the background job that bakes a light's light map.
    void start_bake(const Scene& scene, const Settings& settings, const FrameResult& frame, int light);
    /// Starts the background job that writes all error metrics of the frame as JSON into a file.
    void start_save(Renderer& renderer, const Scene& scene, const Settings& settings, const FrameRequest& request,
                    const std::string& path);

    /// Returns true if the work of the background job belongs to the shown view, whether or not a panel shows it now.
    bool is_of_view(const Scene& scene, const Settings& settings, const FrameRequest& request,
                    const FrameResult& frame) const;

    ReferenceCache cache_;                                           ///< used by the job while it runs
    KeptReferences kept_;                                            ///< of views that may be shown again
    std::vector<std::shared_ptr<const ReferencePicture>> pictures_;  ///< by light; null: not needed
    std::vector<std::shared_ptr<const LightMap>> light_maps_;        ///< by light; null: not needed
    std::set<std::uint64_t> given_up_;                               ///< cache keys of failed and cancelled jobs
    std::string problem_, remark_;
    std::optional<std::string> save_next_;
    const char* doing_ = "";
    std::uint64_t doing_key_ = 0;          ///< cache key of the job's picture
    TimeLeft left_;                        ///< started with the job
    std::shared_ptr<TracedSoFar> so_far_;  ///< of the last reference that was started; null: none
    std::uint64_t so_far_key_ = 0;         ///< cache key of that reference
    Job<Found> job_;                       ///< last: joined first
};

}  // namespace si
