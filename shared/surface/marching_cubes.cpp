#include "shared/surface/marching_cubes.h"

#include <algorithm>
#include <bit>
#include <map>

#include "shared/base/check.h"
#include "shared/surface/cube_cases.h"
#include "shared/surface/leaf_loops.h"
#include "shared/surface/sign_rows.h"
#include "shared/surface/surface_cells.h"
#include "shared/surface/surface_vertices.h"

namespace scree {
namespace {

constexpr uint32_t no_vertex = 0xFFFFFFFFU;

/// The place where an edge is crossed, in 1/256 of it: so far off its ends that between it and the crossings
/// of other edges there is a place that is neither.
int crossing_steps(float from, float to) {
  CHECK_DEBUG((from < 0.0F) != (to < 0.0F));
  const auto along = static_cast<int>(from / (from - to) * surface_steps_per_voxel + 0.5F);
  return std::clamp(along, 2, surface_steps - 2);
}

class CubesBuilder {
 public:
  CubesBuilder(const Window& window, const VoxelBox& owned, const Window* before, const CellMask* mask)
      : window_(window), before_(before), mask_(mask), owned_(owned), cells_(owned.size()) {
    mesh_.origin = owned.lo;
  }

  SurfaceMesh build() {
    if (!read_signs()) return std::move(mesh_);
    slots_.assign(Window::count({{0, 0, 0}, cells_ + VoxelCoord{1, 1, 1}}) * 3, no_vertex);
    for (size_t e = 0; e < cell_edges; ++e) {
      const int from = cell_tables_.edges[e].from;
      slot_offsets_[e] = slot(from >> 2, (from >> 1) & 1, from & 1, static_cast<int>(e) / 4);
    }
    for (int x = 0; x < cells_.x; ++x)
      for (int y = 0; y < cells_.y; ++y) add_row(x, y);
    add_placed_vertices(window_, before_, vertices_, mesh_);
    return std::move(mesh_);
  }

 private:
  size_t slot(int x, int y, int z, int axis) const {
    CHECK_DEBUG(x <= cells_.x && y <= cells_.y && z <= cells_.z);
    const int point = (x * (cells_.y + 1) + y) * (cells_.z + 1) + z;
    return static_cast<size_t>(point * 3 + axis);
  }
  /// Bit z: rock; of the row of points.
  uint64_t signs(int x, int y) const { return rows_[static_cast<size_t>(x * (cells_.y + 1) + y)]; }

  /// False when there is but one sign.
  bool read_signs() {
    const int count = cells_.z + 1;
    // Short rows are read together with codes before them: sign_bits needs eight codes.
    const int early = std::max(0, 8 - count);
    bool any = false, all = true;
    for (int x = 0; x <= cells_.x; ++x)
      for (int y = 0; y <= cells_.y; ++y) {
        const Code* codes = &window_.codes[window_.index(owned_.lo.x + x, owned_.lo.y + y, owned_.lo.z)];
        const uint64_t row = sign_bits(codes - early, count + early) >> early;
        any = any || row != 0;
        all = all && std::popcount(row) == count;
        rows_.push_back(row);
      }
    return any && !all;
  }

  /// Bit z: the cell is to be meshed.
  uint64_t counted(int x, int y) const {
    const uint64_t row = (uint64_t{1} << cells_.z) - 1;
    if (mask_ == nullptr) return row;
    return row & mask_->row(owned_.lo.x + x, owned_.lo.y + y) >> (owned_.lo.z - mask_->cells().lo.z);
  }

  void add_row(int x, int y) {
    const SignRows rows{signs(x, y), signs(x, y + 1), signs(x + 1, y), signs(x + 1, y + 1)};
    for (uint64_t left = rows.active() & counted(x, y); left != 0; left &= left - 1) {
      const int z = std::countr_zero(left);
      add_cell(x, y, z, rows.signs(z));
    }
  }

  void add_cell(int x, int y, int z, size_t signs) {
    const CubeCase& cube = cube_cases_[signs];
    const size_t first = slot(x, y, z, 0);
    for (size_t i = 0; i < 3 * size_t{cube.triangles}; ++i) {
      const size_t edge = cube.edges[i];
      uint32_t& vertex = slots_[first + slot_offsets_[edge]];
      if (vertex == no_vertex) vertex = add_vertex(x, y, z, edge);
      mesh_.indices.push_back(vertex);
    }
  }

