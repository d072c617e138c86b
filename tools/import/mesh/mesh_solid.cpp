#include "tools/import/mesh/mesh_solid.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <map>
#include <set>

#include "tools/import/limits.h"
#include "tools/import/mesh/edge_bound.h"
#include "tools/import/mesh/triangle_distance.h"
#include "tools/import/mesh/winding.h"

namespace scree {

namespace {

constexpr int band_around = 4;

/// Up to here from the triangles, levels are distances. Between two voxels that are both farther lies no
/// surface of a closed mesh. Voxels.
constexpr float near_voxels = 2.0F;

/// Voxels up to here from a triangle are looked at, with room for rounding.
constexpr double near_rows_voxels = 2.1;

/// So many voxels is a whole winding where no triangle is near.
constexpr float voxels_per_winding = 4.0F;

/// A voxel that lies nearer to a triangle than this is looked at on both sides of it.
constexpr float touching_voxels = 0.002F;

/// Two voxels a voxel apart, of which each is so far from all triangles that none is between them: the sum of
/// their distances, with room for rounding. Voxels.
constexpr float none_between = 1.01F;

/// Steps from a voxel within which its winding number is computed, not carried over, where holes are closed.
constexpr double steps_kept_exact = 1.8;

/// A brick lies far from all triangles from so many of its own sizes on.
constexpr double far_reaches = 4.0;

class MeshSolid final : public Solid {
 public:
  MeshSolid(TriangleMesh mesh, const std::vector<OpenBody::Edge>& open, float voxel_size_m)
      : mesh_(std::move(mesh)), closed_(open.empty()), voxel_m_(voxel_size_m), tree_(mesh_), holes_(open) {
    glm::dvec3 lo(1e300), hi(-1e300);
    for (const auto& t : mesh_.triangles)
      for (const uint32_t corner : t)
        lo = glm::min(lo, mesh_.points[corner]), hi = glm::max(hi, mesh_.points[corner]);
    if (mesh_.triangles.empty()) return;
    lowest_m_ = lo.y;
    box_ = {floored(lo), floored(hi) + VoxelCoord{1, 1, 1}};
    for (size_t i = 1; i < mesh_.materials.size(); ++i)
      one_material_ = one_material_ && mesh_.materials[i] == mesh_.materials[0];
  }

  /// Before all else that reads the mesh.
  Result<void> prepare() {
    TRY(layout_around(box_, static_cast<float>(voxel_m_)));
    size_t touched = closed_ ? 0 : count_chunks(box_);
    for (uint32_t i = 0; i < mesh_.triangles.size(); ++i) {
      const VoxelBox box = voxels_of(mesh_.triangles[i]).grown(band_around);
      touched += count_chunks(box);
      if (touched > limits::solid_surface_max)
        return fail(
            fmt::format("it is too large, or has too many triangles, for voxels of {:.6g} m "
                        "(limits.solid_surface_max); larger ones "
                        "(--voxel-size) or a smaller --scale fit",
                        voxel_m_));
      for_each_chunk(box, [&](ChunkCoord chunk) { near_[chunk].push_back(i); });
    }
    return {};
  }

  std::vector<ChunkCoord> surface_chunks() const override {
    std::set<ChunkCoord> chunks;
    for (const auto& [chunk, triangles] : near_) chunks.insert(chunk);
    // The surface that closes a hole lies anywhere in between.
    if (!closed_)
      for_each_chunk(box_, [&](ChunkCoord chunk) {
        if (!near_.contains(chunk) && closes_in(chunk)) chunks.insert(chunk);
      });
    return {chunks.begin(), chunks.end()};
  }
  VoxelBox box() const override { return box_; }
  double lowest_m() const override { return lowest_m_; }
  bool is_inside(VoxelCoord voxel) const override {
    return box_.grown(1).holds(voxel) && tree_.winding(metres(voxel)) > 0.5;
  }
  /// Each voxel's is that of the triangle nearest to it, on whose inner side it lies; far from all triangles,
  /// all of a brick have one.
  BrickMaterials materials(BrickCoord brick) const override {
    if (mesh_.materials.empty()) return {};
    if (one_material_) return BrickMaterials(mesh_.materials.front());
    const VoxelCoord first = first_voxel(brick);
    constexpr double middle = 0.5 * (brick_size - 1);
    const glm::dvec3 centre = metres(first) + glm::dvec3(middle * voxel_m_);
    const double reach_m = middle * 1.7321 * voxel_m_;
    const WindingTree::Nearest nearest = tree_.nearest(centre);
    const VoxelMaterial one = mesh_.materials[tree_.owner(centre)];
    const auto is_one = [&](uint32_t triangle) { return mesh_.materials[triangle] == one; };
    if (nearest.distance > far_reaches * reach_m ||
        tree_.all_near(centre, nearest.distance + 2.0 * reach_m, is_one))
      return BrickMaterials(one);
    VoxelMaterials voxels;
    for (int i = 0; i < brick_voxels; ++i)
      voxels[static_cast<size_t>(i)] =
          mesh_.materials[tree_.owner(metres(first + VoxelCoord{i >> 6, (i >> 3) & 7, i & 7}))];
    return BrickMaterials(voxels);
  }

