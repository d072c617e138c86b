// The child process that reads foreign files: values and requests pass, and each way to end becomes words.
#include "tools/import/process/reader_process.h"

#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <numeric>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>

#include "tests/support/test_folder.h"
#include "tools/import/process/sanitized.h"
#include "tools/import/process/time_limit.h"

namespace scree {
namespace {

/// The error that the import sees when the child does that.
std::string end_of(const ReaderProcess::Work& work, const ReaderLimits& bounds = {}) {
  auto reader = ReaderProcess::start("libthing", bounds, work);
  if (!reader) return "not started: " + reader.error().message;
  const auto number = (*reader)->get<int>();
  return number ? "an answer" : number.error().message;
}

TEST(ReaderProcess, answers_requests_with_values) {
  std::vector<double> many(300'000);
  std::iota(many.begin(), many.end(), 0.5);
  auto reader = ReaderProcess::start("libthing", {}, [&](ReaderChannel& channel) -> Result<void> {
    TRY(channel.put_text("words"));
    TRY(channel.put_list(many));
    TRY(channel.flush());
    while (true) {
      const int row = TRY(channel.get<int>());
      if (row < 0) return {};
      TRY(channel.put(row * 2));
      TRY(channel.flush());
    }
  });
  ASSERT_TRUE(reader);
  EXPECT_EQ((*reader)->get_text().value(), "words");
  EXPECT_EQ((*reader)->get_list<double>(many.size()).value(), many);
  for (const int row : {7, 8, 9}) {
    ASSERT_TRUE((*reader)->put(row) && (*reader)->flush());
    EXPECT_EQ((*reader)->get<int>().value(), 2 * row);
  }
}

TEST(ReaderProcess, ends_of_every_kind_become_words) {
  const auto has = [](const std::string& words, const char* part) {
    return words.find(part) == std::string::npos ? words : std::string();
  };
  EXPECT_EQ(end_of([](ReaderChannel&) -> Result<void> { return fail("row 3 is cut off"); }),
            "row 3 is cut off");
  EXPECT_EQ(
      end_of([](ReaderChannel&) -> Result<void> { throw std::runtime_error("thrown"); }),
      "libthing failed on it: the file is damaged, or of a form that libthing does not read well (thrown)");
  EXPECT_EQ(has(end_of([](ReaderChannel&) -> Result<void> { throw std::bad_alloc(); }), "--memory-max"), "");
  EXPECT_EQ(has(end_of([](ReaderChannel&) -> Result<void> { _exit(5); }), "status 5"), "");
  EXPECT_EQ(has(end_of([](ReaderChannel&) -> Result<void> { return {}; }), "without an answer"), "");
  // Sanitizers make an exit of some signals.
  EXPECT_EQ(has(end_of([](ReaderChannel&) -> Result<void> { std::abort(); }), "libthing ended "), "");
  EXPECT_EQ(has(end_of([](ReaderChannel&) -> Result<void> {
                  std::raise(SIGSEGV);
                  return {};
                }),
                "libthing ended "),
            "");
  EXPECT_EQ(has(end_of([](ReaderChannel&) -> Result<void> {
                  std::raise(SIGKILL);
                  return {};
                }),
                "killed"),
            "");
}

TEST(ReaderProcess, words_of_a_file_do_not_steer_a_terminal) {
  const std::string hostile = "a\x1B[31mb\xFF", shown = "a [31mb?";
  EXPECT_EQ(end_of([&](ReaderChannel&) -> Result<void> { return fail(hostile); }), shown);
  auto reader = ReaderProcess::start(
      "libthing", {}, [&](ReaderChannel& channel) -> Result<void> { return channel.put_text(hostile); });
  ASSERT_TRUE(reader);
  EXPECT_EQ((*reader)->get_text().value(), shown);
}

TEST(ReaderProcess, reaches_no_network) {
  const std::string end = end_of([](ReaderChannel&) -> Result<void> {
    if (::prctl(PR_GET_SECCOMP) == 0) return fail("no filter");
    if (::socket(AF_INET, SOCK_STREAM, 0) < 0) return fail("no socket");
    return fail("a socket");
  });
  if (end == "no filter") GTEST_SKIP() << "this kernel has no filters of system calls";
  EXPECT_EQ(end, "no socket");
  const int here = ::socket(AF_INET, SOCK_STREAM, 0);
  EXPECT_GE(here, 0) << "the import itself may";
  ::close(here);
}

TEST(ReaderProcess, after_its_end_there_are_only_errors) {
  const pid_t other = ::fork();  // a child that is not the reader's to wait for
  if (other == 0) ::_exit(7);
  {
    auto reader = ReaderProcess::start(
        "libthing", {}, [](ReaderChannel&) -> Result<void> { return fail("row 3 is cut off"); });
    ASSERT_TRUE(reader);
    EXPECT_FALSE((*reader)->get<int>());
    EXPECT_EQ((*reader)->get<int>().error().message, "libthing has ended, and reads no more of it");
  }
  int status = 0;
  EXPECT_EQ(::waitpid(other, &status, 0), other);
  EXPECT_EQ(WEXITSTATUS(status), 7);
}

TEST(ReaderProcess, limits_of_time_and_memory_end_it) {
  const auto late = [](ReaderChannel&) -> Result<void> {
    while (true) ::pause();
  };
  EXPECT_NE(end_of(late, {.time = std::chrono::milliseconds(50)}).find("within 0.05 s"), std::string::npos);
  if (is_sanitized) return;
  const auto greedy = [](ReaderChannel& channel) -> Result<void> {
    std::vector<std::vector<char>> all;
    while (all.size() < 4096) all.emplace_back(size_t{1} << 20U);
    return channel.put(1);
  };
  EXPECT_NE(end_of(greedy, {.memory_bytes = uint64_t{64} << 20U}).find("--memory-max"), std::string::npos);
}

TEST(ReaderProcess, more_values_than_agreed_are_refused) {
  const auto sends = [](uint64_t count) {
    return [count](ReaderChannel& channel) -> Result<void> {
      TRY(channel.put(count));
      return channel.put(1);
    };
  };
  auto many = ReaderProcess::start("libthing", {}, sends(uint64_t{1} << 60U));
  EXPECT_FALSE((*many)->get_list<double>(1000));
  auto promised = ReaderProcess::start("libthing", {}, sends(uint64_t{1} << 40U));
  EXPECT_FALSE((*promised)->get_list<double>(uint64_t{1} << 50U)) << "its values do not come";
}

TEST(ReaderProcess, dies_with_its_owner) {
  pid_t child = 0;
  {
    auto reader = ReaderProcess::start("libthing", {}, [](ReaderChannel& channel) -> Result<void> {
      TRY(channel.put(::getpid()));
      TRY(channel.flush());
      while (true) ::pause();
    });
    child = (*reader)->get<pid_t>().value();
    EXPECT_TRUE(std::filesystem::exists("/proc/" + std::to_string(child)));
  }
  EXPECT_FALSE(std::filesystem::exists("/proc/" + std::to_string(child)));
}

// ---- limits of time

TEST(TimeLimit, ends_the_program_in_words_and_removes_what_is_unfinished) {
  const TestFolder folder;
  const std::string unfinished = folder / "unfinished";
  std::ofstream(unfinished) << "half";
  EXPECT_EXIT(
      {
        const TimeLimit limit(std::chrono::milliseconds(50), "too late", unfinished);
        std::this_thread::sleep_for(std::chrono::minutes(10));
      },
      testing::ExitedWithCode(1), "too late");
  EXPECT_FALSE(std::filesystem::exists(unfinished));
}

TEST(TimeLimit, that_is_over_ends_nothing) {
  const TestFolder folder;
  { const TimeLimit limit(std::chrono::milliseconds(20), "too late", folder / "none"); }
  std::this_thread::sleep_for(std::chrono::milliseconds(60));
  { const TimeLimit again(std::chrono::hours(1), "too late", folder / "none"); }
}

}  // namespace
}  // namespace scree
