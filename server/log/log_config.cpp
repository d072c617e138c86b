#include "server/log/log_config.h"

#include <algorithm>
#include <cstdlib>
#include <fmt/format.h>
#include <memory>
#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/sinks/stdout_sinks.h>
#include <spdlog/spdlog.h>
#include <unistd.h>

#include "server/log/journal.h"
#include "server/log/line_formats.h"
#include "server/log/log.h"
#include "server/log/recent_sink.h"
#include "server/log/spdlog_level.h"

namespace scree {

namespace {

spdlog::sink_ptr sink_of(LogFormat format, const std::string& program) {
  if (format == LogFormat::json) {
    auto sink = std::make_shared<spdlog::sinks::stderr_sink_mt>();
    sink->set_formatter(json_lines());
    return sink;
  }
  if (is_journal(std::getenv("JOURNAL_STREAM"), STDERR_FILENO)) return journal_sink(program);
  auto sink = std::make_shared<spdlog::sinks::stderr_color_sink_mt>();
  sink->set_formatter(text_lines());
  return sink;
}

}  // namespace

Result<void> add_level(LogConfig& config, const std::string& text) {
  const size_t equals = text.find('=');
  const std::string level_name = equals == std::string::npos ? text : text.substr(equals + 1);
  const auto level = kind_named<LogLevel>(level_name);
  if (!level)
    return fail(fmt::format("there is no level '{}': {}", level_name, listed(kind_names<LogLevel>)));
  if (equals == std::string::npos) {
    config.level = *level;
    return {};
  }
  const auto part = kind_named<LogPart>(text.substr(0, equals));
  if (!part)
    return fail(fmt::format("there is no part '{}' of the log: {}", text.substr(0, equals),
                            listed(kind_names<LogPart>)));
  config.parts[static_cast<size_t>(*part)] = *level;
  return {};
}

void set_levels(const LogConfig& config) {
  LogLevel least = config.level;
  for (const LogPart part : all_kinds<LogPart>) {
    const LogLevel level = config.parts[static_cast<size_t>(part)].value_or(config.level);
    set_least(part, level);
    least = std::min(least, level);
  }
  spdlog::default_logger()->set_level(spdlog_level(least));
}

void begin_log(const LogConfig& config, const std::string& program) {
  spdlog::set_default_logger(std::make_shared<spdlog::logger>(
      program, spdlog::sinks_init_list{sink_of(config.format, program), recent_sink()}));
  set_levels(config);
}

}  // namespace scree
