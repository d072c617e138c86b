#include "shared/query/question.h"

#include <algorithm>
#include <glm/common.hpp>

#include "shared/base/overloaded.h"
#include "shared/query/limits.h"
#include "shared/query/query_check.h"
#include "shared/query/vectors.h"

namespace scree {

namespace {

using Asked = QueryResult<QuestionAnswer>;

template <typename T>
Asked as_answer(QueryResult<T> result) {
  if (!result) return tl::unexpected(result.error());
  return Answered<QuestionAnswer>{QuestionAnswer(std::move(result->answer)), result->cost};
}

Result<void> check_cast(glm::vec3 a_m, glm::vec3 b_m, glm::vec3 unit, float most_m, float radius_m) {
  TRY(check_place(a_m));
  TRY(check_place(b_m));
  TRY(check_way(unit, most_m));
  return check_mover(b_m - a_m, radius_m, most_m);
}

SpaceBox box_about(glm::vec3 lo_m, glm::vec3 hi_m) {
  return {glm::dvec3(lo_m), glm::dvec3(hi_m)};
}

/// Around what a ball at the place sweeps.
SpaceBox swept(glm::vec3 from_m, glm::vec3 unit, float most_m, float radius_m) {
  const glm::dvec3 from(from_m), to = from + unit_of(glm::dvec3(unit)) * static_cast<double>(most_m);
  return SpaceBox{glm::min(from, to), glm::max(from, to)}.grown(static_cast<double>(radius_m));
}

double far_corner(const SpaceBox& box, const glm::dvec3& place_m) {
  const glm::dvec3 off = glm::max(glm::abs(box.lo - place_m), glm::abs(box.hi - place_m));
  return std::sqrt(glm::dot(off, off));
}

/// Both ends lie so far away; what is between lies nearer.
double far_end(glm::vec3 from_m, glm::vec3 unit, float most_m, float radius_m, const glm::dvec3& place_m) {
  const glm::dvec3 from = glm::dvec3(from_m) - place_m,
                   to = from + unit_of(glm::dvec3(unit)) * static_cast<double>(most_m);
  return std::sqrt(std::max(glm::dot(from, from), glm::dot(to, to))) + static_cast<double>(radius_m);
}

}  // namespace

Result<void> validate(const Question& question) {
  using Done = Result<void>;
  TRY(check_mask(question.mask));
  return std::visit(
      Overloaded{[](const UnknownQuestion&) -> Done { return fail("the kind of the question is unknown"); },
                 [](const RayQuestion& q) -> Done {
                   TRY(check_place(q.from_m));
                   return check_way(q.unit, q.most_m);
                 },
                 [](const SphereQuestion& q) -> Done {
                   return check_cast(q.from_m, q.from_m, q.unit, q.most_m, q.radius_m);
                 },
                 [](const CapsuleQuestion& q) -> Done {
                   return check_cast(q.a_m, q.b_m, q.unit, q.most_m, q.radius_m);
                 },
                 [](const InSphereQuestion& q) -> Done {
                   TRY(check_place(q.centre_m));
                   return check_mover(glm::vec3(0.0F), q.radius_m, 0.0F);
                 },
                 [](const InBoxQuestion& q) -> Done { return check_volume(q.lo_m, q.hi_m); },
                 [](const NearestQuestion& q) -> Done { return check_nearest(q.place_m, q.most_m); },
                 [](const SolidQuestion& q) -> Done { return check_place(q.place_m); },
                 [](const ContentQuestion& q) -> Done { return check_volume(q.lo_m, q.hi_m); },
                 [](const BodiesQuestion& q) -> Done { return check_box(q.lo_m, q.hi_m); }},
      question.asks);
}

QueryResult<QuestionAnswer> ask(const QueryScene& scene, const Question& question) {
  const QueryMask& mask = question.mask;
  return std::visit(
      Overloaded{
          [](const UnknownQuestion&) -> Asked { return fail("the kind of the question is unknown"); },
          [&](const RayQuestion& q) -> Asked {
            return as_answer(cast_ray(scene, q.from_m, q.unit, q.most_m, mask));
          },
          [&](const SphereQuestion& q) -> Asked {
            return as_answer(cast_sphere(scene, q.from_m, q.unit, q.most_m, q.radius_m, mask));
          },
          [&](const CapsuleQuestion& q) -> Asked {
            return as_answer(cast_capsule(scene, q.a_m, q.b_m, q.unit, q.most_m, q.radius_m, mask));
          },
          [&](const InSphereQuestion& q) -> Asked {
            return as_answer(overlap_sphere(scene, q.centre_m, q.radius_m, mask));
          },
          [&](const InBoxQuestion& q) -> Asked {
            return as_answer(overlap_box(scene, q.lo_m, q.hi_m, mask));
          },
          [&](const NearestQuestion& q) -> Asked {
            return as_answer(nearest_surface(scene, q.place_m, q.most_m, mask));
          },
          [&](const SolidQuestion& q) -> Asked { return as_answer(is_solid(scene, q.place_m, mask)); },
          [&](const ContentQuestion& q) -> Asked { return as_answer(box_content(scene, q.lo_m, q.hi_m)); },
          [&](const BodiesQuestion& q) -> Asked {
            return as_answer(solids_in(scene, q.lo_m, q.hi_m, mask));
          }},
      question.asks);
}

double reach_from(const Question& question, const glm::dvec3& place_m) {
  return std::visit(
      Overloaded{
          [](const UnknownQuestion&) { return 0.0; },
          [&](const RayQuestion& q) { return far_end(q.from_m, q.unit, q.most_m, 0.0F, place_m); },
          [&](const SphereQuestion& q) { return far_end(q.from_m, q.unit, q.most_m, q.radius_m, place_m); },
          [&](const CapsuleQuestion& q) {
            return std::max(far_end(q.a_m, q.unit, q.most_m, q.radius_m, place_m),
                            far_end(q.b_m, q.unit, q.most_m, q.radius_m, place_m));
          },
          [&](const auto&) { return far_corner(bounds_of(question), place_m); }},
      question.asks);
}

SpaceBox bounds_of(const Question& question) {
  const auto ball = [](glm::vec3 at_m, float radius_m) {
    return box_about(at_m, at_m).grown(static_cast<double>(radius_m));
  };
  return std::visit(
      Overloaded{[](const UnknownQuestion&) { return SpaceBox{}; },
                 [](const RayQuestion& q) { return swept(q.from_m, q.unit, q.most_m, 0.0F); },
                 [](const SphereQuestion& q) { return swept(q.from_m, q.unit, q.most_m, q.radius_m); },
                 [](const CapsuleQuestion& q) {
                   return hull_of(swept(q.a_m, q.unit, q.most_m, q.radius_m),
                                  swept(q.b_m, q.unit, q.most_m, q.radius_m));
                 },
                 [&](const InSphereQuestion& q) { return ball(q.centre_m, q.radius_m); },
                 [](const InBoxQuestion& q) { return box_about(q.lo_m, q.hi_m); },
                 [&](const NearestQuestion& q) { return ball(q.place_m, q.most_m); },
                 [&](const SolidQuestion& q) { return ball(q.place_m, 0.0F); },
                 [](const ContentQuestion& q) { return box_about(q.lo_m, q.hi_m); },
                 [](const BodiesQuestion& q) { return box_about(q.lo_m, q.hi_m); }},
      question.asks);
}

}  // namespace scree
