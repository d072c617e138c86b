// Questions about pieces and bodies at any pose.
#include <algorithm>
#include <gtest/gtest.h>

#include "bench/support/brute_surface.h"
#include "shared/base/random.h"
#include "shared/query/query.h"
#include "shared/query/vectors.h"

namespace scree {
namespace {

constexpr float size_m = 0.25F;  ///< of a voxel

glm::vec3 any(Random& random, float half) {
  const auto part = [&] { return (random.unit() * 2.0F - 1.0F) * half; };
  return {part(), part(), part()};
}

glm::vec3 any_direction(Random& random) {
  for (;;) {
    const glm::dvec3 v(any(random, 1.0F));
    if (glm::dot(v, v) > 0.01) return glm::vec3(unit_of(v));
  }
}

glm::quat any_rotation(Random& random) {
  for (;;) {
    const glm::vec3 v = any(random, 1.0F);
    const glm::quat q(random.unit() * 2.0F - 1.0F, v.x, v.y, v.z);
    if (glm::dot(q, q) > 0.1F) return glm::normalize(q);
  }
}

/// A lumpy rock with a hollow, of two materials.
Volume lump(Random& random) {
  Volume volume;
  volume.window = Window({{3, -14, 20}, {25, 9, 41}});
  const VoxelBox& box = volume.window.box;
  volume.materials = {box, material::rock, std::vector<Material>(Window::count(box), material::rock)};
  const glm::vec3 middle(13.6F, -2.7F, 30.1F),
      lumps[2] = {middle + any(random, 4.0F), middle + any(random, 4.0F)};
  for (int x = box.lo.x; x < box.hi.x; ++x)
    for (int y = box.lo.y; y < box.hi.y; ++y)
      for (int z = box.lo.z; z < box.hi.z; ++z) {
        const glm::vec3 p(x, y, z);
        const float out = std::min(glm::length(p - lumps[0]) - 6.2F, glm::length(p - lumps[1]) - 5.3F);
        volume.window.at(x, y, z) = encode(std::max(out, 2.5F - glm::length(p - middle)));
        if (x > 13) volume.materials.each[volume.window.index(x, y, z)] = material::soil;
      }
  volume.centre_voxels = middle;
  return volume;
}

/// Pieces in the air above flat ground, each with its mesh.
class QuerySolids : public ::testing::Test {
 protected:
  static constexpr size_t count = 40;

  QuerySolids() {
    Random random(5);
    for (size_t i = 0; i < count; ++i) volumes_.push_back(lump(random));
    for (size_t i = 0; i < count; ++i) {
      meshes_[i].add(surface_nets_closed(volumes_[i].window));
      QuerySolid solid;
      solid.id = static_cast<PieceId>(10 + 3 * i);
      solid.pose = {any(random, 14.0F) + glm::vec3(0.0F, 20.0F, 0.0F), any_rotation(random)};
      solid.volume = &volumes_[i];
      solids_.push_back(solid);
    }
  }
  glm::dvec3 turned(size_t i, glm::dvec3 v) const {
    const glm::quat& q = solids_[i].pose.rotation;
    return glm::conjugate(glm::normalize(glm::dquat(q.w, q.x, q.y, q.z))) * v;
  }
  glm::dvec3 in_volume(size_t i, glm::vec3 place_m) const {
    return turned(i, glm::dvec3(place_m) - glm::dvec3(solids_[i].pose.position_m)) / double(size_m) +
           glm::dvec3(volumes_[i].centre_voxels);
  }

