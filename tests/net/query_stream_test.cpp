// Questions about space by message: answered as the field and the pieces stand, refused by name, in turn, and
// at a bounded cost in a tick.
#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "shared/base/random.h"
#include "tests/support/publisher_fixture.h"

namespace scree {
namespace {

constexpr glm::vec3 eye_m(0.0F, 2.0F, 0.0F);
constexpr glm::vec3 down(0.0F, -1.0F, 0.0F);

Question ray(glm::vec3 from_m, glm::vec3 unit = down, float most_m = 20.0F) {
  return {RayQuestion{from_m, unit, most_m}};
}

/// A file that gives chunks one tick after they were asked for.
class LateSupply final : public ChunkSupply {
 public:
  explicit LateSupply(Field& field) : field_(field) {}
  size_t bricks_max() override { return 0; }
  Tick saved_tick() override { return saved; }
  bool has_room() override { return true; }
  void ask(ChunkCoord chunk) override { asked.insert(chunk); }
  std::vector<SuppliedChunk> collect(size_t) override {
    std::vector<SuppliedChunk> chunks;
    if (!answers) return chunks;
    for (const ChunkCoord chunk : std::exchange(asked, {})) {
      SuppliedChunk& one = chunks.emplace_back(SuppliedChunk{chunk, {}});
      for (const BrickCoord brick : field_.edited_bricks(chunk))
        one.bricks.push_back({brick, field_.brick(brick), field_.materials(brick)});
    }
    return chunks;
  }

  Tick saved = 0;
  bool answers = true;
  std::set<ChunkCoord> asked;

