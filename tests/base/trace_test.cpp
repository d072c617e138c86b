// Traces: what was measured comes out as JSON that a viewer of traces reads.
#include "shared/base/trace.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <thread>
#include <vector>

#include "shared/base/memory_count.h"

namespace scree {
namespace {

using namespace std::chrono_literals;

nlohmann::json events_of(const Trace& trace, const std::string& kind) {
  nlohmann::json found = nlohmann::json::array();
  const nlohmann::json all = nlohmann::json::parse(trace.to_json());
  for (const auto& event : all.at("traceEvents"))
    if (event.at("ph") == kind) found.push_back(event);
  return found;
}

TEST(Trace, spans_keep_their_times_and_tracks) {
  Trace trace;
  const auto start = Trace::Clock::now();
  trace.span("stages", "late", start + 5ms, 2.5);
  trace.span("stages", "early", start, 1.0);
  trace.span("GPU", "march", start + 1ms, 0.25);
  const nlohmann::json spans = events_of(trace, "X");
  ASSERT_EQ(spans.size(), 3U);
  EXPECT_EQ(spans[0]["name"], "early");
  EXPECT_DOUBLE_EQ(spans[0]["ts"], 0.0);
  EXPECT_DOUBLE_EQ(spans[0]["dur"], 1000.0);
  EXPECT_DOUBLE_EQ(spans[1]["ts"], 1000.0);
  EXPECT_DOUBLE_EQ(spans[2]["ts"], 5000.0);
  EXPECT_EQ(spans[0]["tid"], spans[2]["tid"]);
  EXPECT_NE(spans[0]["tid"], spans[1]["tid"]);
}

TEST(Trace, values_are_counters) {
  Trace trace;
  trace.value("pieces", Trace::Clock::now(), 64.0);
  const nlohmann::json values = events_of(trace, "C");
  ASSERT_EQ(values.size(), 1U);
  EXPECT_DOUBLE_EQ(values[0]["args"]["value"], 64.0);
}

TEST(Trace, an_empty_one_is_still_a_trace) {
  EXPECT_TRUE(nlohmann::json::parse(Trace().to_json()).contains("traceEvents"));
}

TEST(Trace, a_span_that_nobody_keeps_still_measures) {
  const TraceSpan span(nullptr, "track", "name");
  EXPECT_GE(span.elapsed_ms(), 0.0);
}

TEST(Trace, the_oldest_are_overwritten_when_it_is_full) {
  Trace trace;
  const auto start = Trace::Clock::now();
  for (size_t i = 0; i <= trace_spans_max; ++i)
    trace.span("track", i == 0 ? "first" : "other", start + std::chrono::nanoseconds(i), 0.0);
  const std::string text = trace.to_json();
  EXPECT_EQ(text.find("first"), std::string::npos);
}

TEST(Trace, threads_may_write_at_once) {
  Trace trace;
  std::vector<std::thread> threads;
  for (int i = 0; i < 4; ++i)
    threads.emplace_back([&trace] {
      for (int j = 0; j < 1000; ++j) const TraceSpan span(&trace, "track", "name");
    });
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(events_of(trace, "X").size(), 4000U);
}

TEST(Trace, a_file_that_cannot_be_written_is_named) {
  const Result<void> written = Trace().write("/nonexistent/trace.json");
  ASSERT_FALSE(written);
  EXPECT_NE(written.error().message.find("/nonexistent/trace.json"), std::string::npos);
}

TEST(MemoryCount, this_process_occupies_something) {
  EXPECT_GT(process_memory_bytes(), size_t{1} << 20U);
}

}  // namespace
}  // namespace scree
