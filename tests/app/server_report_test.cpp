// What a server says about itself counts everything that happened.
#include "server/app/server_report.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "server/app/tick_trace.h"

namespace scree {
namespace {

TEST(ServerReport, every_kind_of_operation_is_counted_by_its_name) {
  TickDelta delta;
  delta.tick = 1;
  delta.operations.push_back({PaintOperation{}, {}, {}, {}});
  delta.operations.push_back({PaintOperation{}, {}, {}, {}});
  delta.operations.push_back({StampOperation{7, {}, 0, StampMethod::stamp, {{8, {}}}}, {}, {}, {}});
  delta.operations.push_back({DiscardOperation{9}, {}, {}, {}});
  ServerReport report;
  report.add(delta);
  const auto json = nlohmann::json::parse(to_json(report));
  EXPECT_EQ(json.at("paints"), 2);
  EXPECT_EQ(json.at("stamps"), 1);
  EXPECT_EQ(json.at("pieces_merged"), 2);
  EXPECT_EQ(json.at("discards"), 1);
  EXPECT_EQ(json.at("pieces_lost"), 1);
  for (const char* none : {"carves", "fills", "shatters", "islands"}) EXPECT_EQ(json.at(none), 0) << none;
}

TEST(ServerReport, stages_that_seldom_act_are_judged_by_the_ticks_in_which_they_did) {
  TickDelta idle;
  idle.times[TickStage::requests] = 0.001;
  idle.times[TickStage::support] = 0.5;
  TickDelta carving = idle;
  carving.times[TickStage::requests] = 3.0;
  carving.times.acted.set(index_of(TickStage::requests));
  ServerReport report;
  for (const TickDelta* delta : {&idle, &carving, &idle}) report.add(*delta);
  const auto stages = nlohmann::json::parse(to_json(report)).at("stages_ms");
  EXPECT_EQ(stages.at("requests").at("count"), 1);
  EXPECT_NEAR(stages.at("requests").at("median").get<double>(), 3.0, 0.1);
  EXPECT_EQ(stages.at("support").at("count"), 3);
  EXPECT_EQ(stages.at("tick").at("count"), 3);
  for (const char* around : {"whole_tick", "whole_tick_cpu", "terrain_in", "keep"})
    EXPECT_TRUE(stages.contains(around)) << around;
  for (const TickStageRow& row : tick_stages) EXPECT_TRUE(stages.contains(row.name)) << row.name;
}

TEST(ServerReport, requests_are_measured_by_stage) {
  ServerReport report;
  report.latency[1].add(12.5);
  const auto stages = nlohmann::json::parse(to_json(report)).at("request_latency_ms");
  for (const LatencyStageRow& stage : latency_stages) EXPECT_TRUE(stages.contains(stage.name)) << stage.name;
  EXPECT_EQ(stages.at("tick").at("worst"), 12.5);
  EXPECT_EQ(stages.at("waiting").at("count"), 0);
}

TEST(ServerReport, a_trace_has_a_span_for_each_stage_that_took_time) {
  TickDelta delta;
  for (const TickStageRow& row : tick_stages) delta.times[row.stage] = 1.0;
  Trace trace;
  trace_tick(trace, Trace::Clock::now(), delta);
  const std::string json = trace.to_json();
  for (const TickStageRow& row : tick_stages)
    EXPECT_NE(json.find("\"" + std::string(row.name) + "\""), std::string::npos) << row.name;
}

}  // namespace
}  // namespace scree
