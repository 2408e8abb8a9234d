#include "renderer/gltf/context.h"

#include <fmt/format.h>

#include <algorithm>

#include "renderer/base/error.h"
#include "renderer/base/printable.h"

namespace si::gltf {

std::string Place::text() const {
    std::string out = up ? up->text() + "." : std::string();
    out += printable(name, 60);
    if (index >= 0) out += fmt::format("[{}]", index);
    return out;
}

Context::Context(const std::filesystem::path& path, const GltfOptions& options, std::vector<std::string>& warnings)
    : path_(path), options_(options), warnings_(warnings) {}

void Context::fail(const Place& place, std::string_view what, std::string_view fix) const {
    throw Error(fmt::format("{}: {}: {}; {}", printable(path_.string(), 300), place.text(), printable(what, 300), fix));
}

void Context::fail(std::string_view what, std::string_view fix) const {
    throw Error(fmt::format("{}: {}; {}", printable(path_.string(), 300), printable(what, 300), fix));
}

void Context::warn(const Place& place, std::string_view what) {
    if (warnings_.size() >= 100) {
        ++not_kept_;
        return;
    }
    warnings_.push_back(fmt::format("{}: {}", place.text(), printable(what, 300)));
}

void Context::warn(std::string_view what) {
    if (warnings_.size() >= 100) {
        ++not_kept_;
        return;
    }
    warnings_.push_back(printable(what, 300));
}

void Context::close_warnings() {
    if (not_kept_ > 0) warnings_.push_back(fmt::format("{} more warnings of this file are not listed", not_kept_));
    not_kept_ = 0;
}

void Context::note_file(const std::filesystem::path& path) {
    if (std::ranges::find(files_, path, &StampedFile::path) == files_.end()) files_.push_back(stamped(path));
}

void Context::progress(double fraction) {
    shown_ = std::max(shown_, fraction);
    if (options_.progress && !options_.progress(shown_)) throw Error("cancelled");
}

}  // namespace si::gltf
