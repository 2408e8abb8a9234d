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

/// Declaration of one pass of a frame: inputs, outputs, cache key and draw function.
struct Pass {
    std::string name;
    PassCategory category = PassCategory::Picture;
    int light = -1;  ///< light index for PassInfo::light
    std::vector<ResultRef> reads, writes;
    std::string needs;     ///< request or setting that needs the pass; empty: see renderer/inspect/effects.cpp
    std::string unneeded;  ///< reason why the scene does not need the pass; empty: needed
    std::optional<Optimisation> by;  ///< optimisation that skips the pass, or that the pass is a part of
    std::uint64_t key = 0;           ///< hash of everything the result depends on, size and format too, except `reads`
    /// True: the pass only saves its readers work, and their results stay equal without it. Its key is not part of
    /// theirs. It runs only where one of them runs.
    bool only_saves_work = false;
    std::uint64_t* cached = nullptr;  ///< cache key of the target's contents; the address must outlast the frame
    /// True: the target has the key `cached` but too few texels. The pass then runs and adds the missing ones; texels
    /// read before stay equal.
    bool is_incomplete = false;
    std::function<void(PassInfo&)> run;
    std::string idle_reason = "no pass reads it";  ///< reason to report when no running pass reads the result
};

/// Decides which passes run, walking back from the `wanted` results. A pass is live when its result is wanted or read
/// by a live pass. Dead and unneeded passes are skipped; passes with an unchanged key are cached; others are drawn.
/// @param force true: draws cached passes too
/// @param draw_unneeded true: draws live passes even where the scene does not need them
std::vector<PassInfo> plan_passes(const std::vector<Pass>& passes, const std::vector<ResultRef>& wanted, bool force,
                                  bool draw_unneeded);

/// Image that holds a result of the plan, with the texture unit at which shaders read it.
struct PlacedImage {
    const gl::Target* target;
    int unit = -1;                         ///< texture unit; below 0: no shader samples the image
    const gl::Sampler* sampler = nullptr;  ///< sampler object; null: the texture's own state
};

/// Ordered passes of one frame, and the images of their results.
class Plan {
public:
    /// Appends a pass and completes its key by the keys of its inputs. Passes that write the inputs must be added
    /// before.
    void add_pass(Pass pass);
    /// Appends a pass that the scene does not need, with the reason.
    void skip_pass(Pass pass, std::string reason) {
        pass.unneeded = std::move(reason);
        add_pass(std::move(pass));
    }
    /// Registers an image of a result, where it lies once its pass has run. Call once for each image of the result, and
    /// once for each texture unit.
    void place_result(const ResultRef& result, PlacedImage image);
    /// Registers a function that frees memory no longer needed; run_releases() calls it when the plan is carried out.
    void release_later(std::function<void()> what) { releases_.push_back(std::move(what)); }

    /// Returns the passes in the order of their declaration.
    const std::vector<Pass>& passes() const { return passes_; }
    /// Returns the images of a result; an empty list where no pass of the frame makes it.
    const std::vector<PlacedImage>& images(const ResultRef& result) const;
    /// Returns one image of a result. The target has no texture where no pass of the frame makes the result.
    const gl::Target& target(const ResultRef& result, std::size_t image = 0) const;
    /// Returns the combined cache key of all passes added so far that write `result`, except passes that only save work
    /// (Pass::only_saves_work).
    std::uint64_t key_of(const ResultRef& result) const;
    /// Returns true when a result's images already hold what the passes added so far would write.
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