  void read_levels(const VoxelBox& box, std::span<float> levels) const override {
    read_distances(box, levels);
    const std::vector<float> distances(levels.begin(), levels.end());
    const VoxelCoord size = box.size();
    const std::array<size_t, 3> strides = {static_cast<size_t>(size.y) * static_cast<size_t>(size.z),
                                           static_cast<size_t>(size.z), 1};
    std::vector<Reading> readings(levels.size());
    HoleSlopes slopes(*this, box);
    size_t i = 0;
    for (int x = 0; x < size.x; ++x)
      for (int y = 0; y < size.y; ++y)
        for (int z = 0; z < size.z; ++z, ++i) {
          const VoxelCoord voxel = box.lo + VoxelCoord{x, y, z};
          const double slope = closed_ ? 0.0 : slopes.at(voxel);
          readings[i] = {};
          for (const size_t back : {z > 0 ? strides[2] : 0, y > 0 ? strides[1] : 0, x > 0 ? strides[0] : 0})
            if (back > 0 && distances[i] + distances[i - back] > none_between)
              readings[i].carry(readings[i - back], slope);
          if (distances[i] < touching_voxels) {
            levels[i] = level_on_triangle(voxel);
            continue;
          }
          if (!readings[i].is_known) readings[i].set(tree_.winding(metres(voxel)));
          levels[i] = level_of(distances[i], readings[i].winding);
        }
  }

 private:
  /// A winding number, and how far it is from the surface that closes holes, at least.
  struct Reading {
    double winding = 0.0;
    double margin = 0.0;
    bool is_known = false;

    void set(double computed) { *this = {computed, std::abs(computed - 0.5), true}; }
    /// From a voxel beside this, where the winding number changes by `slope` a step at most.
    void carry(const Reading& beside, double slope) {
      const double left = beside.margin - slope;
      if (is_known || !(left > steps_kept_exact * slope)) return;
      *this = {beside.winding, left, true};
    }
  };

  /// The most by which winding numbers change from voxel to voxel, by brick of a box.
  class HoleSlopes {
   public:
    HoleSlopes(const MeshSolid& solid, const VoxelBox& box) : solid_(solid), lo_(box.lo) {
      const VoxelCoord size = box.size();
      count_ = {bricks(size.x), bricks(size.y), bricks(size.z)};
      slopes_.assign(static_cast<size_t>(count_.x * count_.y * count_.z), -1.0);
    }
    double at(VoxelCoord voxel) {
      const VoxelCoord brick{(voxel.x - lo_.x) / brick_size, (voxel.y - lo_.y) / brick_size,
                             (voxel.z - lo_.z) / brick_size};
      double& slope = slopes_[static_cast<size_t>((brick.x * count_.y + brick.y) * count_.z + brick.z)];
      if (slope < 0.0) {
        constexpr double middle = 0.5 * (brick_size - 1), reach = 0.5 * (brick_size + 1) * 1.7321;
        const VoxelCoord first =
            lo_ + VoxelCoord{brick.x * brick_size, brick.y * brick_size, brick.z * brick_size};
        const glm::dvec3 centre = solid_.metres(first) + glm::dvec3(middle * solid_.voxel_m_);
        slope = solid_.holes_.most_per_m(centre, reach * solid_.voxel_m_) * solid_.voxel_m_;
      }
      return slope;
    }

   private:
    static int bricks(int voxels) { return (voxels + brick_size - 1) / brick_size; }

    const MeshSolid& solid_;
    VoxelCoord lo_;
    VoxelCoord count_;
    std::vector<double> slopes_;
  };

  /// Whether the surface that closes holes may come near a chunk without triangles.
  bool closes_in(ChunkCoord chunk) const {
    constexpr double reach = (0.5 * chunk_size + band_around + 1) * 1.7321;
    const glm::dvec3 centre = metres(first_voxel(chunk)) + glm::dvec3(0.5 * (chunk_size - 1) * voxel_m_);
    const double change = holes_.most_per_m(centre, reach * voxel_m_) * reach * voxel_m_;
    return !(std::abs(tree_.winding(centre) - 0.5) > change);
  }

