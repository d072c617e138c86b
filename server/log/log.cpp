#include "server/log/log.h"

#include <array>
#include <atomic>
#include <spdlog/spdlog.h>

#include "server/log/spdlog_level.h"
#include "shared/base/check.h"

namespace scree {

namespace {

// A process has one log, as spdlog has one default logger.
std::array<std::atomic<LogLevel>, kind_count<LogPart>> least_levels{};
thread_local LogSubject subject_now;  // spdlog formats and writes a line in the thread that says it

std::atomic<LogLevel>& least_of(LogPart part) {
  CHECK(is_known(part));
  return least_levels[static_cast<size_t>(part)];
}

}  // namespace

bool PartLog::takes(LogLevel level) const {
  return level >= least_of(subject_.part).load(std::memory_order_relaxed) &&
         spdlog::default_logger_raw()->should_log(spdlog_level(level));
}

void PartLog::write(LogLevel level, std::string_view line) const {
  CHECK(level < LogLevel::off);
  if (!takes(level)) return;
  subject_now = subject_;
  spdlog::default_logger_raw()->log(spdlog_level(level), spdlog::string_view_t(line.data(), line.size()));
  subject_now = {};
}

void set_least(LogPart part, LogLevel level) {
  least_of(part).store(level, std::memory_order_relaxed);
}

LogSubject subject_of_line() {
  return subject_now;
}

}  // namespace scree
