// Messages for the user. Repeated lines are counted.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace si {

enum class LogKind { Info, Warning, Error };

/// Message of the editor's log, with the number of its repetitions.
struct LogLine {
    LogKind kind = LogKind::Info;
    std::string text;
    int count = 1;  ///< times that it was added in a row
};

/// Log of the last 1000 messages for the user, oldest first.
class Log {
public:
    /// Adds a message to the log. A repetition of the last message only raises that message's count.
    void add(LogKind kind, std::string_view text);
    /// Removes all messages from the log.
    void clear();
    /// Returns the messages of the log, oldest first.
    const std::vector<LogLine>& lines() const { return lines_; }
    /// Returns the number of messages that were ever added, repetitions included.
    int added() const { return added_; }
    /// Returns the number of errors that were added since mark_seen().
    int unseen_errors() const { return unseen_; }
    /// Marks all messages as seen by the user, so that unseen_errors() counts from 0.
    void mark_seen() { unseen_ = 0; }

private:
    static constexpr std::size_t kLimit = 1000;
    std::vector<LogLine> lines_;
    int unseen_ = 0;
    int added_ = 0;
};

}  // namespace si
