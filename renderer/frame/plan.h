// The plan of a frame: passes in order, each with what it reads and writes, and why it runs or not. Planning draws
// nothing, and neither makes nor gives up what results lie in: it may be thrown away.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "renderer/frame/frame.h"
#include "renderer/gl/target.h"

namespace si {

struct Pass {
    std::string name;
    PassCategory category = PassCategory::Picture;
    int light = -1;  ///< PassInfo::light
    std::vector<ResultRef> reads, writes;
    std::string unneeded;   ///< why the scene does not call for it; empty: it does
    std::uint64_t key = 0;  ///< of all that the result depends on, its size and format too, but what it reads
    /// What it writes spares its readers work and changes nothing of what they make: it adds nothing to their keys, and
    /// is made only where one of them runs.
    bool aid = false;
    std::uint64_t* cached = nullptr;  ///< key of the contents that the target holds; stays where it is between frames
    /// Of what `cached` names the target holds less than is called for: the pass runs, and what it adds changes nothing
    /// of what was read before.
    bool lacks = false;
    std::function<void(PassInfo&)> run;
    std::string idle_reason = "nothing reads it";  ///< shown when no live pass reads what it writes
};

/// Walks back from `wanted`: a pass lives when something wanted or read by a live pass is written by it. Dead passes
/// and passes the scene does not call for are skipped, passes whose key is unchanged are reused, others are to run.
/// `force` runs cached passes, `uncalled` those that the scene does not call for.
std::vector<PassInfo> plan_passes(const std::vector<Pass>& passes, const std::vector<ResultRef>& wanted, bool force,
                                  bool uncalled);

/// An image of a result, and how shaders find it.
struct PlacedImage {
    const gl::Target* target;
    int unit = -1;                         ///< of texture; below 0: no shader samples it
    const gl::Sampler* sampler = nullptr;  ///< it is read with; null: none
};

class Plan {
public:
    /// Takes a pass whose inputs were added before it, and completes its key by theirs.
    void add(Pass pass);
    /// Says where a result will lie once its pass has run. One of several images is placed image by image, and one that
    /// two units read once for each.
    void place(const ResultRef& result, PlacedImage image);
    /// Has something given up when the plan is carried out: what nothing calls for any more.
    void release(std::function<void()> what) { releases_.push_back(std::move(what)); }

    const std::vector<Pass>& passes() const { return passes_; }
    /// Empty where no pass of the frame makes it.
    const std::vector<PlacedImage>& images(const ResultRef& result) const;
    /// An image of a result; one without a texture where no pass of the frame makes it.
    const gl::Target& target(const ResultRef& result, std::size_t image = 0) const;
    /// Of all that the passes added so far write into it, but aids.
    std::uint64_t key_of(const ResultRef& result) const;
    /// Whether images still hold what the passes added so far would write into it.
    bool is_current(const ResultRef& result) const;
    void run_releases() const {
        for (const auto& give_up : releases_) give_up();
    }

private:
    std::vector<Pass> passes_;
    std::map<ResultRef, std::vector<PlacedImage>> images_;
    std::vector<std::function<void()>> releases_;
};

}  // namespace si
