#include "ui/state/log.h"

namespace si {

void Log::add(LogKind kind, std::string_view text) {
    ++added_;
    if (kind == LogKind::Error) ++unseen_;
    if (!lines_.empty() && lines_.back().kind == kind && lines_.back().text == text) {
        ++lines_.back().count;
        return;
    }
    if (lines_.size() == kLimit) lines_.erase(lines_.begin());
    lines_.push_back({kind, std::string(text), 1});
}

void Log::clear() {
    lines_.clear();
    unseen_ = 0;
}

}  // namespace si
