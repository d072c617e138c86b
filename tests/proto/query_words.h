// Questions about space and their answers in words, as message_words.h.
#pragma once

#include "tests/proto/message_words.h"

namespace scree {

inline std::string words_of_mask(const QueryMask& mask) {
  std::string all = fmt::format("of{}{}{}", mask.terrain ? " terrain" : "", mask.pieces ? " pieces" : "",
                                mask.bodies ? " props" : "");
  if (mask.groups != QueryMask().groups) all += fmt::format(", groups 0x{:08x}", mask.groups);
  if (!mask.except.empty()) all += fmt::format(", but {}", fmt::join(mask.except, " "));
  return all;
}

inline std::string words(const Question& question) {
  const auto way = [](glm::vec3 unit, float most_m) {
    return fmt::format("along {}, {} m at most", words(unit), most_m);
  };
  const std::string asked =
      std::visit(Overloaded{[](const UnknownQuestion&) { return std::string("unknown"); },
                            [&](const RayQuestion& q) {
                              return fmt::format("ray: from {} {}", words(q.from_m), way(q.unit, q.most_m));
                            },
                            [&](const SphereQuestion& q) {
                              return fmt::format("ball: from {} {}, radius {} m", words(q.from_m),
                                                 way(q.unit, q.most_m), q.radius_m);
                            },
                            [&](const CapsuleQuestion& q) {
                              return fmt::format("capsule: {} to {} {}, radius {} m", words(q.a_m),
                                                 words(q.b_m), way(q.unit, q.most_m), q.radius_m);
                            },
                            [](const InSphereQuestion& q) {
                              return fmt::format("in ball: {}, radius {} m", words(q.centre_m), q.radius_m);
                            },
                            [](const InBoxQuestion& q) {
                              return fmt::format("in box: {} to {}", words(q.lo_m), words(q.hi_m));
                            },
                            [](const NearestQuestion& q) {
                              return fmt::format("nearest: to {}, {} m at most", words(q.place_m), q.most_m);
                            },
                            [](const SolidQuestion& q) { return fmt::format("solid: {}", words(q.place_m)); },
                            [](const ContentQuestion& q) {
                              return fmt::format("content: {} to {}", words(q.lo_m), words(q.hi_m));
                            },
                            [](const BodiesQuestion& q) {
                              return fmt::format("bodies: {} to {}", words(q.lo_m), words(q.hi_m));
                            }},
                 question.asks);
  return asked + ", " + words_of_mask(question.mask);
}

inline std::string words(const Hit& hit) {
  constexpr const char* kinds[] = {"terrain", "piece", "prop"};
  return fmt::format("hit: {} {} after {} m at {}, normal {}, material {}{}",
                     kinds[static_cast<size_t>(hit.kind)], hit.id, hit.distance_m, words(hit.place_m),
                     words(hit.normal), row_number(hit.material), hit.inside ? ", inside" : "");
}

inline std::string words(const QuestionReply& reply) {
  if (!reply.answer) return fmt::format("refused: '{}', {}", reply.refusal, reply.refusal_name);
  const std::string more = reply.more ? ", and more" : "";
  return std::visit(
      Overloaded{
          [](const std::optional<Hit>& hit) { return hit ? words(*hit) : std::string("hit: nothing"); },
          [&](const Overlapping& found) {
            return fmt::format("overlaps: {}terrain, ids {}{}", found.terrain ? "" : "no ",
                               fmt::join(found.ids, " "), more);
          },
          [](bool solid) { return fmt::format("solid: {}", solid); },
          [](const BoxContent& content) {
            std::string all = fmt::format("content: {} m3 of rock", content.rock_m3);
            for (const MaterialMass& one : content.masses)
              all += fmt::format(", material {} mass {}", row_number(one.material), one.mass);
            return all;
          },
          [&](const std::vector<PieceId>& ids) {
            return fmt::format("bodies: ids {}{}", fmt::join(ids, " "), more);
          }},
      *reply.answer);
}

inline Lines describe(const QueryMessage& m) {
  Lines lines{fmt::format("query: {}, as of tick {}", m.query, m.as_of)};
  for (const Question& question : m.questions) lines.push_back(words(question));
  return lines;
}
inline Lines describe(const AnswerMessage& m) {
  Lines lines{fmt::format("answer: to query {}, of tick {}", m.query, m.tick)};
  if (!m.refusal.empty()) lines.push_back(fmt::format("refused: '{}', {}", m.refusal, m.refusal_name));
  for (const QuestionReply& reply : m.answers) lines.push_back(words(reply));
  return lines;
}

}  // namespace scree