  const MapField field_{TerrainSource{TerrainKind::flat, 1, size_m}};
  std::vector<Volume> volumes_;
  std::array<BruteSurface, count> meshes_;
  std::vector<QuerySolid> solids_;
};

TEST_F(QuerySolids, rays_and_balls_meet_the_first_pieces_mesh) {
  const QueryScene scene(field_, solids_);
  Random random(6);
  int hits = 0, inside = 0;
  for (int i = 0; i < 6000; ++i) {
    const glm::vec3 from = any(random, 12.0F) + glm::vec3(0.0F, 20.0F, 0.0F), unit = any_direction(random);
    const double radius_m = i % 3 == 0 ? 0.15 : 0.0;
    const auto cast =
        radius_m > 0.0 ? cast_sphere(scene, from, unit, 15.0F, 0.15F) : cast_ray(scene, from, unit, 15.0F);
    ASSERT_TRUE(cast);
    const auto& hit = cast->answer;
    if (hit && hit->inside) {
      ++inside;
      EXPECT_EQ(hit->distance_m, 0.0F);
      EXPECT_TRUE(overlap_sphere(scene, from, 0.15F)->answer.ids.size() > 0);
      continue;
    }
    double best = 15.0;
    PieceId id = 0;
    for (size_t k = 0; k < count; ++k) {
      const glm::dvec3 start = in_volume(k, from), way = turned(k, unit_of(glm::dvec3(unit)));
      if (glm::length(glm::dvec3(from - solids_[k].pose.position_m)) > 15.0 + 6.0) continue;
      const auto along = radius_m > 0.0 ? meshes_[k].first_of_capsule(start, glm::dvec3(0.0), way,
                                                                      best / size_m, radius_m / size_m)
                                        : meshes_[k].first_on_line(start, way, best / size_m);
      if (!along) continue;
      best = *along * size_m;
      id = solids_[k].id;
    }
    // The flat ground is no piece.
    if (hit && hit->kind == HitKind::terrain) {
      EXPECT_LE(hit->distance_m, best);
      continue;
    }
    ASSERT_EQ(hit.has_value(), id != 0) << i;
    if (!hit) continue;
    ++hits;
    EXPECT_EQ(hit->kind, HitKind::piece);
    EXPECT_EQ(hit->id, id);
    EXPECT_NEAR(hit->distance_m, best, 1e-3);
    EXPECT_LT(glm::dot(hit->normal, unit), 1e-5F);
    const size_t index = (hit->id - 10) / 3;
    const double x = in_volume(index, hit->place_m - hit->normal * (0.5F * size_m)).x;
    if (std::abs(x - 13.5) > 2.6) {
      EXPECT_EQ(hit->material, x > 13.5 ? material::soil : material::rock);
    }
  }
  EXPECT_GT(hits, 900);
  EXPECT_GT(inside, 30);
}

TEST_F(QuerySolids, pieces_near_and_overlapping_are_found) {
  const QueryScene scene(field_, solids_);
  Random random(7);
  size_t found = 0;
  for (int i = 0; i < 600; ++i) {
    const glm::vec3 at = any(random, 12.0F) + glm::vec3(0.0F, 20.0F, 0.0F);
    const float radius = 0.1F + random.unit() * 2.5F;
    const auto overlapping = overlap_sphere(scene, at, radius);
    const auto near = nearest_surface(scene, at, radius);
    ASSERT_TRUE(overlapping && near);
    std::vector<PieceId> ids;
    double nearest = radius;
    for (size_t k = 0; k < count; ++k) {
      const glm::dvec3 place = in_volume(k, at);
      const double distance = meshes_[k].distance(place, glm::dvec3(0.0), 1.0 + radius / size_m) * size_m;
      QueryMask mask;
      mask.terrain = false;
      for (const QuerySolid& other : solids_)
        if (other.id != solids_[k].id) mask.except.push_back(other.id);
      const bool solid = is_solid(scene, at, mask)->answer;
      if (distance <= radius || solid) ids.push_back(solids_[k].id);
      nearest = std::min(nearest, distance);
      const glm::vec3 half(radius * 0.5F);
      const auto in_box = overlap_box(scene, at - half, at + half, mask)->answer;
      if (distance <= radius * 0.5F || solid) {
        EXPECT_EQ(in_box.ids, std::vector{solids_[k].id}) << i;
      }
      if (distance > radius * 0.9F && !solid) {
        EXPECT_TRUE(in_box.ids.empty()) << i;
      }
    }
    found += ids.size();
    EXPECT_EQ(overlapping->answer.ids, ids);
    ASSERT_EQ(near->answer.has_value(), nearest < radius);
    if (near->answer) {
      EXPECT_NEAR(near->answer->distance_m, nearest, 1e-4);
    }
  }
  EXPECT_GT(found, 100U);
}

TEST_F(QuerySolids, solids_in_a_box_are_those_whose_positions_are) {
  const QueryScene scene(field_, solids_);
  const glm::vec3 lo(-5.0F, 10.0F, -9.0F), hi(8.0F, 25.0F, 9.0F);
  std::vector<PieceId> ids;
  for (const QuerySolid& solid : solids_) {
    const glm::vec3 p = solid.pose.position_m;
    if (p.x >= lo.x && p.y >= lo.y && p.z >= lo.z && p.x < hi.x && p.y < hi.y && p.z < hi.z)
      ids.push_back(solid.id);
  }
  EXPECT_GT(ids.size(), 3U);
  EXPECT_EQ(solids_in(scene, lo, hi)->answer, ids);
  QueryMask bodies;
  bodies.pieces = false;
  EXPECT_TRUE(solids_in(scene, lo, hi, bodies)->answer.empty());
}

/// A body of a box and a ball on top of it, turned and moved.
struct Statue {
  std::vector<Convex> parts{convex_box({0.0F, 1.0F, 0.0F}, {0.5F, 1.0F, 0.25F}),
                            convex_sphere({0.0F, 2.5F, 0.0F}, 0.5F)};
  Pose pose{{100.0F, 50.0F, -30.0F}, {0.8F, 0.0F, 0.6F, 0.0F}};  // about y