  static float level_of(float distance, double winding) {
    const auto outside = static_cast<float>(0.5 - winding);
    if (distance >= near_voxels) return voxels_per_winding * outside;
    return outside < 0.0F ? -distance : distance;
  }

  /// 0, but inside where a triangle lies within the rest of the mesh: on a triangle itself, winding numbers
  /// jump.
  float level_on_triangle(VoxelCoord voxel) const {
    const glm::dvec3 aside =
        glm::dvec3(0.71, 1.0, 0.53) * (2.0 * static_cast<double>(touching_voxels) * voxel_m_);
    const bool inside =
        tree_.winding(metres(voxel) + aside) > 0.5 && tree_.winding(metres(voxel) - aside) > 0.5;
    return inside ? -voxels_per_winding : 0.0F;
  }

  glm::dvec3 metres(VoxelCoord voxel) const { return glm::dvec3(voxel.x, voxel.y, voxel.z) * voxel_m_; }
  VoxelCoord floored(const glm::dvec3& p_m) const {
    constexpr double far = 1.0e8;
    const auto axis = [&](double metres) {
      return static_cast<int>(std::floor(std::clamp(metres / voxel_m_, -far, far)));
    };
    return {axis(p_m.x), axis(p_m.y), axis(p_m.z)};
  }
  VoxelBox voxels_of(const std::array<uint32_t, 3>& t) const {
    const glm::dvec3 &a = mesh_.points[t[0]], &b = mesh_.points[t[1]], &c = mesh_.points[t[2]];
    return {floored(glm::min(a, glm::min(b, c))), floored(glm::max(a, glm::max(b, c))) + VoxelCoord{2, 2, 2}};
  }

  /// To the triangles of the chunks around, as far as near_voxels; more where none is as near.
  void read_distances(const VoxelBox& box, std::span<float> distances) const {
    std::ranges::fill(distances, band_voxels);
    std::vector<uint32_t> triangles;
    for_each_chunk(box, [&](ChunkCoord chunk) {
      if (const auto found = near_.find(chunk); found != near_.end())
        triangles.insert(triangles.end(), found->second.begin(), found->second.end());
    });
    std::ranges::sort(triangles);
    triangles.erase(std::unique(triangles.begin(), triangles.end()), triangles.end());
    const VoxelCoord size = box.size();
    for (const uint32_t i : triangles) {
      const auto& t = mesh_.triangles[i];
      const VoxelBox part = common(voxels_of(t).grown(static_cast<int>(near_voxels)), box);
      // A triangle of a chunk around may not reach the box.
      if (part.empty()) continue;
      const NearRows rows(mesh_.points[t[0]], mesh_.points[t[1]], mesh_.points[t[2]],
                          near_rows_voxels * voxel_m_);
      for (int x = part.lo.x; x < part.hi.x; ++x)
        for (int y = part.lo.y; y < part.hi.y; ++y) {
          const auto [first_m, last_m] = rows.at(x * voxel_m_, y * voxel_m_);
          const auto first =
              static_cast<int>(std::ceil(std::clamp(first_m / voxel_m_, 1.0 * part.lo.z, 1.0 * part.hi.z)));
          const auto end =
              1 +
              static_cast<int>(std::floor(std::clamp(last_m / voxel_m_, part.lo.z - 1.0, part.hi.z - 1.0)));
          for (int z = first; z < end; ++z) {
            float& nearest = distances[(static_cast<size_t>(x - box.lo.x) * static_cast<size_t>(size.y) +
                                        static_cast<size_t>(y - box.lo.y)) *
                                           static_cast<size_t>(size.z) +
                                       static_cast<size_t>(z - box.lo.z)];
            const double m =
                distance_to(metres({x, y, z}), mesh_.points[t[0]], mesh_.points[t[1]], mesh_.points[t[2]]);
            nearest = std::min(nearest, static_cast<float>(m / voxel_m_));
          }
        }
    }
  }

  const TriangleMesh mesh_;
  const bool closed_;
  const double voxel_m_;
  const WindingTree tree_;
  const EdgeBound holes_;
  bool one_material_ = true;
  std::map<ChunkCoord, std::vector<uint32_t>> near_;
  VoxelBox box_{};
  double lowest_m_ = 0.0;
};

}  // namespace

Result<std::unique_ptr<Solid>> solid_of_mesh(TriangleMesh mesh, const std::vector<OpenBody::Edge>& open,
                                             float voxel_size_m) {
  auto solid = std::make_unique<MeshSolid>(std::move(mesh), open, voxel_size_m);
  TRY(solid->prepare());
  return solid;
}

}  // namespace scree
