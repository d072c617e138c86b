#include "tools/scenes/house.h"

#include <algorithm>

namespace scree {

namespace {

constexpr float storey_m = 3.0F, wall_m = 0.75F, slab_m = 0.5F;
constexpr float sill_m = 1.0F, lintel_m = 2.25F;  ///< of windows, above the storey's floor
constexpr float window_m = 1.25F, pier_m = 1.0F;  ///< widths of windows, and of the least wall between two
constexpr float foundation_m = 1.0F, parapet_m = 0.75F, gable_m = 2.5F, eaves_m = 0.5F;

/// Puts solids with eight or six corners into a mesh.
class Builder {
 public:
  explicit Builder(float voxel_m) : half_voxel_(0.5 * static_cast<double>(voxel_m)) {}

  void box(glm::vec3 lo, glm::vec3 hi) {
    const uint32_t first = add_points({{lo.x, lo.y, lo.z},
                                       {hi.x, lo.y, lo.z},
                                       {hi.x, lo.y, hi.z},
                                       {lo.x, lo.y, hi.z},
                                       {lo.x, hi.y, lo.z},
                                       {hi.x, hi.y, lo.z},
                                       {hi.x, hi.y, hi.z},
                                       {lo.x, hi.y, hi.z}});
    for (const Quad& quad : {Quad{0, 1, 2, 3}, Quad{4, 7, 6, 5}, Quad{0, 4, 5, 1}, Quad{1, 5, 6, 2},
                             Quad{2, 6, 7, 3}, Quad{3, 7, 4, 0}})
      add_quad(first, quad);
  }
  /// A roof whose ridge runs along x, above a rectangle at the height of `lo`.
  void prism(glm::vec3 lo, glm::vec3 hi) {
    const float middle = 0.5F * (lo.z + hi.z);
    const uint32_t first = add_points({{lo.x, lo.y, lo.z},
                                       {hi.x, lo.y, lo.z},
                                       {hi.x, lo.y, hi.z},
                                       {lo.x, lo.y, hi.z},
                                       {lo.x, hi.y, middle},
                                       {hi.x, hi.y, middle}});
    add_quad(first, {0, 1, 2, 3});
    add_quad(first, {0, 4, 5, 1});
    add_quad(first, {2, 5, 4, 3});
    mesh.triangles.push_back({first + 1, first + 5, first + 2});
    mesh.triangles.push_back({first + 0, first + 3, first + 4});
  }

  TriangleMesh mesh;

 private:
  struct Quad {
    uint32_t a, b, c, d;
  };

  uint32_t add_points(std::initializer_list<glm::vec3> points) {
    const auto first = static_cast<uint32_t>(mesh.points.size());
    for (const glm::vec3 point : points) mesh.points.push_back(glm::dvec3(point) + half_voxel_);
    return first;
  }
  void add_quad(uint32_t first, Quad quad) {
    mesh.triangles.push_back({first + quad.a, first + quad.b, first + quad.c});
    mesh.triangles.push_back({first + quad.a, first + quad.c, first + quad.d});
  }

  double half_voxel_;
};

/// One storey of a wall: `put(from, to, low, high)` a part of it, from and to along the wall.
template <typename Put>
void wall(float length_m, float floor_m, const Put& put) {
  put(0.0F, length_m, floor_m, floor_m + sill_m);
  put(0.0F, length_m, floor_m + lintel_m, floor_m + storey_m);
  const int windows = static_cast<int>((length_m - pier_m) / (window_m + pier_m));
  const float share_m = length_m / static_cast<float>(std::max(windows, 1));
  float from_m = 0.0F;
  for (int i = 0; i < windows; ++i) {
    const float middle_m = share_m * (static_cast<float>(i) + 0.5F);
    put(from_m, middle_m - 0.5F * window_m, floor_m + sill_m, floor_m + lintel_m);
    from_m = middle_m + 0.5F * window_m;
  }
  put(from_m, length_m, floor_m + sill_m, floor_m + lintel_m);
}

void storey(Builder& builder, glm::vec3 lo, glm::vec3 hi) {
  for (const float z : {lo.z, hi.z - wall_m})
    wall(hi.x - lo.x, lo.y, [&](float from, float to, float low, float high) {
      builder.box({lo.x + from, low, z}, {lo.x + to, high, z + wall_m});
    });
  for (const float x : {lo.x, hi.x - wall_m})
    wall(hi.z - lo.z, lo.y, [&](float from, float to, float low, float high) {
      builder.box({x, low, lo.z + from}, {x + wall_m, high, lo.z + to});
    });
  builder.box({lo.x + 0.25F, hi.y - slab_m, lo.z + 0.25F}, {hi.x - 0.25F, hi.y, hi.z - 0.25F});
}

void parapet(Builder& builder, glm::vec3 lo, glm::vec3 hi) {
  const float top = hi.y + parapet_m, bottom = hi.y - slab_m;
  for (const float z : {lo.z, hi.z - wall_m}) builder.box({lo.x, bottom, z}, {hi.x, top, z + wall_m});
  for (const float x : {lo.x, hi.x - wall_m}) builder.box({x, bottom, lo.z}, {x + wall_m, top, hi.z});
}

}  // namespace

TriangleMesh house(const HousePlan& plan, float voxel_m) {
  Builder builder(voxel_m);
  const glm::vec3 lo(plan.x_m, 0.0F, plan.z_m), hi(plan.x_m + plan.width_m, 0.0F, plan.z_m + plan.depth_m);
  builder.box({lo.x, -foundation_m, lo.z}, {hi.x, 0.25F, hi.z});
  for (int i = 0; i < plan.storeys; ++i) {
    const float floor_m = storey_m * static_cast<float>(i);
    storey(builder, {lo.x, floor_m, lo.z}, {hi.x, floor_m + storey_m, hi.z});
  }
  const float top_m = storey_m * static_cast<float>(plan.storeys);
  if (plan.gable)
    builder.prism({lo.x - eaves_m, top_m - 0.25F, lo.z - eaves_m},
                  {hi.x + eaves_m, top_m + gable_m, hi.z + eaves_m});
  else
    parapet(builder, {lo.x, top_m, lo.z}, {hi.x, top_m, hi.z});
  builder.mesh.name = "house";
  return std::move(builder.mesh);
}

}  // namespace scree