  QuerySolid solid(PieceId id, uint32_t groups = 1) const { return {id, pose, nullptr, parts, groups}; }
};

TEST_F(QuerySolids, bodies_are_hit_at_their_parts) {
  const Statue statue;
  const std::vector<QuerySolid> solids{statue.solid(7)};
  const QueryScene scene(field_, solids);
  const glm::vec3 foot = statue.pose.position_m;
  const auto down = cast_ray(scene, foot + glm::vec3(0.0F, 10.0F, 0.0F), {0.0F, -1.0F, 0.0F}, 20.0F)->answer;
  ASSERT_TRUE(down);
  EXPECT_EQ(down->kind, HitKind::body);
  EXPECT_EQ(down->id, 7U);
  EXPECT_NEAR(down->distance_m, 7.0F, 1e-4F);
  EXPECT_NEAR(down->normal.y, 1.0F, 1e-4F);
  // The box's own x axis, in the world: cosine 0.28, sine 0.96.
  const glm::vec3 aside(0.28F, 0.0F, -0.96F);
  const auto side =
      cast_sphere(scene, foot + aside * 5.0F + glm::vec3(0.0F, 1.0F, 0.0F), -aside, 20.0F, 0.25F)->answer;
  ASSERT_TRUE(side);
  EXPECT_NEAR(side->distance_m, 4.25F, 1e-4F);
  EXPECT_NEAR(glm::dot(side->normal, aside), 1.0F, 1e-4F);
  EXPECT_NEAR(glm::dot(side->place_m - foot, aside), 0.5F, 1e-4F);
  const glm::vec3 start = foot + aside * 5.0F;
  const auto tall =
      cast_capsule(scene, start, start + glm::vec3(0.0F, 3.0F, 0.0F), -aside, 20.0F, 0.25F)->answer;
  ASSERT_TRUE(tall);
  EXPECT_NEAR(tall->distance_m, 4.25F, 1e-4F);
  const glm::vec3 heart = foot + glm::vec3(0.0F, 1.0F, 0.0F);
  EXPECT_TRUE(cast_ray(scene, heart, {1.0F, 0.0F, 0.0F}, 5.0F)->answer->inside);
  EXPECT_TRUE(is_solid(scene, heart)->answer);
  EXPECT_FALSE(is_solid(scene, heart + aside * 0.51F)->answer);
  const auto near = nearest_surface(scene, heart + aside * 2.5F, 8.0F)->answer;
  ASSERT_TRUE(near);
  EXPECT_NEAR(near->distance_m, 2.0F, 1e-4F);
  EXPECT_EQ(overlap_sphere(scene, heart + aside * 2.5F, 2.1F)->answer.ids, std::vector<PieceId>{7});
  EXPECT_TRUE(overlap_sphere(scene, heart + aside * 2.5F, 1.9F)->answer.ids.empty());
  EXPECT_EQ(overlap_box(scene, foot - 0.1F, foot + 0.1F)->answer.ids, std::vector<PieceId>{7});
  EXPECT_TRUE(overlap_box(scene, foot + 4.0F, foot + 5.0F)->answer.ids.empty());
}

TEST_F(QuerySolids, masks_choose) {
  const Statue statue;
  std::vector<QuerySolid> solids{statue.solid(7, 2), statue.solid(9, 4)};
  const glm::vec3 from = statue.pose.position_m + glm::vec3(0.0F, 10.0F, 0.0F), down(0.0F, -1.0F, 0.0F);
  const QueryScene scene(field_, solids);
  const auto hit_by = [&](const QueryMask& mask) {
    return cast_ray(scene, from, down, 100.0F, mask)->answer;
  };
  QueryMask mask;
  EXPECT_EQ(hit_by(mask)->id, 7U);  // the smaller of two as near
  mask.groups = 4;
  EXPECT_EQ(hit_by(mask)->id, 9U);
  mask.groups = 6;
  mask.except = {7};
  EXPECT_EQ(hit_by(mask)->id, 9U);
  mask.bodies = false;
  EXPECT_EQ(hit_by(mask)->kind, HitKind::terrain);
  mask.terrain = false;
  EXPECT_FALSE(hit_by(mask));
}

/// The tree leaves nothing out: thousands of balls, each ray against every one.
TEST_F(QuerySolids, none_of_thousands_is_missed) {
  Random random(8);
  const std::vector<Convex> parts{convex_sphere({}, 0.5F)};
  std::vector<QuerySolid> solids;
  for (PieceId id = 1; id <= 3000; ++id)
    solids.push_back({id, {any(random, 60.0F) + glm::vec3(0.0F, 100.0F, 0.0F)}, nullptr, parts, 1});
  const QueryScene scene(field_, solids);
  int hits = 0;
  for (int i = 0; i < 2500; ++i) {
    const glm::vec3 from = any(random, 60.0F) + glm::vec3(0.0F, 100.0F, 0.0F), unit = any_direction(random);
    double best = 80.0;
    PieceId id = 0;
    bool inside = false;
    for (const QuerySolid& solid : solids) {
      const glm::dvec3 off = glm::dvec3(from) - glm::dvec3(solid.pose.position_m);
      inside = inside || glm::length(off) < 0.5;
      const glm::dvec3 way = unit_of(glm::dvec3(unit));
      const double towards = glm::dot(off, way), root = towards * towards - glm::dot(off, off) + 0.25;
      if (root < 0.0 || towards > 0.0 || -towards - std::sqrt(root) > best) continue;
      best = -towards - std::sqrt(root);
      id = solid.id;
    }
    const auto hit = cast_ray(scene, from, unit, 80.0F)->answer;
    if (inside || (hit && hit->kind == HitKind::terrain)) continue;
    ASSERT_EQ(hit ? hit->id : 0, id) << i;
    hits += id != 0 ? 1 : 0;
  }
  EXPECT_GT(hits, 100);
}

}  // namespace
}  // namespace scree
