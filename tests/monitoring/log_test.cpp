// The log: parts and their levels, lines as text, as JSON and in systemd's journal.
#include "server/log/log.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <poll.h>
#include <regex>
#include <sstream>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>

#include "server/log/journal.h"
#include "server/log/line_formats.h"
#include "server/log/log_config.h"
#include "tests/support/background_program.h"
#include "tests/support/captured_log.h"
#include "tests/support/holds.h"
#include "tests/support/patience.h"
#include "tests/support/run_program.h"
#include "tests/support/test_folder.h"

namespace scree {
namespace {

/// What a line looks like; all parts write all levels.
std::string written(std::unique_ptr<spdlog::formatter> looks, const std::function<void()>& say) {
  std::ostringstream text;
  const auto sink = std::make_shared<spdlog::sinks::ostream_sink_mt>(text);
  sink->set_formatter(std::move(looks));
  const auto before = spdlog::default_logger();
  spdlog::set_default_logger(std::make_shared<spdlog::logger>("test", sink));
  say();
  spdlog::set_default_logger(before);
  return text.str();
}

TEST(Log, text_has_time_part_level_and_line) {
  const std::string line =
      written(text_lines(), [] { log_of(LogPart::net, 17).warn("session {}: {}", 17, "gone"); });
  EXPECT_TRUE(std::regex_match(
      line,
      std::regex(
          R"(\[\d{4}-\d\d-\d\dT\d\d:\d\d:\d\d\.\d{3}[+-]\d\d:?\d\d\] \[net\] \[warning\] session 17: gone\n)")))
      << line;
}

TEST(Log, json_is_an_object_a_line_with_the_session_where_there_is_one) {
  const std::string lines = written(json_lines(), [] {
    log_of(LogPart::net, 17).error("\"a\"\nb \xff");
    log_of(LogPart::store).info("saved");
  });
  std::istringstream split(lines);
  std::string first, second, third;
  std::getline(split, first);
  std::getline(split, second);
  EXPECT_FALSE(std::getline(split, third)) << third;
  const auto about = nlohmann::json::parse(first);
  EXPECT_EQ(about["level"], "error");
  EXPECT_EQ(about["part"], "net");
  EXPECT_EQ(about["session"], 17);
  EXPECT_EQ(about["message"], "\"a\"\nb \xef\xbf\xbd") << "bytes that are no text are shown as such";
  EXPECT_TRUE(std::regex_match(about["time"].get<std::string>(),
                               std::regex(R"(\d{4}-\d\d-\d\dT[\d:.]{12}[+-][\d:]+)")));
  const auto plain = nlohmann::json::parse(second);
  EXPECT_EQ(plain["level"], "info");
  EXPECT_FALSE(plain.contains("session"));
}

TEST(Log, a_part_has_a_level_of_its_own) {
  CapturedLog log;
  spdlog::default_logger()->set_level(spdlog::level::trace);
  for (const LogPart part : all_kinds<LogPart>) set_least(part, LogLevel::warn);
  set_least(LogPart::rules, LogLevel::debug);
  set_least(LogPart::web, LogLevel::off);
  log_of(LogPart::net).info("not this");
  log_of(LogPart::net).warn("but this");
  log_of(LogPart::rules).debug("and this");
  log_of(LogPart::web).error("never this");
  for (const LogPart part : all_kinds<LogPart>) set_least(part, LogLevel::trace);
  EXPECT_EQ(log.count("this"), 2U) << log.text();
  EXPECT_TRUE(holds(log.text(), "but this") && holds(log.text(), "and this")) << log.text();
}

TEST(Log, levels_are_read_for_all_parts_and_for_one) {
  LogConfig config;
  ASSERT_TRUE(add_level(config, "net=debug"));
  ASSERT_TRUE(add_level(config, "warn"));
  ASSERT_TRUE(add_level(config, "store=off"));
  EXPECT_EQ(config.level, LogLevel::warn);
  EXPECT_EQ(config.parts[static_cast<size_t>(LogPart::net)], LogLevel::debug);
  EXPECT_EQ(config.parts[static_cast<size_t>(LogPart::store)], LogLevel::off);
  EXPECT_FALSE(config.parts[static_cast<size_t>(LogPart::rules)].has_value());
}

TEST(Log, a_bad_level_or_part_is_refused_with_the_list) {
  LogConfig config;
  EXPECT_EQ(add_level(config, "loud").error().message,
            "there is no level 'loud': trace, debug, info, warn, error or off");
  EXPECT_EQ(add_level(config, "net=").error().message,
            "there is no level '': trace, debug, info, warn, error or off");
  const std::string part = add_level(config, "sound=debug").error().message;
  EXPECT_TRUE(holds(part, "there is no part 'sound' of the log: app, world,")) << part;
}

TEST(Log, the_journal_is_known_by_device_and_inode) {
  const TestFolder folder;
  const int file = ::open((folder / "file").c_str(), O_RDWR | O_CREAT, 0600);
  struct stat what {};
  ASSERT_EQ(::fstat(file, &what), 0);
  const std::string stream = std::to_string(what.st_dev) + ":" + std::to_string(what.st_ino);
  EXPECT_TRUE(is_journal(stream.c_str(), file));
  EXPECT_FALSE(is_journal((stream + "1").c_str(), file)) << "standard error was sent elsewhere";
  EXPECT_FALSE(is_journal("nonsense", file));
  EXPECT_FALSE(is_journal(nullptr, file));
  ::close(file);
}

/// The server's options, by its program.
std::pair<int, std::string> run_server(const std::string& options, const std::string& variables = "") {
  return run_program(variables + " " + SCREE_SERVER_PROGRAM " --port 0 --ticks 1 --web off " + options);
}

TEST(LogOptions, choose_format_and_levels) {
  const auto [status, lines] = run_server("--log-format json --log warn --log app=info");
  EXPECT_EQ(status, 0) << lines;
  EXPECT_TRUE(holds(lines, "\"part\":\"app\",\"message\":\"1 ticks,")) << lines;
  EXPECT_FALSE(holds(lines, "\"level\":\"info\",\"part\":\"net\"")) << lines;
  const auto [by_variable, text] = run_server("", "SCREE_LOG=[off,app=info] SCREE_LOG_FORMAT=text");
  EXPECT_EQ(by_variable, 0) << text;
  EXPECT_TRUE(holds(text, "] [app] [info] 1 ticks,")) << text;
}

TEST(LogOptions, refuse_what_there_is_not) {
  for (const char* bad : {"--log loud", "--log sound=debug", "--log-format xml", "--log net=debug=info"}) {
    const auto [status, said] = run_server(bad);
    EXPECT_EQ(status, 2) << bad;
    EXPECT_TRUE(holds(said, "--log")) << said;
  }
}

/// The fields of an entry, "NAME=value" a line; values with ends of lines have another form.
std::vector<std::string> receive_entry(int socket) {
  pollfd waiting{socket, POLLIN, 0};
  if (::poll(&waiting, 1, static_cast<int>(patience.count() * 1000)) <= 0) return {};
  std::vector<char> bytes(65536);
  const ssize_t count = ::recv(socket, bytes.data(), bytes.size(), 0);
  std::istringstream text(std::string(bytes.data(), count > 0 ? static_cast<size_t>(count) : 0));
  std::vector<std::string> fields;
  for (std::string line; std::getline(text, line);) fields.push_back(line);
  return fields;
}

/// A journal of the test's own, where the server finds systemd's.
TEST(LogOptions, write_to_the_journal_with_fields_where_standard_error_leads_there) {
  const TestFolder folder;
  const int socket = ::socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  const std::string path = folder / "socket";
  ASSERT_LT(path.size(), sizeof address.sun_path);
  std::copy(path.begin(), path.end(), address.sun_path);
  ASSERT_EQ(::bind(socket, reinterpret_cast<const sockaddr*>(&address), sizeof address), 0);
  const std::string stderr_path = folder / "stderr";
  const auto [status, said] =
      run_program("touch " + stderr_path + " && JOURNAL_STREAM=$(stat -c %d:%i " + stderr_path +
                  ") bwrap --dev-bind / / --tmpfs /run --bind " + (folder / "") +
                  " /run/systemd/journal " SCREE_SERVER_PROGRAM
                  " --port 0 --ticks 1 --web off --log off --log app=info 2>" +
                  stderr_path + " >&2");
  ASSERT_EQ(status, 0) << said;
  std::vector<std::string> fields;
  bool found = false;
  while (!found && !(fields = receive_entry(socket)).empty())
    found = std::ranges::any_of(
        fields, [](const std::string& field) { return field.starts_with("MESSAGE=1 ticks,"); });
  ASSERT_TRUE(found);
  const auto has = [&](const std::string& field) { return std::ranges::find(fields, field) != fields.end(); };
  EXPECT_TRUE(has("PRIORITY=6"));
  EXPECT_TRUE(has("SCREE_PART=app"));
  EXPECT_TRUE(has("SYSLOG_IDENTIFIER=scree-server"));
  EXPECT_FALSE(std::ranges::any_of(
      fields, [](const std::string& field) { return field.starts_with("SCREE_SESSION="); }));
  ::close(socket);
}

}  // namespace
}  // namespace scree
