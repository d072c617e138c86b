// A publisher's answers to questions are those of the world's own scene, in the tick and later by its number.
#include <glm/geometric.hpp>
#include <gtest/gtest.h>
#include <map>

#include "proto/codec.h"
#include "server/publish/publisher.h"
#include "shared/base/random.h"
#include "tests/support/prop_world.h"

namespace scree {
namespace {

constexpr uint64_t asker = 7;

/// A world of hills, whose ticks a publisher serves to one viewer.
class ServedWorld {
 public:
  explicit ServedWorld(const WorldConfig& config)
      : world_(config), publisher_(PublisherConfig{.terrain = world_.world().config().terrain}, workers_) {}

  PropWorld& world() { return world_; }
  Publisher& publisher() { return publisher_; }
  void join(glm::vec3 eye_m) { publisher_.join(asker, eye_m, 100.0F, operation_kinds); }
  void step(const std::vector<Command>& commands = {}) {
    const TickDelta& delta = world_.step(commands);
    const auto backlog = [](uint64_t) { return Backlog(); };
    publisher_.publish(delta, backlog);
    for (const Outgoing& outgoing : publisher_.stream(backlog)) {
      const auto message = decode_server(std::span(*outgoing.bytes).subspan(length_prefix_bytes));
      ASSERT_TRUE(message.has_value()) << message.error().message;
      if (const auto* answer = std::get_if<AnswerMessage>(&*message)) answers[answer->query] = *answer;
    }
  }

  std::map<uint32_t, AnswerMessage> answers;

 private:
  PropWorld world_;
  Workers workers_{1};
  Publisher publisher_;
};

std::vector<Question> questions_about(glm::vec3 place_m, uint32_t seed) {
  Random random(seed);
  const auto part = [&] { return random.unit() * 2.0F - 1.0F; };
  std::vector<Question> questions;
  for (int i = 0; i < 3; ++i) {
    const float x = part(), y = part(), z = part();
    const glm::vec3 at = place_m + 6.0F * glm::vec3(x, 0.4F * y, z);
    const glm::vec3 unit = glm::normalize(glm::vec3(z, x - 0.8F, y) + glm::vec3(0.0F, 0.001F, 0.0F));
    questions.push_back({RayQuestion{at + glm::vec3(0.0F, 4.0F, 0.0F), unit, 40.0F}});
    questions.push_back({CapsuleQuestion{at, at + glm::vec3(0.0F, 1.0F, 0.0F), unit, 6.0F, 0.4F}});
    questions.push_back({InSphereQuestion{at, 2.0F}});
    questions.push_back({NearestQuestion{at, 5.0F}});
    questions.push_back({SolidQuestion{at}});
    questions.push_back({ContentQuestion{at - 2.0F, at + 2.0F}});
    questions.push_back({BodiesQuestion{at - 4.0F, at + 4.0F}});
  }
  return questions;
}

std::vector<QuestionReply> answers_of(const QueryScene& scene, const std::vector<Question>& questions) {
  std::vector<QuestionReply> replies;
  for (const Question& question : questions) replies.push_back({ask(scene, question)->answer});
  return replies;
}

TEST(QueryAnswers, are_those_of_the_world_in_the_tick_and_later_by_its_number) {
  WorldConfig config;
  config.terrain = {TerrainKind::noise, 3, 0.5F};
  ServedWorld served(config);
  served.step();
  const auto ground =
      cast_ray(served.world().world().scene(), {0.0F, 200.0F, 0.0F}, {0.0F, -1.0F, 0.0F}, 400.0F);
  ASSERT_TRUE(ground && ground->answer);
  const glm::vec3 top_m = ground->answer->place_m;
  served.join(top_m);
  uint32_t request = 1, query = 0;
  for (int i = 0; i < 4; ++i)
    served.step({{0, request++, AddPropRequest{crate(), top_m + glm::vec3(2 * i - 3, 4, 1)}}});
  struct Moment {
    Tick tick = 0;
    std::vector<Question> questions;
    std::vector<QuestionReply> right;
  };
  std::map<uint32_t, Moment> now, later;
  for (int i = 0; i < 60; ++i) {
    std::vector<Command> commands;
    CarveRequest carve;
    carve.shape = sphere(top_m + glm::vec3(static_cast<float>(i % 5) - 2.0F, 0.0F, 0.0F), 1.4F);
    carve.seeds = 6;
    carve.impact_m = carve.shape.a;
    carve.blast_speed_m_s = 5.0F;
    if (i % 15 == 3) commands.push_back({0, request++, carve});
    const std::vector<Question> questions = questions_about(top_m, static_cast<uint32_t>(i));
    if (i % 2 == 0) {
      ASSERT_TRUE(served.publisher().ask_query(asker, {++query, 0, questions}).has_value());
    }
    served.step(commands);
    const Moment moment{served.world().last().tick, questions,
                        answers_of(served.world().world().scene(), questions)};
    if (i % 2 == 0) now[query] = moment;
    if (i % 10 != 9) continue;
    for (const auto& [number, past] : now)
      if (past.tick + 10 > moment.tick) {
        ASSERT_TRUE(served.publisher().ask_query(asker, {++query, past.tick, past.questions}).has_value());
        later[query] = past;
      }
  }
  for (int i = 0; i < 60; ++i) served.step();
  ASSERT_EQ(served.answers.size(), now.size() + later.size());
  size_t differ = 0, bodies = 0;
  for (const auto* asked : {&now, &later})
    for (const auto& [number, moment] : *asked) {
      const AnswerMessage& answer = served.answers.at(number);
      if (asked == &later || answer.tick == moment.tick) {
        ASSERT_EQ(answer.tick, moment.tick);
        ASSERT_EQ(answer.answers.size(), moment.right.size());
        for (size_t q = 0; q < moment.right.size(); ++q) {
          ASSERT_EQ(answer.answers[q], moment.right[q]) << number << ' ' << q;
          const auto* hit = std::get_if<std::optional<Hit>>(&*moment.right[q].answer);
          bodies += hit != nullptr && *hit && (*hit)->kind != HitKind::terrain ? 1 : 0;
        }
      }
      if (asked == &later) {
        const auto today = answers_of(served.world().world().scene(), moment.questions);
        differ += today != moment.right ? 1 : 0;
      }
    }
  EXPECT_GE(later.size(), 20U);
  EXPECT_GT(differ, 10U);
  EXPECT_GT(bodies, 30U);
}

}  // namespace
}  // namespace scree
