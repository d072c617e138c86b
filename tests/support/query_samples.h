// Questions about space, and answers, one of each kind.
#pragma once

#include <optional>
#include <vector>

#include "proto/messages.h"
#include "tests/support/materials.h"

namespace scree::samples {

inline QueryMessage query() {
  const glm::vec3 a(1.0F, 2.0F, 3.0F), b(4.0F, -5.0F, 6.0F), x(1.0F, 0.0F, 0.0F);
  QueryMask mask;
  mask.terrain = mask.bodies = false;
  mask.groups = 0x80000001U;
  mask.except = {7, 4000000000U};
  QueryMask props;
  props.pieces = false;
  return {27,
          1ULL << 40U,
          {{RayQuestion{a, x, 100.0F}, mask},
           {SphereQuestion{a, x, 40.0F, 0.5F}, props},
           {CapsuleQuestion{a, b, x, 4.0F, 0.25F}},
           {InSphereQuestion{a, 2.0F}},
           {InBoxQuestion{a, b}},
           {NearestQuestion{a, 8.0F}},
           {SolidQuestion{b}},
           {ContentQuestion{a, b}},
           {BodiesQuestion{b, a}},
           {UnknownQuestion{}}}};
}

inline AnswerMessage answer() {
  const Hit terrain{HitKind::terrain, 0, 1.5F, {1.0F, 2.0F, 3.0F}, {0.0F, 1.0F, 0.0F}, material::soil, true};
  const Hit piece{HitKind::piece, 4000000000U, 0.0F, {1.0F, 2.0F, 3.0F}, {0.6F, 0.8F, 0.0F}, material::ice};
  std::vector<QuestionReply> answers(9);
  answers[0].answer = std::optional<Hit>(terrain);
  answers[1].answer = std::optional<Hit>(piece);
  answers[2].answer = std::optional<Hit>();
  answers[3].answer = Overlapping{true, {3, 900, 4000000000U}};
  answers[3].more = true;
  answers[4].answer = true;
  answers[5].answer = false;
  answers[6].answer = BoxContent{12.25, {{material::rock, 1LL << 40}, {material::ice, -3}}};
  answers[7].answer = std::vector<PieceId>{1, 2};
  answers[8].refusal = "the question reaches 300 m";
  answers[8].refusal_name = "query_far";
  return {27, 1ULL << 40U, answers};
}

}  // namespace scree::samples
