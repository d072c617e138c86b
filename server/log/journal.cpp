#include "server/log/journal.h"

#include <array>
#include <charconv>
#include <cstring>
#include <fmt/format.h>
#include <mutex>
#include <spdlog/sinks/base_sink.h>
#include <sys/stat.h>
#include <sys/uio.h>
#include <syslog.h>

#define SD_JOURNAL_SUPPRESS_LOCATION  // the line's place in the sources is log.cpp, always
#include <systemd/sd-journal.h>

#include "server/log/log.h"
#include "server/log/spdlog_level.h"

namespace scree {

namespace {

int priority_of(LogLevel level) {
  switch (level) {
    case LogLevel::trace:
    case LogLevel::debug:
    case LogLevel::off:
      return LOG_DEBUG;
    case LogLevel::info:
      return LOG_INFO;
    case LogLevel::warn:
      return LOG_WARNING;
    case LogLevel::error:
      return LOG_ERR;
  }
  return LOG_ERR;
}

class JournalSink final : public spdlog::sinks::base_sink<std::mutex> {
 public:
  explicit JournalSink(std::string program) : program_(std::move(program)) {}

 private:
  void sink_it_(const spdlog::details::log_msg& line) override {
    const LogSubject subject = subject_of_line();
    std::array<std::string, 5> fields{
        fmt::format("MESSAGE={}", std::string_view(line.payload.data(), line.payload.size())),
        fmt::format("PRIORITY={}", priority_of(log_level(line.level))),
        "SYSLOG_IDENTIFIER=" + program_,
        fmt::format("SCREE_PART={}", name_of(subject.part)),
        fmt::format("SCREE_SESSION={}", subject.session),
    };
    std::array<iovec, fields.size()> parts{};
    for (size_t i = 0; i < fields.size(); ++i) parts[i] = {fields[i].data(), fields[i].size()};
    // Nobody is left to tell of a journal that takes nothing.
    static_cast<void>(
        sd_journal_sendv(parts.data(), static_cast<int>(parts.size()) - (subject.session == 0)));
  }
  void flush_() override {}

  const std::string program_;
};

}  // namespace

bool is_journal(const char* stream, int descriptor) {
  if (stream == nullptr) return false;
  struct stat file {};
  if (::fstat(descriptor, &file) != 0) return false;
  return fmt::format("{}:{}", file.st_dev, file.st_ino) == stream;
}

spdlog::sink_ptr journal_sink(const std::string& program) {
  return std::make_shared<JournalSink>(program);
}

}  // namespace scree
