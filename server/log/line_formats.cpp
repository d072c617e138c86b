#include "server/log/line_formats.h"

#include <nlohmann/json.hpp>
#include <spdlog/pattern_formatter.h>
#include <string>

#include "server/log/log.h"
#include "server/log/spdlog_level.h"

namespace scree {

namespace {

constexpr const char* time_pattern = "%Y-%m-%dT%H:%M:%S.%e%z";  // ISO 8601, with the zone

class PartFlag final : public spdlog::custom_flag_formatter {
 public:
  void format(const spdlog::details::log_msg&, const std::tm&, spdlog::memory_buf_t& to) override {
    const std::string_view part = name_of(subject_of_line().part);
    to.append(part.data(), part.data() + part.size());
  }
  std::unique_ptr<custom_flag_formatter> clone() const override { return std::make_unique<PartFlag>(); }
};

class JsonLines final : public spdlog::formatter {
 public:
  void format(const spdlog::details::log_msg& line, spdlog::memory_buf_t& to) override {
    spdlog::memory_buf_t time;
    time_.format(line, time);
    const LogSubject subject = subject_of_line();
    nlohmann::ordered_json json{{"time", std::string(time.data(), time.size())},
                                {"level", name_of(log_level(line.level))},
                                {"part", name_of(subject.part)}};
    if (subject.session != 0) json["session"] = subject.session;
    json["message"] = std::string(line.payload.data(), line.payload.size());
    // What clients call themselves is bytes.
    const std::string text = json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
    to.append(text.data(), text.data() + text.size());
  }
  std::unique_ptr<formatter> clone() const override { return std::make_unique<JsonLines>(); }

 private:
  spdlog::pattern_formatter time_{time_pattern, spdlog::pattern_time_type::local, ""};
};

}  // namespace

std::unique_ptr<spdlog::formatter> text_lines() {
  auto lines = std::make_unique<spdlog::pattern_formatter>();
  lines->add_flag<PartFlag>('*').set_pattern("[" + std::string(time_pattern) + "] [%*] [%^%l%$] %v");
  return lines;
}

std::unique_ptr<spdlog::formatter> json_lines() {
  return std::make_unique<JsonLines>();
}

}  // namespace scree