 private:
  Field& field_;
};

class QueryStreamTest : public PublisherTest {
 protected:
  const AnswerMessage& ask(std::vector<Question> questions, Tick as_of = 0, int ticks = 200) {
    const size_t before = followers.at(session).answers.size();
    EXPECT_TRUE(publisher.ask_query(session, {++number, as_of, std::move(questions)}).has_value());
    for (int i = 0; i < ticks && followers.at(session).answers.size() == before; ++i) tick();
    EXPECT_EQ(followers.at(session).answers.size(), before + 1);
    static const AnswerMessage none;
    return followers.at(session).answers.empty() ? none : followers.at(session).answers.back();
  }
  std::string refusal_of(const Question& question) {
    const AnswerMessage& answer = ask({question});
    return answer.answers.size() == 1 ? answer.answers.front().refusal_name : answer.refusal_name;
  }
  /// Over the source's field, with the pieces where the source has put them.
  std::vector<QuestionReply> wanted(const std::vector<Question>& questions, const TickDelta& delta) {
    SceneMaker maker;
    maker.begin(delta.pieces.size());
    for (const PieceState& piece : delta.pieces)
      maker.add_piece(piece.id, dequantise(piece.pose), *source.pieces().at(piece.id));
    const HeldScene scene = maker.make(source.field());
    std::vector<QuestionReply> replies;
    for (const Question& question : questions) {
      const auto found = scree::ask(scene, question);
      EXPECT_TRUE(found.has_value());
      replies.push_back({found ? std::optional(found->answer) : std::nullopt});
    }
    return replies;
  }
  static std::vector<Question> many(uint32_t seed) {
    Random random(seed);
    const auto part = [&] { return random.unit() * 12.0F - 6.0F; };
    const auto place = [&] {
      const float x = part(), y = 0.3F * part();
      return glm::vec3(x, y, part());
    };
    std::vector<Question> questions;
    while (questions.size() + 8 < limits::questions_max) {
      const glm::vec3 at = place(), unit = glm::normalize(place() + glm::vec3(0.01F, -0.5F, 0.0F));
      questions.push_back({RayQuestion{at + glm::vec3(0.0F, 3.0F, 0.0F), unit, 12.0F}});
      questions.push_back({SphereQuestion{at + glm::vec3(0.0F, 3.0F, 0.0F), unit, 9.0F, 0.4F}});
      questions.push_back({CapsuleQuestion{at, at + glm::vec3(0.0F, 1.8F, 0.0F), unit, 5.0F, 0.3F}});
      questions.push_back({InSphereQuestion{at, 1.5F}});
      questions.push_back({InBoxQuestion{at - 1.0F, at + 2.0F}});
      questions.push_back({NearestQuestion{at, 6.0F}});
      questions.push_back({SolidQuestion{at}});
      questions.push_back({ContentQuestion{at - 3.0F, at + 3.0F}});
      questions.push_back({BodiesQuestion{at - 5.0F, at + 5.0F}});
    }
    questions.push_back(ray({0.0F, 30.0F, 0.0F}, {0.0F, 1.0F, 0.0F}, 40.0F));
    return questions;
  }
  /// The ground about is generated.
  void warm() {
    for (const float x : {-20.0F, 0.0F})
      ask({{ContentQuestion{{x, -8.0F, -20.0F}, {x + 20.0F, 8.0F, 20.0F}}},
           ray({0.0F, 30.0F, 0.0F}, down, 40.0F)});
    ask({ray({0.0F, 30.0F, 0.0F}, {0.0F, 1.0F, 0.0F}, 40.0F)});
    followers.at(session).answers.clear();
  }
  uint32_t number = 0;
};

TEST_F(QueryStreamTest, answers_are_those_of_the_field_and_the_pieces_as_they_stand) {
  join(session, eye_m, 64.0F);
  warm();
  for (int i = 0; i < 4; ++i) {
    const auto delta =
        source.step({source.carve({2.0F * static_cast<float>(i) - 3.0F, 0.0F, 0.0F}, 1.6F, 5)});
    deliver(*delta);
    for (const PieceState& piece : delta->pieces) source.move(piece.id, {0.1F, 0.4F, 0.05F});
    const auto moved = source.step();
    deliver(*moved);
    const std::vector<Question> questions = many(static_cast<uint32_t>(i));
    EXPECT_TRUE(publisher.ask_query(session, {7, 0, questions}).has_value());
    const auto asked = source.step();
    deliver(*asked);
    const Tick by = asked->tick;
    for (int wait = 0; wait < 100 && followers.at(session).answers.size() <= static_cast<size_t>(i); ++wait)
      tick();
    const AnswerMessage& answer = followers.at(session).answers.back();
    EXPECT_EQ(answer.query, 7U);
    EXPECT_EQ(answer.tick, by);
    const auto right = wanted(questions, *asked);
    ASSERT_EQ(answer.answers.size(), right.size());
    for (size_t q = 0; q < right.size(); ++q) EXPECT_EQ(answer.answers[q], right[q]) << q;
  }
  EXPECT_TRUE(publisher.take_query_refusals().empty());
}

TEST_F(QueryStreamTest, what_a_moment_answered_is_answered_again_by_its_tick) {
  join(session, eye_m, 64.0F);
  for (int i = 0; i < 3; ++i) tick({source.carve({3.0F * static_cast<float>(i), 0.0F, 0.0F}, 1.5F, 4)});
  warm();
  std::map<Tick, std::pair<std::vector<Question>, std::vector<QuestionReply>>> moments;
  for (int i = 0; i < 14; ++i) {
    std::vector<Operation> operations;
    if (i % 3 == 1) operations = {source.carve({0.5F * static_cast<float>(i) - 3.0F, -0.5F, 1.0F}, 1.2F, 3)};
    if (i == 8) operations = {source.stamp(source.pieces().begin()->first)};
    for (const auto& [id, volume] : source.pieces()) source.move(id, {0.02F, 0.03F, -0.02F});
    const auto delta = source.step(operations);
    deliver(*delta);
    std::vector<Question> questions = many(static_cast<uint32_t>(50 + i));
    questions.resize(28);  // so that they all may wait
    moments[delta->tick] = {questions, wanted(questions, *delta)};
  }
  for (const auto& [at, moment] : moments)
    ASSERT_TRUE(publisher.ask_query(session, {static_cast<uint32_t>(at), at, moment.first}).has_value())
        << at;
  for (int i = 0; i < 30 && followers.at(session).answers.size() < moments.size(); ++i) tick();
  ASSERT_EQ(followers.at(session).answers.size(), moments.size());
  int differ = 0;
  const std::vector<QuestionReply>* before = nullptr;
  for (const AnswerMessage& answer : followers.at(session).answers) {
    const auto& right = moments.at(answer.tick).second;
    EXPECT_EQ(answer.query, answer.tick);
    ASSERT_EQ(answer.answers.size(), right.size());
    for (size_t q = 0; q < right.size(); ++q)
      EXPECT_EQ(answer.answers[q], right[q]) << answer.tick << ' ' << q;
    differ += before != nullptr && *before != right ? 1 : 0;
    before = &right;
  }
  EXPECT_GT(differ, 5) << "the moments are not all alike";
}

TEST_F(QueryStreamTest, ticks_too_old_or_to_come_are_refused) {
  join(session, eye_m, 64.0F);
  for (int i = 0; i < 60; ++i) tick();
  const auto asked = [&](Tick at) {
    const auto passed = publisher.ask_query(session, {1, at, {ray({0.0F, 5.0F, 0.0F})}});
    return passed ? std::string() : std::string(name_of(passed.error().reason));
  };
  EXPECT_EQ(asked(source.tick()), "");
  EXPECT_EQ(asked(source.tick() - 45), "");  // 750 ms at 60 Hz
  EXPECT_EQ(asked(source.tick() - 46), "query_tick");
  EXPECT_EQ(asked(source.tick() + 1), "query_tick");
  EXPECT_EQ(asked(~Tick{0}), "query_tick");
  EXPECT_EQ(asked(1), "query_tick");
}

TEST_F(QueryStreamTest, each_question_is_refused_by_name) {
  join(session, eye_m, 64.0F);
  tick();
  const glm::vec3 at(0.0F, 2.0F, 0.0F);
  EXPECT_EQ(refusal_of(ray(at)), "");
  EXPECT_EQ(refusal_of(ray(at, {0.0F, 0.0F, 0.0F})), "query_invalid");
  EXPECT_EQ(refusal_of(ray(at, down, -1.0F)), "query_invalid");
  EXPECT_EQ(refusal_of(ray(at, down, 1e9F)), "query_invalid");
  EXPECT_EQ(refusal_of(ray(at, {1e30F, 0.0F, 0.0F})), "query_invalid");
  EXPECT_EQ(refusal_of({SphereQuestion{at, down, 900.0F, 8.0F}}), "query_invalid");
  EXPECT_EQ(refusal_of({SphereQuestion{at, down, 1.0F, 0.0F}}), "query_invalid");
  EXPECT_EQ(refusal_of({CapsuleQuestion{at, at + 100.0F, down, 1.0F, 0.5F}}), "query_invalid");
  EXPECT_EQ(refusal_of({InSphereQuestion{at, 1000.0F}}), "query_invalid");
  EXPECT_EQ(refusal_of({InBoxQuestion{at - 4000.0F, at + 4000.0F}}), "query_invalid");
  EXPECT_EQ(refusal_of({ContentQuestion{at + 1.0F, at - 1.0F}}), "query_invalid");
  EXPECT_EQ(refusal_of({NearestQuestion{at, 9.0F}}), "query_invalid");
  EXPECT_EQ(refusal_of({SolidQuestion{glm::vec3(1e7F)}}), "query_invalid");
  EXPECT_EQ(refusal_of({UnknownQuestion{}}), "value_unknown");
  Question masked = ray(at);
  masked.mask.except.assign(65, 7);
  EXPECT_EQ(refusal_of(masked), "query_invalid");
  EXPECT_EQ(refusal_of(ray(at, down, 79.0F)), "");  // 1.25 times the interest
  EXPECT_EQ(refusal_of(ray(at, down, 81.0F)), "query_far");
  EXPECT_EQ(refusal_of({SolidQuestion{{100.0F, 0.0F, 0.0F}}}), "query_far");
  EXPECT_EQ(refusal_of({BodiesQuestion{at - 500.0F, at + 500.0F}}), "query_far");
  EXPECT_EQ(refusal_of({BodiesQuestion{at - 40.0F, at + 40.0F}}), "");
  EXPECT_EQ(publisher.take_query_refusals().size(), 17U);
  EXPECT_TRUE(publisher.take_query_refusals().empty());
  EXPECT_EQ(ask({}).answers.size(), 0U);
}

TEST_F(QueryStreamTest, what_waits_is_bounded_and_others_do_not_wait_for_it) {
  join(session, eye_m, 64.0F);
  join(2, eye_m, 64.0F);
  tick();
  const std::vector<Question> heavy(limits::questions_max, {ContentQuestion{eye_m - 12.0F, eye_m + 12.0F}});
  size_t taken = 0;
  while (publisher.ask_query(session, {1, 0, heavy}).has_value()) ASSERT_LT(++taken, 20U);
  EXPECT_EQ(publisher.ask_query(session, {1, 0, heavy}).error().reason, Refusal::queries_waiting);
  EXPECT_GE(taken, 7U);
  for (int i = 0; i < 12; ++i) tick();  // its ground is generated, bit by bit
  ASSERT_TRUE(publisher.ask_query(2, {1, 0, {ray({0.0F, 5.0F, 0.0F})}}).has_value());
  for (int i = 0; i < 2; ++i) tick();
  EXPECT_EQ(followers.at(2).answers.size(), 1U);
  publisher.leave(session);
  tick();
  EXPECT_TRUE(followers.at(session).answers.size() < taken);
}

TEST_F(QueryStreamTest, chunks_out_of_memory_are_read_first_or_the_question_is_to_be_asked_again) {
  const auto supply = std::make_shared<LateSupply>(source.field());
  Publisher paged(PublisherConfig{.terrain = flat_terrain, .chunks = supply}, workers);
  const auto play = [&](const std::vector<Operation>& operations = {}) {
    TickDelta delta = *source.step(operations);
    std::set<ChunkCoord> chunks;
    for (const BrickState& brick : delta.bricks) chunks.insert(chunk_of(brick.coord));
    for (const ChunkCoord chunk : chunks) {
      uint64_t edited = 0;
      for (const BrickCoord brick : source.field().edited_bricks(chunk))
        edited |= uint64_t{1} << index_in_chunk(brick);
      delta.chunks.push_back({chunk, source.field().chunk_hash(chunk), edited});
    }
    const auto backlog = [](uint64_t) { return Backlog(); };
    receive(paged.publish(delta, backlog));
    receive(paged.stream(backlog));
  };
  play({source.carve({0.0F, 0.0F, 0.0F}, 1.5F, 3)});
  supply->saved = 1;
  play();
  play();
  ASSERT_EQ(paged.state().bricks_in(), 0U);
  followers.try_emplace(session);
  paged.join(session, {70.0F, 2.0F, 0.0F}, 60.0F, operation_kinds);  // it wants none of these chunks itself
  const Question question{RayQuestion{{0.0F, 5.0F, 0.0F}, down, 9.0F}, {.pieces = false}};
  ASSERT_TRUE(paged.ask_query(session, {1, 0, {question}}).has_value());
  for (int i = 0; i < 50 && followers.at(session).answers.empty(); ++i) play();
  ASSERT_EQ(followers.at(session).answers.size(), 1U);
  const QuestionReply reply = followers.at(session).answers.back().answers.at(0);
  ASSERT_TRUE(reply.answer.has_value()) << reply.refusal;
  const QueryScene scene(source.field(), {});
  EXPECT_EQ(*reply.answer, scree::ask(scene, question)->answer);

  for (int i = 0; i < 4; ++i) play();
  supply->answers = false;
  for (int i = 0; i < 4; ++i) play();
  ASSERT_TRUE(
      paged.ask_query(session, {2, 0, {{ContentQuestion{glm::vec3(-1.0F), glm::vec3(1.0F)}}}}).has_value());
  for (int i = 0; i < 80 && followers.at(session).answers.size() < 2; ++i) play();
  ASSERT_EQ(followers.at(session).answers.size(), 2U);
  EXPECT_EQ(followers.at(session).answers.back().answers.at(0).refusal_name, "query_later");
}

}  // namespace
}  // namespace scree
