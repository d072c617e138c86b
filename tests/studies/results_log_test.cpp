// Results of a long study that are kept: a run goes on, and no wrong result is used.
#include "studies/matrix/results_log.h"

#include <array>
#include <filesystem>
#include <gtest/gtest.h>
#include <limits>
#include <sstream>

#include "tests/support/test_folder.h"

namespace scree {
namespace {

const ResultsIdentity ours{"build", "machine", "full"};

struct Pair {
  double a = 0.0;
  double b = 0.0;

  static constexpr auto fields() {
    return std::array{FigureField<Pair>{"a", &Pair::a}, FigureField<Pair>{"b", &Pair::b}};
  }
};

std::string text_in(const std::string& path) {
  std::ostringstream text;
  text << std::ifstream(path, std::ios::binary).rdbuf();
  return text.str();
}

/// Measures `what`, or takes it from the file; counts the measurements.
double value_of(ResultsLog& log, const std::string& what, int& measured) {
  const auto pair = read_or_measure<Pair>(log, what, [&]() -> Result<Pair> {
    ++measured;
    return Pair{static_cast<double>(what.size()), 0.1};
  });
  EXPECT_TRUE(pair);
  EXPECT_EQ(pair->b, 0.1);
  return pair->a;
}

class ResultsLogTest : public testing::Test {
 protected:
  ResultsLogTest() : path_(folder_ / "study/results.jsonl") {}

  ResultsLog open(const ResultsIdentity& identity = ours) const {
    Result<ResultsLog> log = ResultsLog::open(path_, identity);
    EXPECT_TRUE(log) << log.error().message;
    return std::move(*log);
  }
  void write(const std::string& text) const { std::ofstream(path_, std::ios::binary) << text; }
  /// Two results are in the file.
  void log_two() const {
    int measured = 0;
    ResultsLog log = open();
    value_of(log, "one", measured);
    value_of(log, "three", measured);
    EXPECT_EQ(measured, 2);
  }

  TestFolder folder_;
  std::string path_;
};

TEST_F(ResultsLogTest, another_run_goes_on_and_measures_nothing_twice) {
  log_two();
  ResultsLog log = open();
  EXPECT_EQ(log.begun_anew(), "");
  EXPECT_EQ(log.count(), 2U);
  int measured = 0;
  EXPECT_EQ(value_of(log, "one", measured), 3.0);
  EXPECT_EQ(value_of(log, "three", measured), 5.0);
  EXPECT_EQ(measured, 0);
  EXPECT_EQ(value_of(log, "eleven", measured), 6.0);
  EXPECT_EQ(measured, 1);
  EXPECT_EQ(open().count(), 3U);
}

TEST_F(ResultsLogTest, a_line_that_was_being_written_is_measured_again) {
  log_two();
  const std::string text = text_in(path_);
  for (size_t cut = text.rfind("{\"of\""); cut < text.size(); ++cut) {
    write(text.substr(0, cut));
    ResultsLog log = open();
    EXPECT_EQ(log.begun_anew(), "") << cut;
    EXPECT_EQ(log.count(), 1U) << cut;
    int measured = 0;
    value_of(log, "three", measured);
    EXPECT_EQ(measured, 1);
    EXPECT_EQ(text_in(path_), text) << "nothing of the broken line is left";
  }
}

TEST_F(ResultsLogTest, a_damaged_file_is_said_and_begun_anew) {
  log_two();
  const std::string text = text_in(path_);
  const size_t second = text.find('\n') + 1;
  for (const std::string& damaged :
       {std::string("nonsense\n"), text.substr(0, second) + "{\"of\":1}\n" + text.substr(second),
        text.substr(0, second) + "{\"of\":\"one\",\"figures\":{\"a\":\"x\"}}\n", text.substr(1),
        std::string("no end of a line"), text + "\n"}) {
    write(damaged);
    ResultsLog log = open();
    EXPECT_NE(log.begun_anew().find(path_), std::string::npos) << damaged;
    EXPECT_EQ(log.count(), 0U) << damaged;
    EXPECT_EQ(open().begun_anew(), "") << "the new one is whole";
  }
}

TEST_F(ResultsLogTest, results_of_another_build_machine_or_plan_are_not_used) {
  for (const ResultsIdentity& other :
       {ResultsIdentity{"b", "machine", "full"}, {"build", "m", "full"}, {"build", "machine", "quick"}}) {
    std::filesystem::remove(path_);
    log_two();
    const ResultsLog log = open(other);
    EXPECT_NE(log.begun_anew(), "");
    EXPECT_EQ(log.count(), 0U);
  }
}

TEST_F(ResultsLogTest, a_result_without_all_its_figures_is_measured_again) {
  ResultsLog log = open();
  ASSERT_TRUE(log.add("one", {{"a", 3.0}}));
  int measured = 0;
  EXPECT_EQ(value_of(log, "one", measured), 3.0);
  EXPECT_EQ(measured, 1);
}

TEST_F(ResultsLogTest, what_is_no_number_is_an_error_and_so_is_a_place_that_cannot_be_written) {
  ResultsLog log = open();
  EXPECT_FALSE(log.add("one", {{"a", std::numeric_limits<double>::quiet_NaN()}}));
  EXPECT_EQ(open().count(), 0U);
  EXPECT_FALSE(ResultsLog::open("/proc/none/results.jsonl", ours));
}

}  // namespace
}  // namespace scree