  uint32_t add_vertex(int x, int y, int z, size_t edge) {
    const int from = cell_tables_.edges[edge].from, axis = static_cast<int>(edge) / 4;
    const std::array<int, 3> at{x + (from >> 2), y + ((from >> 1) & 1), z + (from & 1)};
    const VoxelCoord p{owned_.lo.x + at[0], owned_.lo.y + at[1], owned_.lo.z + at[2]};
    const Code next = axis == 0   ? window_.at(p.x + 1, p.y, p.z)
                      : axis == 1 ? window_.at(p.x, p.y + 1, p.z)
                                  : window_.at(p.x, p.y, p.z + 1);
    const int along = crossing_steps(window_.at(p.x, p.y, p.z), next);
    PlacedVertex vertex;
    vertex.cell = static_cast<int32_t>(window_.index(p.x, p.y, p.z));
    for (size_t i = 0; i < 3; ++i) vertex.position[i] = static_cast<uint16_t>(at[i] * surface_steps);
    vertex.position[static_cast<size_t>(axis)] =
        static_cast<uint16_t>(at[static_cast<size_t>(axis)] * surface_steps + along);
    vertex.fraction[axis] = static_cast<float>(along) / surface_steps_per_voxel;
    vertices_.push_back(vertex);
    return static_cast<uint32_t>(vertices_.size() - 1);
  }

  const Window& window_;
  const Window* before_;
  const CellMask* mask_;
  const CellTables& cell_tables_ = cell_tables();
  const std::array<CubeCase, 256>& cube_cases_ = cube_cases();
  VoxelBox owned_;
  VoxelCoord cells_;
  std::vector<uint64_t> rows_;   ///< of signs, y fastest
  std::vector<uint32_t> slots_;  ///< vertices of the edges, by slot()
  std::array<size_t, cell_edges> slot_offsets_{};
  std::vector<PlacedVertex> vertices_;
  SurfaceMesh mesh_;
};

class LeafFiller {
 public:
  explicit LeafFiller(const LeafGrid& grid) : grid_(grid) {}

  void add(const Leaf& leaf) {
    for (const std::vector<LeafEdge>& cycle : cycles_of(grid_, leaf)) {
      // Two halves of an edge whose middle alone differs: nothing lies between them.
      if (cycle.size() < 3) continue;
      std::vector<uint32_t> vertices;
      for (const LeafEdge& edge : cycle) vertices.push_back(vertex_on(edge, leaf));
      if (vertices.size() == 3) {
        mesh_.indices.insert(mesh_.indices.end(), vertices.begin(), vertices.end());
      } else {
        add_fan(leaf, vertices);
      }
    }
  }
  LeafMesh mesh() { return std::move(mesh_); }

 private:
  uint32_t vertex_on(const LeafEdge& edge, const Leaf& leaf) {
    const auto [found, is_new] = vertices_.try_emplace(edge, static_cast<uint32_t>(mesh_.points.size()));
    if (is_new) {
      std::array<int32_t, 3> steps{edge.from.x * surface_steps, edge.from.y * surface_steps,
                                   edge.from.z * surface_steps};
      steps[static_cast<size_t>(edge.axis)] +=
          crossing_steps(grid_.distance_at(edge.from), grid_.distance_at(edge.to())) * edge.length;
      mesh_.points.push_back({edge.length == leaf.side ? leaf : Leaf{edge.from, edge.length}, steps});
    }
    return found->second;
  }

  /// Around a point strictly inside the leaf: no side of the triangles is anyone else's.
  void add_fan(const Leaf& leaf, const std::vector<uint32_t>& around) {
    std::array<int64_t, 3> sum{};
    for (const uint32_t vertex : around)
      for (size_t i = 0; i < 3; ++i) sum[i] += mesh_.points[vertex].steps[i];
    const std::array<int, 3> low{leaf.at.x, leaf.at.y, leaf.at.z};
    LeafPoint middle{leaf, {}};
    for (size_t i = 0; i < 3; ++i) {
      const int lowest = low[i] * surface_steps;
      const auto mean = static_cast<int>(sum[i] / static_cast<int64_t>(around.size()));
      middle.steps[i] = std::clamp(mean, lowest + 1, lowest + leaf.side * surface_steps - 1);
    }
    const auto centre = static_cast<uint32_t>(mesh_.points.size());
    mesh_.points.push_back(middle);
    for (size_t i = 0; i < around.size(); ++i)
      mesh_.indices.insert(mesh_.indices.end(), {centre, around[i], around[(i + 1) % around.size()]});
  }

  const LeafGrid& grid_;
  LeafMesh mesh_;
  std::map<LeafEdge, uint32_t> vertices_;
};

}  // namespace

SurfaceMesh marching_cubes(const Window& window, const VoxelBox& owned, const Window* before,
                           const CellMask* mask) {
  const VoxelBox needed = owned.grown(surface_nets_apron);
  const VoxelCoord size = owned.size();
  CHECK(!owned.empty() && window.box.covers(needed));
  CHECK(size.z <= marching_cubes_side_max && std::max(size.x, size.y) <= surface_side_max);
  CHECK(before == nullptr || before->box == window.box);
  CHECK(mask == nullptr || mask->cells().covers(owned));
  return CubesBuilder(window, owned, before, mask).build();
}

LeafMesh leaf_cubes(const LeafGrid& grid, std::span<const Leaf> leaves) {
  LeafFiller filler(grid);
  for (const Leaf& leaf : leaves) filler.add(leaf);
  return filler.mesh();
}

}  // namespace scree
