// What happened, in lines a person reads; repeated lines are counted.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace si {

enum class LogKind { Info, Warning, Error };

struct LogLine {
    LogKind kind = LogKind::Info;
    std::string text;
    int count = 1;
};

class Log {
public:
    void add(LogKind kind, std::string_view text);
    void clear();
    const std::vector<LogLine>& lines() const { return lines_; }
    /// Errors added since the log was last looked at.
    int unseen_errors() const { return unseen_; }
    void seen() { unseen_ = 0; }

private:
    static constexpr std::size_t kLimit = 1000;
    std::vector<LogLine> lines_;
    int unseen_ = 0;
};

}  // namespace si
