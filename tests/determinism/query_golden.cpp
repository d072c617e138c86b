// The part of kernels_golden about questions about space.
#include <algorithm>

#include "bench/support/carved_field.h"
#include "shared/query/query.h"
#include "tests/determinism/golden.h"

namespace scree {
namespace {

void add_answer(GoldenHash& digest, const QueryResult<std::optional<Hit>>& result) {
  digest.add(uint64_t{result.has_value() ? 1U : 0U});
  if (!result) return;
  digest.add(uint64_t{result->cost.steps});
  digest.add(uint64_t{result->cost.chunks});
  if (!result->answer) return;
  const Hit& hit = *result->answer;
  digest.add(uint64_t{hit.id} << 16U | static_cast<uint64_t>(hit.kind) << 8U | (hit.inside ? 1U : 0U));
  digest.add(uint64_t{row_number(hit.material)});
  digest.add(hit.distance_m);
  digest.add(hit.place_m);
  digest.add(hit.normal);
}

void add_answer(GoldenHash& digest, const QueryResult<Overlapping>& result) {
  if (!result) return;
  digest.add(uint64_t{result->answer.terrain ? 1U : 0U});
  for (const PieceId id : result->answer.ids) digest.add(uint64_t{id});
}

glm::vec3 any_of(Random& random, float half) {
  const auto part = [&] { return (random.unit() * 2.0F - 1.0F) * half; };
  return {part(), part(), part()};
}

glm::vec3 unit_vector(Random& random) {
  for (;;) {
    const glm::vec3 v = any_of(random, 1.0F);
    const float squared = glm::dot(v, v);
    if (squared > 0.1F) return v / std::sqrt(squared);
  }
}

}  // namespace

void print_queries() {
  MapField field({TerrainKind::canyon, 7, 0.25F});
  const glm::vec3 middle(3.0F, ground_height_m(field.source(), 3.0F, 2.0F), 2.0F);
  roughen(field, middle, 5.0F, 30, 3);
  Random random(4);
  Volume volume;
  const VoxelCoord lo{static_cast<int>(middle.x * 4.0F) - 8, static_cast<int>(middle.y * 4.0F) - 12, 0};
  volume.window = gather(field, {lo, lo + VoxelCoord{16, 14, 18}});
  volume.centre_voxels = glm::vec3(lo.x, lo.y, lo.z) + 7.3F;
  const std::vector<Convex> parts{convex_cylinder({}, 0.7F, 1.0F),
                                  convex_capsule({}, {0.0F, 2.0F, 0.3F}, 0.2F)};
  std::vector<QuerySolid> solids;
  for (PieceId id = 1; id <= 30; ++id) {
    const glm::vec3 q = any_of(random, 1.0F);
    QuerySolid solid;
    solid.id = id;
    solid.pose = {middle + any_of(random, 6.0F), glm::quat(0.4F + random.unit(), q.x, q.y, q.z)};
    if (id % 2 == 0)
      solid.volume = &volume;
    else
      solid.parts = parts;
    solids.push_back(solid);
  }
  const QueryScene scene(field, solids);
  GoldenHash casts, others;
  for (int i = 0; i < 400; ++i) {
    const glm::vec3 from = middle + any_of(random, 6.0F), unit = unit_vector(random);
    add_answer(casts, cast_ray(scene, from, unit, 12.0F));
    add_answer(casts, cast_sphere(scene, from, unit, 3.0F, 0.3F));
    if (i % 4 == 0)
      add_answer(casts, cast_capsule(scene, from, from + unit_vector(random), unit, 2.0F, 0.25F));
    add_answer(others, nearest_surface(scene, from, 2.0F));
    add_answer(others, overlap_sphere(scene, from, 0.8F));
    add_answer(others, overlap_box(scene, from - 0.5F, from + 0.4F));
    others.add(uint64_t{is_solid(scene, from)->answer ? 1U : 0U});
  }
  const auto content = box_content(scene, middle - 4.0F, middle + 3.3F);
  for (const MaterialMass& one : content->answer.masses) others.add(static_cast<uint64_t>(one.mass));
  casts.print("query_casts");
  others.print("query_others");
}

}  // namespace scree
