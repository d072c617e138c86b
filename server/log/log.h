// Lines for the log of the server's programs. Each is of a part, and may be about a session. From any thread.
//
// A line goes to spdlog's default logger: until begin_log() (log_config.h) that is spdlog's own, and tests
// put one of theirs in its place.
#pragma once

#include <cstdint>
#include <fmt/format.h>
#include <string_view>
#include <utility>

#include "server/log/log_part.h"

namespace scree {

/// What a line is about.
struct LogSubject {
  LogPart part = LogPart::app;
  uint64_t session = 0;  ///< 0: none
};

class PartLog {
 public:
  explicit PartLog(LogSubject subject) : subject_(subject) {}

  /// Whether lines of this level are written.
  bool takes(LogLevel level) const;
  /// `level` is none but `off`.
  void write(LogLevel level, std::string_view line) const;

  template <typename... Values>
  void debug(fmt::format_string<Values...> line, Values&&... values) const {
    compose(LogLevel::debug, line, std::forward<Values>(values)...);
  }
  template <typename... Values>
  void info(fmt::format_string<Values...> line, Values&&... values) const {
    compose(LogLevel::info, line, std::forward<Values>(values)...);
  }
  template <typename... Values>
  void warn(fmt::format_string<Values...> line, Values&&... values) const {
    compose(LogLevel::warn, line, std::forward<Values>(values)...);
  }
  template <typename... Values>
  void error(fmt::format_string<Values...> line, Values&&... values) const {
    compose(LogLevel::error, line, std::forward<Values>(values)...);
  }

 private:
  template <typename... Values>
  void compose(LogLevel level, fmt::format_string<Values...> line, Values&&... values) const {
    if (takes(level)) write(level, fmt::format(line, std::forward<Values>(values)...));
  }

  LogSubject subject_;
};

inline PartLog log_of(LogPart part, uint64_t session = 0) {
  return PartLog({part, session});
}

/// The lowest level that is written of a part; at first all that the default logger takes.
void set_least(LogPart part, LogLevel level);

/// For what formats lines: the subject of the line that this thread is writing.
LogSubject subject_of_line();

}  // namespace scree
