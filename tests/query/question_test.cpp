// Questions as values: refused as the functions refuse, and within the bounds that they state.
#include "shared/query/question.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "shared/base/random.h"
#include "shared/query/scene_maker.h"

namespace scree {
namespace {

AskedFor any_asked(Random& random) {
  const auto part = [&](float half) { return (random.unit() * 2.0F - 1.0F) * half; };
  const auto place = [&](float half) {
    const float x = part(half), y = part(half);
    return glm::vec3(x, y, part(half));
  };
  const bool odd = random.below(8) == 0;
  const glm::vec3 at = place(odd ? 20000.0F : 12.0F), other = at + place(4.0F);
  glm::vec3 unit = glm::normalize(place(1.0F) + glm::vec3(0.001F));
  if (random.below(8) == 0) unit *= 1.5F;
  const float most_m = part(odd ? 2000.0F : 20.0F) + (odd ? 0.0F : 20.0F);
  const float radius_m = 0.5F + part(random.below(8) == 0 ? 20.0F : 0.4F);
  switch (random.below(10)) {
    case 0:
      return UnknownQuestion{};
    case 1:
      return SphereQuestion{at, unit, most_m, radius_m};
    case 2:
      return CapsuleQuestion{at, other, unit, most_m, radius_m};
    case 3:
      return InSphereQuestion{at, radius_m};
    case 4:
      return InBoxQuestion{at, other};
    case 5:
      return NearestQuestion{at, 0.2F * most_m};
    case 6:
      return SolidQuestion{at};
    case 7:
      return ContentQuestion{at, other};
    case 8:
      return BodiesQuestion{at, other};
    default:
      return RayQuestion{at, unit, most_m};
  }
}

TEST(Question, what_is_valid_can_be_asked_and_is_answered_within_its_bounds) {
  const MapField field({TerrainKind::noise, 5, 0.5F});
  const QueryScene scene(field, {});
  Random random(9);
  int valid = 0, refused = 0, hits = 0;
  for (int i = 0; i < 600; ++i) {
    const Question question{any_asked(random)};
    const bool is_valid = validate(question).has_value();
    const auto answer = ask(scene, question);
    ASSERT_EQ(answer.has_value(), is_valid) << i;
    (is_valid ? valid : refused) += 1;
    if (!is_valid) continue;
    const glm::dvec3 eye(3.0, 2.0, 1.0);
    const SpaceBox bounds = bounds_of(question);
    const double reach = reach_from(question, eye);
    const glm::dvec3 off = glm::max(glm::abs(bounds.lo - eye), glm::abs(bounds.hi - eye));
    EXPECT_LE(reach, glm::length(off) * 1.001 + 1e-6);
    const auto* hit = std::get_if<std::optional<Hit>>(&answer->answer);
    if (hit == nullptr || !*hit) continue;
    ++hits;
    const glm::dvec3 place((*hit)->place_m);
    EXPECT_TRUE(bounds.grown(0.01).meets({place, place})) << i;
    EXPECT_LE(glm::length(place - eye), reach + 0.01) << i;
  }
  EXPECT_GT(valid, 200);
  EXPECT_GT(refused, 100);
  EXPECT_GT(hits, 50);
}

TEST(SceneMaker, parts_are_those_of_the_prop_and_shared_from_scene_to_scene) {
  const MapField field({TerrainKind::flat, 5, 0.5F});
  auto crate = std::make_shared<Prop>();
  crate->parts = {
      {.kind = PropPartKind::box, .half_m = glm::vec3(1.0F)},
      {.kind = PropPartKind::cylinder, .place_m = {3.0F, 0.0F, 0.0F}, .half_m = {0.5F, 1.0F, 0.0F}},
      {.kind = PropPartKind::capsule, .place_m = {-3.0F, 0.0F, 0.0F}, .half_m = {0.5F, 1.0F, 0.0F}},
      {.kind = PropPartKind::sphere, .place_m = {0.0F, 3.0F, 0.0F}, .half_m = glm::vec3(0.5F)}};
  crate->groups = 1U << 5U;
  const std::shared_ptr<const Prop> prop = crate;
  for (const Convex& part : convex_parts_of(*prop)) EXPECT_TRUE(validate(part).has_value());
  SceneMaker maker;
  const Convex* first = nullptr;
  for (int i = 0; i < 3; ++i) {
    maker.begin(1);
    maker.add_prop(8, {{0.0F, 50.0F + static_cast<float>(i), 0.0F}}, prop);
    const HeldScene scene = maker.make(field);
    const QuerySolid& solid = scene.scene().solids().front();
    if (first == nullptr) first = solid.parts.data();
    EXPECT_EQ(solid.parts.data(), first);
    for (const float x : {0.0F, 3.0F, -3.0F}) {
      const auto hit = cast_ray(scene, {x, 70.0F, 0.0F}, {0.0F, -1.0F, 0.0F}, 30.0F)->answer;
      ASSERT_TRUE(hit.has_value());
      EXPECT_EQ(hit->kind, HitKind::body);
      EXPECT_EQ(hit->id, 8U);
    }
    QueryMask others;
    others.groups = ~(1U << 5U);
    const auto hit = cast_ray(scene, {0.0F, 70.0F, 0.0F}, {0.0F, -1.0F, 0.0F}, 90.0F, others)->answer;
    EXPECT_TRUE(!hit || hit->kind == HitKind::terrain);
  }
}

TEST(SceneMaker, what_was_read_is_read_again_where_the_field_has_changed) {
  MapField field({TerrainKind::flat, 5, 0.5F});
  SceneMaker maker;
  const auto height = [&] {
    maker.begin(0);
    const HeldScene scene = maker.make(field);
    const auto hit = cast_ray(scene, {2.0F, 20.0F, 2.0F}, {0.0F, -1.0F, 0.0F}, 60.0F)->answer;
    return hit ? hit->place_m.y : -1000.0F;
  };
  const float before = height();
  const BrickCoord raised{0, 2, 0};
  field.set_brick(raised, solid_brick());
  EXPECT_EQ(height(), before);  // it was not told
  maker.forget(chunk_of(raised));
  EXPECT_GT(height(), before + 4.0F);
}

}  // namespace
}  // namespace scree
