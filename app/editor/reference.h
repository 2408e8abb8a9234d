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
    /// Returns the last ray-traced reference of a light, to pass as FrameRequest::reference; null: none.
    /// @param light the index of the light
    std::shared_ptr<const ReferencePicture> picture(int light) const;
    /// Returns the last ray-traced references by light, for FrameRequest::traced.
    const std::vector<std::shared_ptr<const ReferencePicture>>& pictures() const { return pictures_; }

    /// Returns the last baked light maps by light, for FrameRequest::light_maps.
    const std::vector<std::shared_ptr<const LightMap>>& light_maps() const { return light_maps_; }

    /// Stores finished ray-traced references and light maps, and starts the background job for those that `frame`
    /// lacks. Call once a frame. Returns true if the scene has to be drawn again, or facts() have changed.
    /// @param drawn true: the frame was drawn in this update; no job starts then, since the user may still be dragging
    /// @throws Error if a job has failed
    bool update(Renderer& renderer, const Scene& scene, const Settings& settings, const FrameRequest& request,
                const FrameResult& frame, bool drawn, const ReferenceRequests& requests);
    /// Cancels the background job and drops all ray-traced references and light maps. Call when there is no frame.
    void clear();
    /// Releases cached rays of views that are no longer shown; finished ray-traced references stay, also those of
    /// earlier views. Call when the editor is idle.
    void release_unused_memory();

    /// Returns state, progress and times of the ray-traced reference for the shown light.
    ReferenceFacts facts(const FrameResult& frame, int shown_light) const;
    bool busy() const { return job_.busy(); }
    /// Returns the pixels that are traced so far of the shown light's ray-traced reference, also after a cancelled
    /// trace. Returns null if the frame has the reference already, or tracing was not begun.
    const TracedSoFar* so_far(const FrameResult& frame) const;
    /// Returns true if the next update() will find a finished reference, light map or saved file, or the progress has
    /// changed.
    bool has_news() const { return job_.has_news(); }
    /// Waits until the background job (references, light maps, saved errors) has ended.
    void wait() const { job_.wait(); }
    /// Returns the outcome of saving the error metrics (ReferenceRequests::save_error) as a line for the log, once:
    /// "Saved F.json". Empty: nothing to report.
    std::string take_remark() { return std::exchange(remark_, {}); }

private:
    /// Result of the background job that traces references: a reference, a light map, or a line for the log.
    struct Found {
        int light = 0;
        std::shared_ptr<const ReferencePicture> picture;  ///< null: unchanged
        std::string remark;
        std::shared_ptr<const LightMap> light_map;  ///< null: unchanged
    };
    /// Stores the result of the background job that traces references, if the job has ended. Returns true if it has
    /// ended. @throws the job's exception
    bool poll();
    /// Records which work the background job does, for its progress text and time estimate. Call before the job starts.
    /// @param doing name of the work: "Tracing rays" @param key cache key of the picture that the work is for
    void begin_work(const char* doing, std::uint64_t key);
    /// Starts the background job that traces the reference of one light's shadows by rays. @param light the index of
    /// the light
    void start_trace(Renderer& renderer, const Scene& scene, const Settings& settings, const FrameRequest& request,
                     int light);
    /// Starts the background job that bakes a light map: visibility of one light, traced into textures.
    /// @param light the index of the light
    void start_bake(const Scene& scene, const Settings& settings, const FrameResult& frame, int light);
    /// Starts the background job that writes all error metrics of the shown light as JSON into a file. Needs the
    /// reference of the frame (request.reference). @throws Error if the file cannot be written
    void start_save(Renderer& renderer, const Scene& scene, const Settings& settings, const FrameRequest& request,
                    const std::string& path);

    /// Returns true if the background job traces a reference of the shown view, also if no panel shows it now. Such a
    /// job is not cancelled, because the panel may be shown again.
    bool is_of_view(const Scene& scene, const Settings& settings, const FrameRequest& request,
                    const FrameResult& frame) const;

    ReferenceCache cache_;                                           ///< used by the job while it runs
    KeptReferences kept_;                                            ///< references of views that may be shown again
    std::vector<std::shared_ptr<const ReferencePicture>> pictures_;  ///< references by light; null: none
    std::vector<std::shared_ptr<const LightMap>> light_maps_;        ///< light maps by light; null: none
    std::set<std::uint64_t> given_up_;                               ///< cache keys of failed and cancelled jobs
    std::string problem_, remark_;
    std::optional<std::string> save_next_;
    const char* doing_ = "";
    std::uint64_t doing_key_ = 0;          ///< cache key of the job's picture
    TimeLeft left_;                        ///< time estimate of the job
    std::shared_ptr<TracedSoFar> so_far_;  ///< pixels of the reference that was started last; null: finished, or none
    std::uint64_t so_far_key_ = 0;         ///< cache key of the reference in `so_far_`
    Job<Found> job_;                       ///< declared last, so that its thread ends first
};

}  // namespace si
