// The parts that figures are made of: distributions, kinds of messages, causes of late ticks.
#include <fstream>
#include <gtest/gtest.h>
#include <regex>
#include <sstream>

#include "proto/codec.h"
#include "proto/message_kind.h"
#include "server/app/tick_parts.h"
#include "server/metrics/figure_page.h"
#include "tests/monitoring/worked_server.h"

namespace scree {
namespace {

TEST(Durations, are_counted_up_to_a_bound_and_summed_up) {
  Durations durations;
  durations.add(1.0);
  durations.add(5.0, 3);
  durations.add(20.0);
  EXPECT_EQ(durations.count_up_to(0.5), 0U);
  EXPECT_EQ(durations.count_up_to(2.0), 1U);
  EXPECT_EQ(durations.count_up_to(10.0), 4U);
  EXPECT_EQ(durations.count_up_to(1e9), 5U);
  EXPECT_DOUBLE_EQ(durations.sum_ms(), 36.0);
}

TEST(FigurePage, has_help_type_and_samples_of_each_figure) {
  FigurePage page;
  page.total("scree_cuts_total", "Cuts.", 3, {{"by", "a \"b\"\n"}});
  page.total("scree_cuts_total", "Cuts.", 0, {{"by", "c"}});
  page.state("scree_depth_meters", "Depth.", 0.25);
  Durations durations;
  durations.add(1.5);
  const std::array bounds_s{0.001, 0.0167};
  page.durations("scree_wait_seconds", "Waits.", durations, bounds_s);
  EXPECT_EQ(page.text(),
            "# HELP scree_cuts_total Cuts.\n# TYPE scree_cuts_total counter\n"
            "scree_cuts_total{by=\"a \\\"b\\\"\\n\"} 3\nscree_cuts_total{by=\"c\"} 0\n"
            "# HELP scree_depth_meters Depth.\n# TYPE scree_depth_meters gauge\nscree_depth_meters 0.25\n"
            "# HELP scree_wait_seconds Waits.\n# TYPE scree_wait_seconds histogram\n"
            "scree_wait_seconds_count 1\nscree_wait_seconds_sum 0.0015\n"
            "scree_wait_seconds_bucket{le=\"0.001\"} 0\nscree_wait_seconds_bucket{le=\"0.0167\"} 1\n"
            "scree_wait_seconds_bucket{le=\"+Inf\"} 1\n");
}

TEST(FigurePageDeath, bad_names_and_scattered_figures_are_programmers_errors) {
  FigurePage page;
  page.state("scree_a", "A.", 1);
  page.state("scree_b", "B.", 1);
  EXPECT_DEATH(page.state("scree_a", "A.", 2), "one after the other");
  EXPECT_DEATH(page.state("scree b", "B.", 2), "name");
  EXPECT_DEATH(page.state("scree_c", "C.", 2, {{"a-b", "c"}}), "label");
  EXPECT_DEATH(page.total("scree_b", "B.", 2), "alike");
}

TEST(LateTicks, have_the_cause_that_took_longest) {
  LateTicks late;
  TickParts parts;
  parts[TickPart::simulation] = 10.0;
  parts.cpu_ms = 10.0;
  late.add(parts, 16.0);
  EXPECT_EQ(late.earlier, 1U) << "this one was short enough";
  parts[TickPart::keep] = 12.0;
  parts.cpu_ms = 20.0;
  late.add(parts, 16.0);
  EXPECT_EQ(late.by_part[static_cast<size_t>(TickPart::keep)], 1U);
  parts.cpu_ms = 3.0;
  late.add(parts, 16.0);
  EXPECT_EQ(late.waiting, 1U) << "the thread had no processor";
  EXPECT_EQ(late.earlier, 1U);
}

template <size_t size>
void expect_rows_as_in(const std::string& oneof_of, const std::array<MessageKindRow, size>& rows) {
  std::ifstream file(SCREE_SOURCE_DIR "/proto/scree.proto");
  std::stringstream text;
  text << file.rdbuf();
  std::string body = text.str();
  body = body.substr(body.find("message " + oneof_of + " {"));
  body = body.substr(0, body.find("\n}"));
  static const std::regex field(R"(\w+ (\w+) = (\d+);)");
  size_t fields = 0;
  for (std::sregex_iterator at(body.begin(), body.end(), field), end; at != end; ++at, ++fields) {
    const auto number = static_cast<uint32_t>(std::stoul((*at)[2].str()));
    const auto row = std::ranges::find(rows, number, &MessageKindRow::number);
    ASSERT_NE(row, rows.end()) << (*at)[1].str() << " has no row in proto/message_kind.h";
    EXPECT_EQ(row->name, (*at)[1].str());
  }
  EXPECT_EQ(fields + 1, size) << "each row but the last is a field";
}

TEST(MessageKinds, are_those_of_the_protocol) {
  expect_rows_as_in("ServerMessage", server_message_kinds);
  expect_rows_as_in("ClientMessage", client_message_kinds);
}

TEST(MessageKinds, are_seen_in_the_bytes) {
  const auto kind_of = [](const ClientMessage& message) {
    const std::vector<uint8_t> bytes = encode(message);
    return client_message_kinds[message_kind(std::span(bytes).subspan(length_prefix_bytes),
                                             client_message_kinds)]
        .name;
  };
  EXPECT_EQ(kind_of(hello()), "hello");
  EXPECT_EQ(kind_of(carve(7)), "carve");
  EXPECT_EQ(kind_of(ChannelMessage{{"shop", {1}}}), "channel") << "its number takes two bytes";
  EXPECT_EQ(client_message_kinds[message_kind({}, client_message_kinds)].name, "unknown");
  const std::array<uint8_t, 5> nonsense{0xff, 0xff, 0xff, 0xff, 0xff};
  EXPECT_EQ(server_message_kinds[message_kind(nonsense, server_message_kinds)].name, "unknown");
}

}  // namespace
}  // namespace scree
