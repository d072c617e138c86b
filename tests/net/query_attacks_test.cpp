// Questions about space by clients that mean harm: they are refused by name, and others are served.
#include "tests/support/attack_fixture.h"

namespace scree {
namespace {

class QueryAttacks : public AttackTest {
 protected:
  static QueryMessage rays(uint32_t number, size_t count) {
    const RayQuestion down{{0.0F, 5.0F, 0.0F}, {0.0F, -1.0F, 0.0F}, 30.0F};
    return {number, 0, std::vector<Question>(count, {down})};
  }
};

TEST_F(QueryAttacks, a_viewer_may_ask) {
  open([](NetConfig& config) { config.access.anonymous = Role::viewer; });
  ASSERT_TRUE(witness->send(rays(5, 2)));
  std::optional<AnswerMessage> answer;
  for (int i = 0; i < 200 && !answer; ++i) {
    tick();
    answer = witness->receive_as<AnswerMessage>(milliseconds(50));
  }
  ASSERT_TRUE(answer.has_value());
  EXPECT_EQ(answer->query, 5U);
  EXPECT_GT(answer->tick, 0U);
  ASSERT_EQ(answer->answers.size(), 2U);
  ASSERT_TRUE(answer->answers[1].answer.has_value());
  const auto& hit = std::get<std::optional<Hit>>(*answer->answers[1].answer);
  ASSERT_TRUE(hit.has_value());
  EXPECT_EQ(hit->kind, HitKind::terrain);
}

TEST_F(QueryAttacks, a_program_asks_by_its_client) {
  open();
  Client client(std::make_unique<ServerConnector>(ServerEndpoint{.port = server->port()}, patience));
  EXPECT_EQ(client.query({}), 0U);  // not joined
  ASSERT_TRUE(join_and_wait(client, {protocol_version, "asks", {0.0F, 2.0F, 0.0F}, 64.0F}).has_value());
  const uint32_t number = client.query({{SolidQuestion{{0.0F, -3.0F, 0.0F}}}});
  std::optional<AnswerMessage> answer;
  for (int i = 0; i < 400 && !answer; ++i) {
    tick();
    client.wait(milliseconds(20));
    client.poll(steady_now_s());
    while (const auto event = client.next()) {
      const auto* const applied = std::get_if<Client::Applied>(&*event);
      if (applied == nullptr) continue;
      if (const auto* found = std::get_if<AnswerMessage>(&applied->received.message)) answer = *found;
    }
  }
  ASSERT_TRUE(answer.has_value());
  EXPECT_EQ(answer->query, number);
  ASSERT_EQ(answer->answers.size(), 1U);
  EXPECT_EQ(answer->answers[0].answer, QuestionAnswer(true));
}

TEST_F(QueryAttacks, too_many_questions_are_refused_in_their_answers) {
  open();
  RawClient flood(server->port());
  ASSERT_TRUE(flood.send(hello()));
  ASSERT_TRUE(flood.receive_as<WelcomeMessage>().has_value());
  for (uint32_t i = 0; i < 100; ++i) ASSERT_TRUE(flood.send(rays(i, limits::questions_max)));
  expect_refused_as(Refusal::queries_per_second, 10);
  EXPECT_GE(server->stats().refusals.of(Refusal::queries_waiting), 1U);
  expect_honest_served();
  size_t refused = 0;
  for (int i = 0; i < 12; ++i) {
    const auto answer = flood.receive_as<AnswerMessage>();
    ASSERT_TRUE(answer.has_value());
    refused += answer->refusal_name == "queries_per_second" || answer->refusal_name == "queries_waiting";
  }
  EXPECT_GT(refused, 0U);
}

TEST_F(QueryAttacks, numbers_that_are_none_and_lists_without_end_end_the_session) {
  open();
  const auto attack = [&](const QueryMessage& query, const std::string& because) {
    RawClient client(server->port());
    ASSERT_TRUE(client.send(hello()));
    ASSERT_TRUE(client.receive_as<WelcomeMessage>().has_value());
    ASSERT_TRUE(client.send(query));
    const auto refusal = client.receive_as<RefusalMessage>();
    ASSERT_TRUE(refusal.has_value());
    EXPECT_EQ(refusal->name, "message_malformed");
    EXPECT_NE(refusal->reason.find(because), std::string::npos) << refusal->reason;
  };
  constexpr float none = std::numeric_limits<float>::quiet_NaN();
  attack({1, 0, {{RayQuestion{glm::vec3(none), {0.0F, -1.0F, 0.0F}, 5.0F}}}}, "place of a question");
  attack({1, 0, {{RayQuestion{glm::vec3(0.0F), glm::vec3(none), 5.0F}}}}, "direction of a question");
  attack({1, 0, {{NearestQuestion{glm::vec3(0.0F), std::numeric_limits<float>::infinity()}}}},
         "length of a question");
  attack(rays(1, limits::questions_max + 1), "65 questions");
  QueryMessage masked = rays(1, 1);
  masked.questions[0].mask.except.assign(5000, 3);
  attack(masked, "excepts 5000 ids");
  expect_honest_served();
}

TEST_F(QueryAttacks, dear_questions_keep_nobody_waiting) {
  open();
  std::vector<std::unique_ptr<RawClient>> attackers;
  const glm::vec3 at(0.0F, 2.0F, 0.0F);
  for (int i = 0; i < 8; ++i) {
    attackers.push_back(std::make_unique<RawClient>(server->port()));
    ASSERT_TRUE(attackers.back()->send(hello()));
    ASSERT_TRUE(attackers.back()->receive_as<WelcomeMessage>().has_value());
    std::vector<Question> dear(30, {ContentQuestion{at - 12.0F, at + 12.0F}});
    dear.insert(dear.end(), 30, {BodiesQuestion{at - 8000.0F, at + 8000.0F}});
    for (uint32_t n = 0; n < 8; ++n) ASSERT_TRUE(attackers.back()->send(QueryMessage{n, 0, dear}));
  }
  for (int i = 0; i < 5; ++i) expect_honest_served();
  EXPECT_GE(server->stats().refusals.of(Refusal::queries_waiting), 0U);
}

}  // namespace
}  // namespace scree
