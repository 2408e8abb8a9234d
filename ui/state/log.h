// Messages for the user. Repeated lines are counted.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace si {

enum class LogKind { Info, Warning, Error };

/// One message.
struct LogLine {
    LogKind kind = LogKind::Info;
    std::string text;
    int count = 1;  ///< times that it was added in a row
};

/// The last messages, oldest first.
class Log {
public:
    void add(LogKind kind, std::string_view text);
    void clear();
    const std::vector<LogLine>& lines() const { return lines_; }
    /// Returns the number of errors that were added since seen().
    int unseen_errors() const { return unseen_; }
    /// Marks all messages as seen.
    void seen() { unseen_ = 0; }

private:
    static constexpr std::size_t kLimit = 1000;
    std::vector<LogLine> lines_;
    int unseen_ = 0;
};

}  // namespace si
