// Our levels and spdlog's.
#pragma once

#include <spdlog/common.h>

#include "server/log/log_part.h"

namespace scree {

constexpr spdlog::level::level_enum spdlog_level(LogLevel level) {
  switch (level) {
    case LogLevel::trace:
      return spdlog::level::trace;
    case LogLevel::debug:
      return spdlog::level::debug;
    case LogLevel::info:
      return spdlog::level::info;
    case LogLevel::warn:
      return spdlog::level::warn;
    case LogLevel::error:
      return spdlog::level::err;
    case LogLevel::off:
      return spdlog::level::off;
  }
  return spdlog::level::off;
}

constexpr LogLevel log_level(spdlog::level::level_enum level) {
  for (const LogLevel each : all_kinds<LogLevel>)
    if (spdlog_level(each) == level) return each;
  return LogLevel::error;  // spdlog's `critical`
}

}  // namespace scree
