// Plan of a frame: passes in order, each with its reads, writes and the reason why it runs or not. Planning draws
// nothing and neither makes nor frees targets, so that a plan may be thrown away.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "renderer/frame/frame.h"
#include "renderer/gl/target.h"

namespace si {

/// Declaration of one pass in the plan of a frame: inputs, outputs, cache key and draw function.
struct Pass {
    std::string name;
    PassCategory category = PassCategory::Picture;
    int light = -1;  ///< light index; below 0: all lights, or none
    std::vector<ResultRef> reads, writes;
    std::string needs;     ///< request or setting that needs the pass; empty: see renderer/inspect/effects.cpp
    std::string unneeded;  ///< reason why the scene does not need the pass; empty: needed
    std::optional<Optimisation> by;  ///< optimisation that skips the pass, or that the pass is a part of
    std::uint64_t key = 0;           ///< hash of everything the result depends on, size and format too, except `reads`
    /// True: the pass only saves work in the passes that read its result. Their results are equal without it, and their
    /// keys do not depend on its key. The pass runs only in frames in which one of its readers runs.
    bool only_saves_work = false;
    std::uint64_t* cached = nullptr;  ///< cache key of the target's contents, must outlast the frame; null: not cached
    /// True: the target's contents have the right key, but lack texels that this frame reads. The pass then runs and
    /// adds the missing texels; the others keep their values.
    bool is_incomplete = false;
    std::function<void(PassInfo&)> run;
    std::string idle_reason = "no pass reads it";  ///< reason to report when no running pass reads the result
};

/// Decides which passes of a frame are drawn, and returns a report on each with the reason. Walks back from the
/// `wanted` results (images or buffers that passes write): a pass is live when one of its results is wanted or read by
/// a live pass. Other passes are skipped, and so are passes that the scene does not need (Pass::unneeded). Live passes
/// with an unchanged key are cached. Other live passes are drawn.
/// @param passes passes in drawing order
/// @param force true: draws cached passes too
/// @param draw_unneeded true: draws live passes even where the scene does not need them
std::vector<PassInfo> plan_passes(const std::vector<Pass>& passes, const std::vector<ResultRef>& wanted, bool force,
                                  bool draw_unneeded);

/// Image that holds a pass's result, with the texture unit at which shaders read the image.
struct PlacedImage {
    const gl::Target* target;
    int unit = -1;                         ///< texture unit; below 0: no shader samples the image
    const gl::Sampler* sampler = nullptr;  ///< sampler object; null: the texture's own state
};

/// Ordered passes of one frame, and the images of their results. Each pass adds itself before the frame is drawn.
class Plan {
public:
    /// Appends a pass to the frame's plan, and adds the keys of the pass's inputs to its own cache key. Passes that
    /// write the inputs must be added before.
    void add_pass(Pass pass);
    /// Appends a pass that the scene does not need, with the reason.
    void skip_pass(Pass pass, std::string reason) {
        pass.unneeded = std::move(reason);
        add_pass(std::move(pass));
    }
    /// Registers an image that holds a pass's result once the pass has run, so that other passes can bind the image.
    /// Call once for each image of the result, and once for each texture unit.
    void place_result(const ResultRef& result, PlacedImage image);
    /// Registers a function that frees memory no longer needed; run_releases() calls it when the plan is carried out.
    void release_later(std::function<void()> what) { releases_.push_back(std::move(what)); }

    /// Returns the frame's passes in the order in which they were added.
    const std::vector<Pass>& passes() const { return passes_; }
    /// Returns the registered images that hold a pass's result; an empty list where no pass of the frame makes the
    /// result.
    const std::vector<PlacedImage>& images(const ResultRef& result) const;
    /// Returns one image of a pass's result. The target has no texture where no pass of the frame makes the result.
    /// @param image index among the images of the result
    const gl::Target& target(const ResultRef& result, std::size_t image = 0) const;
    /// Returns the combined cache key of all passes added so far that write `result`. Passes that only save work in
    /// other passes (Pass::only_saves_work) do not count.
    std::uint64_t key_of(const ResultRef& result) const;
    /// Returns true when the images of `result` already hold what the passes added so far would draw, so that those
    /// passes will be cached.
    bool is_current(const ResultRef& result) const;
    /// Calls the functions that release_later() registered, which free memory.
    void run_releases() const {
        for (const auto& give_up : releases_) give_up();
    }

private:
    std::vector<Pass> passes_;
    std::map<ResultRef, std::vector<PlacedImage>> images_;
    std::vector<std::function<void()>> releases_;
};

}  // namespace si
