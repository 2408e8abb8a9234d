#include "renderer/frame/plan.h"

#include <algorithm>
#include <set>

#include "renderer/base/key.h"

namespace si {

namespace {

constexpr std::string_view kResultNames[] = {
    "visible depths",
    "requested pages",
    "pages of shadow maps",
    "shadow maps as drawn",
    "shadow maps",
    "moments",
    "bounds of the maps",
    "camera depth",
    "surface ids",
    "blobs",
    "light map",
    "shadow volumes",
    "visibility",
    "unfiltered map",
    "visible surfaces",
    "reference",
    "compared pixels",
    "classified pixels",
    "error",
    "evidence",
    "picture by the reference",
    "errors of single precision",
    "shaded picture",
    "picture with darkened creases",
    "perceived difference",
    "smooth picture",
    "overlay values",
    "picture with overlay",
    "picture with stored-depth quads",
    "map coordinates",
    "texels read",
    "map channel",
    "depth range",
    "map view",
    "numeric health",
};
static_assert(std::size(kResultNames) == std::size_t(Result::Health) + 1);

}  // namespace

std::string_view result_name(Result result) {
    return kResultNames[std::size_t(result)];
}

std::vector<PassInfo> plan_passes(const std::vector<Pass>& passes, const std::vector<ResultRef>& wanted, bool force,
                                  bool draw_unneeded) {
    std::vector<PassInfo> out(passes.size());
    std::set<ResultRef> needed(wanted.begin(), wanted.end()), read_now;
    for (std::size_t i = passes.size(); i-- > 0;) {
        const Pass& pass = passes[i];
        PassInfo& info = out[i];
        info.name = pass.name;
        if (!pass.writes.empty()) info.makes = pass.writes.front().what;
        info.category = pass.category;
        info.light = pass.light;
        info.needs = pass.needs;
        info.by = pass.by;
        const bool live =
            std::any_of(pass.writes.begin(), pass.writes.end(), [&](const ResultRef& w) { return needed.contains(w); });
        if (!pass.unneeded.empty() && !(draw_unneeded && pass.run && live)) {
            info.reason = pass.unneeded;
            continue;
        }
        if (!live) {
            info.reason = pass.idle_reason;
            if (pass.only_saves_work) info.by.reset();  // nothing that it could save is drawn
            continue;
        }
        needed.insert(pass.reads.begin(), pass.reads.end());
        const bool held = pass.cached && *pass.cached == pass.key;
        if (!force && held && !pass.is_incomplete) {
            info.state = PassState::Cached;
            info.reason = "its inputs are unchanged";
        } else if (pass.only_saves_work &&
                   std::ranges::none_of(pass.writes, [&](const ResultRef& w) { return read_now.contains(w); })) {
            info.reason = "no pass that it speeds up is drawn";
            info.by.reset();
        } else {
            info.state = PassState::Drawn;
            read_now.insert(pass.reads.begin(), pass.reads.end());
            info.reason = !held   ? "its inputs changed"
                          : force ? "forced by the request"
                                  : "more texels of it are needed";
        }
    }
    return out;
}

void Plan::add_pass(Pass pass) {
    if (!pass.reads.empty()) {
        Key key;
        key.add(pass.key);
        for (const ResultRef& read : pass.reads) key.add(key_of(read));
        pass.key = key.value();
    }
    passes_.push_back(std::move(pass));
}

void Plan::place_result(const ResultRef& result, PlacedImage image) {
    images_[result].push_back(image);
}

const std::vector<PlacedImage>& Plan::images(const ResultRef& result) const {
    static const std::vector<PlacedImage> none;
    const auto found = images_.find(result);
    return found == images_.end() ? none : found->second;
}

const gl::Target& Plan::target(const ResultRef& result, std::size_t image) const {
    static const gl::Target none;
    const auto& all = images(result);
    return image < all.size() ? *all[image].target : none;
}

std::uint64_t Plan::key_of(const ResultRef& result) const {
    Key key;
    for (const Pass& pass : passes_)
        if (!pass.only_saves_work && std::ranges::find(pass.writes, result) != pass.writes.end()) key.add(pass.key);
    return key.value();
}

bool Plan::is_current(const ResultRef& result) const {
    return std::ranges::all_of(passes_, [&](const Pass& pass) {
        const bool writes = pass.unneeded.empty() && std::ranges::find(pass.writes, result) != pass.writes.end();
        return !writes || (pass.cached && *pass.cached == pass.key && !pass.is_incomplete);
    });
}

const PassInfo* FrameResult::pass(std::string_view name) const {
    const auto found = std::ranges::find(passes, name, &PassInfo::name);
    return found == passes.end() ? nullptr : &*found;
}

const PassInfo* FrameResult::pass(Result makes) const {
    const auto found = std::ranges::find(passes, std::optional(makes), &PassInfo::makes);
    return found == passes.end() ? nullptr : &*found;
}

}  // namespace si
