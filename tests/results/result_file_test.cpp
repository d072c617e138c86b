// Results as files: the same value comes back, the text is stable, and whatever is wrong with a file is said.
#include "bench/results/result_file.h"

#include <cmath>
#include <fstream>
#include <gtest/gtest.h>
#include <limits>
#include <nlohmann/json.hpp>

#include "tests/support/test_folder.h"

namespace scree {
namespace {

StoredResult sample() {
  BenchReport run;
  run.metric("tick_p99_ms", 1.23456789);
  run.metric("alive", 1000.0);
  run.metric("no_number", std::numeric_limits<double>::quiet_NaN());
  run.check("pieces", true, "64 of 64\n\x1b[31m \xff");
  run.condition("gl_renderer", "llvmpipe (LLVM 15, \"256\" bits)");
  StoredResult result = summarised(ResultKind::bench, "carve", {&run, 1});
  result.options = {{"quick", "yes"}};
  result.machine = {"A Processor @ 2.9 GHz", 2, 7.7, "12.2.0", "Linux 6.1"};
  return result;
}

TEST(StoredResultTest, runs_become_their_median_least_and_most) {
  std::vector<BenchReport> runs(3);
  const double values[] = {3.0, 1.0, 2.0};
  for (size_t i = 0; i < runs.size(); ++i) {
    runs[i].metric("tick_ms", values[i]);
    runs[i].check("often", i != 1, "run " + std::to_string(i));
    runs[i].check("seldom", i == 1, "run " + std::to_string(i));
    runs[i].check("always", true, "run " + std::to_string(i));
  }
  const StoredResult result = summarised(ResultKind::bench, "carve", runs);
  EXPECT_EQ(result.runs, 3U);
  const MetricRange& range = result.metrics.at("tick_ms");
  EXPECT_EQ(range.value, 2.0);
  EXPECT_EQ(range.min, 1.0);
  EXPECT_EQ(range.max, 3.0);
  EXPECT_TRUE(result.checks.at("often").passed);
  EXPECT_EQ(result.checks.at("often").detail, "run 1 (missed in 1 of 3 runs)");
  EXPECT_FALSE(result.checks.at("seldom").passed);
  EXPECT_EQ(result.checks.at("seldom").detail, "run 2 (missed in 2 of 3 runs)");
  EXPECT_EQ(result.checks.at("always").detail, "run 2");
  EXPECT_EQ(result.missed(), 1U);
}

TEST(ResultFileTest, what_is_written_is_read_and_written_alike) {
  const StoredResult result = sample();
  const std::string text = to_json(result);
  const auto again = parse_result(text);
  ASSERT_TRUE(again) << again.error().message;
  EXPECT_EQ(to_json(*again), text);
  EXPECT_EQ(again->name, "carve");
  EXPECT_EQ(again->options, result.options);
  EXPECT_EQ(again->machine.processor, result.machine.processor);
  EXPECT_EQ(again->conditions, result.conditions);
  EXPECT_DOUBLE_EQ(again->metrics.at("tick_p99_ms").value, 1.235);
  EXPECT_EQ(again->metrics.at("alive").value, 1000.0);
  EXPECT_TRUE(std::isnan(again->metrics.at("no_number").value));
  EXPECT_TRUE(again->checks.at("pieces").passed);
}

TEST(ResultFileTest, a_metric_is_one_line_of_four_digits_in_order) {
  const std::string text = to_json(sample());
  const size_t alive = text.find("    \"alive\": {\"value\": 1000, \"min\": 1000, \"max\": 1000},\n");
  const size_t tick = text.find("    \"tick_p99_ms\": {\"value\": 1.235, \"min\": 1.235, \"max\": 1.235}\n");
  EXPECT_NE(alive, std::string::npos) << text;
  EXPECT_NE(tick, std::string::npos) << text;
  EXPECT_LT(alive, tick);
}

TEST(ResultFileTest, every_truncation_is_refused) {
  const std::string text = to_json(sample());
  for (size_t length = 0; length + 2 < text.size(); ++length)
    EXPECT_FALSE(parse_result(std::string_view(text).substr(0, length))) << length;
  EXPECT_FALSE(parse_result(text + "{}"));
}

/// The sample's document with one member replaced.
std::string with(const std::string& pointer, const nlohmann::json& value) {
  nlohmann::json document = nlohmann::json::parse(to_json(sample()));
  document[nlohmann::json::json_pointer(pointer)] = value;
  return document.dump();
}

TEST(ResultFileTest, a_fault_is_named) {
  const std::vector<std::tuple<std::string, nlohmann::json, std::string>> faults = {
      {"/format", 2, "format 2"},
      {"/format", "1", "format"},
      {"/kind", "film", "kind"},
      {"/name", "../carve", "name"},
      {"/name", "", "name"},
      {"/name", 3, "name"},
      {"/runs", 0, "runs"},
      {"/runs", -1, "runs"},
      {"/runs", 1.5, "runs"},
      {"/runs", 1000000, "runs"},
      {"/options", nullptr, "options"},
      {"/options/quick", true, "quick"},
      {"/machine", "mine", "machine"},
      {"/machine/threads", 0, "threads"},
      {"/machine/gpu", "one", "gpu"},
      {"/conditions/gl_renderer", 7, "gl_renderer"},
      {"/conditions/gl_renderer", "red \x1b[31m", "text"},
      {"/metrics", nlohmann::json::array(), "metrics"},
      {"/metrics/alive", 1000, "alive"},
      {"/metrics/alive/min", "1000", "alive"},
      {"/metrics/alive/min", nullptr, "alive"},
      {"/metrics/alive/min", 1001, "alive"},
      {"/metrics/alive/max", 999, "alive"},
      {"/metrics/alive/mean", 1000, "mean"},
      {"/checks/pieces/passed", 1, "pieces"},
      {"/checks/pieces/detail", nullptr, "pieces"},
      {"/more", 1, "more"},
  };
  for (const auto& [pointer, value, wanted] : faults) {
    const auto refused = parse_result(with(pointer, value));
    ASSERT_FALSE(refused) << pointer;
    EXPECT_NE(refused.error().message.find(wanted), std::string::npos)
        << pointer << ": " << refused.error().message;
  }
}

TEST(ResultFileTest, a_member_that_is_missing_is_named) {
  for (const char* name : {"kind", "name", "runs", "options", "machine", "conditions", "metrics", "checks"}) {
    nlohmann::json document = nlohmann::json::parse(to_json(sample()));
    document.erase(name);
    const auto refused = parse_result(document.dump());
    ASSERT_FALSE(refused) << name;
    EXPECT_NE(refused.error().message.find(name), std::string::npos) << refused.error().message;
  }
}

TEST(ResultFileTest, other_documents_are_refused) {
  for (const char* text : {"", "[]", "null", "{}", "7", "{\"bench\": \"carve\"}", "\xff\xfe"})
    EXPECT_FALSE(parse_result(text)) << text;
}

TEST(ResultFileTest, a_folder_is_read_as_one) {
  const TestFolder folder;
  StoredResult result = sample();
  ASSERT_TRUE(write_result(result, folder / "deep/er/carve.json"));
  result.name = "storm";
  ASSERT_TRUE(write_result(result, folder / "deep/er/storm.json"));
  std::ofstream(folder / "deep/er/README.md") << "not a result";
  const auto results = read_results(folder / "deep/er");
  ASSERT_TRUE(results) << results.error().message;
  EXPECT_EQ(results->size(), 2U);
  EXPECT_EQ(to_json(results->at("storm")), to_json(result));

  ASSERT_TRUE(write_result(result, folder / "deep/er/other.json"));
  const auto misnamed = read_results(folder / "deep/er");
  ASSERT_FALSE(misnamed);
  EXPECT_NE(misnamed.error().message.find("other.json"), std::string::npos);
  EXPECT_FALSE(read_results(folder / "deep"));
  EXPECT_FALSE(read_results(folder / "nowhere"));
  EXPECT_FALSE(read_result(folder / "nowhere.json"));
}

TEST(ResultFileTest, a_file_that_cannot_be_written_is_an_error) {
  const TestFolder folder;
  std::ofstream(folder / "file") << "in the way";
  EXPECT_FALSE(write_result(sample(), folder / "file/carve.json"));
}

}  // namespace
}  // namespace scree
