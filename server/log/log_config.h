// How the log of a program of the server's side looks, and how much it tells.
//
// As text a line is "[2026-11-30T12:00:00.000+0100] [net] [info] session 17: …". As JSON it is an object with
// time, level, part, message, and session where the line is about one. Where standard error leads to
// systemd's journal, text goes there by the journal's own protocol, with the fields PRIORITY, SCREE_PART and
// SCREE_SESSION.
#pragma once

#include <array>
#include <optional>
#include <string>

#include "server/log/log_part.h"

namespace scree {

enum class LogFormat : uint8_t { text, json };

struct LogFormatRow {
  std::string_view name;
};

constexpr LogFormatRow row_of(LogFormat format) {
  switch (format) {
    case LogFormat::text:
      return {"text"};
    case LogFormat::json:
      return {"json"};
  }
  return {};
}

struct LogConfig {
  LogFormat format = LogFormat::text;
  LogLevel level = LogLevel::info;                                 ///< of parts without one of their own
  std::array<std::optional<LogLevel>, kind_count<LogPart>> parts;  ///< by part
};

/// "debug" for all parts, or "net=debug" for one. The error lists the levels, or the parts.
Result<void> add_level(LogConfig& config, const std::string& text);

/// Changes how much is told from now on.
void set_levels(const LogConfig& config);

/// From now on the process's log is as configured; `program` names it in the journal. Before other threads
/// write lines.
void begin_log(const LogConfig& config, const std::string& program);

}  // namespace scree
