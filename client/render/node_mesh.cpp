#include "client/render/node_mesh.h"

#include <algorithm>
#include <cmath>

#include "shared/field/leaf_surface.h"
#include "shared/field/sharp_vertex.h"
#include "shared/field/surface_vertices.h"

namespace scree {
namespace {

/// Cells known around a node's own: a leaf beside it, and what that leaf is divided by.
constexpr int known_around = 2;

VoxelCoord scaled(VoxelCoord v, int by) {
  return {v.x * by, v.y * by, v.z * by};
}

template <typename F>
void for_each_cell(const VoxelBox& box, F&& f) {
  for (int x = box.lo.x; x < box.hi.x; ++x)
    for (int y = box.lo.y; y < box.hi.y; ++y)
      for (int z = box.lo.z; z < box.hi.z; ++z) f(VoxelCoord{x, y, z});
}

/// −1, 0 or 1 along each axis: at which neighbour's place the cell lies.
BlockCoord place_of(VoxelCoord cell, const VoxelBox& node) {
  const auto place = [](int v, int lo, int hi) { return v < lo ? -1 : (v < hi ? 0 : 1); };
  return {place(cell.x, node.lo.x, node.hi.x), place(cell.y, node.lo.y, node.hi.y),
          place(cell.z, node.lo.z, node.hi.z)};
}

Neighbour neighbour_at(const Neighbours& around, BlockCoord place) {
  return around[static_cast<size_t>((place.x + 1) * 9 + (place.y + 1) * 3 + place.z + 1)];
}

/// Vertices where they belong, and polygons with the right node.
class NodeRules final : public LeafRules {
 public:
  /// `own` and `unit` are windows at the node's level and in the grid's units; alike where those are the
  /// same.
  NodeRules(const NodeJob& job, const VoxelBox& node, int own_side, const Window& own, const Window& unit)
      : job_(job), node_(node), own_side_(own_side), own_(own), unit_(unit) {}

  bool owns(std::span<const Leaf> around) const override {
    BlockCoord last{-1, -1, -1};
    bool any = false;
    for (const Leaf& leaf : around) {
      const BlockCoord place = place_of(leaf.at, node_);
      if (leaf.side != own_side_ || neighbour_at(job_.around, place) != Neighbour::same) continue;
      last = any ? std::max(last, place) : place;
      any = true;
    }
    return any && last == BlockCoord{};
  }

  glm::vec3 place(const Leaf& leaf, std::span<const LeafCrossing> crossings) const override {
    if (job_.polygoniser == Polygoniser::nets) return mean_of(crossings);
    // By the samples of its own level: whoever asks, the answer is the same.
    if (leaf.side == 1) return sharp_vertex(unit_, leaf.at, crossings);
    return sharp_vertex(own_, {leaf.at.x / 2, leaf.at.y / 2, leaf.at.z / 2}, crossings);
  }

 private:
  const NodeJob& job_;
  VoxelBox node_;
  int own_side_;
  const Window& own_;
  const Window& unit_;
};

float code_at(const std::optional<BlockWindows>& windows, bool is_rock, VoxelCoord p) {
  if (!windows) return is_rock ? code_solid : code_air;
  return windows->now.at(p.x, p.y, p.z);
}

/// Whether a finer node touches the point.
bool is_at_finer(const Neighbours& around, const VoxelBox& node, VoxelCoord p) {
  bool finer = false;
  for (int i = 0; i < 8; ++i) {
    const VoxelCoord cell = p - VoxelCoord{i >> 2, (i >> 1) & 1, i & 1};
    finer = finer || neighbour_at(around, place_of(cell, node)) == Neighbour::finer;
  }
  return finer;
}

/// In units of the finest level that touches the node.
LeafGrid grid_of(const NodeJob& job, const VoxelBox& node, int unit) {
  LeafGrid grid(node.grown(known_around * unit));
  for_each_cell(grid.cells, [&](VoxelCoord cell) {
    const Neighbour kind = neighbour_at(job.around, place_of(cell, node));
    grid.side_at(cell) =
        kind == Neighbour::beyond ? leaf_unknown : static_cast<uint8_t>(kind == Neighbour::finer ? 1 : unit);
  });
  const VoxelBox points{grid.cells.lo, grid.cells.hi + VoxelCoord{1, 1, 1}};
  for_each_cell(points, [&](VoxelCoord p) {
    const bool inside = node.grown(-1).holds(p);
    if (unit == 2 && !inside && is_at_finer(job.around, node, p)) {
      grid.distance_at(p) = code_at(job.finer, job.finer_is_rock, p);
    } else if (unit == 1 || ((p.x | p.y | p.z) & 1) == 0) {
      // The same distance is fewer of the larger units.
      const VoxelCoord at{p.x / unit, p.y / unit, p.z / unit};
      grid.distance_at(p) = static_cast<float>(unit) * code_at(job.own, job.own_is_rock, at);
    }
  });
  return grid;
}

std::vector<Leaf> leaves_of(const LeafGrid& grid, const VoxelBox& node) {
  std::vector<Leaf> leaves;
  for_each_cell(node, [&](VoxelCoord cell) {
    if (const Leaf leaf = grid.leaf_at(cell); leaf.at == cell) leaves.push_back(leaf);
  });
  return leaves;
}

/// Placed and shaded by a window in the grid's units.
SurfaceMesh shaded(const LeafMesh& leaves, const VoxelBox& cells, const BlockWindows& windows) {
  SurfaceMesh mesh;
  mesh.origin = cells.lo;
  mesh.indices = leaves.indices;
  constexpr auto steps = static_cast<int>(surface_steps_per_voxel);
  std::vector<PlacedSeed> seeds;
  seeds.reserve(leaves.points.size());
  for (const LeafPoint& point : leaves.points) {
    PlacedSeed seed;
    std::array<int, 3> cell{};
    const std::array<int, 3> lo{cells.lo.x, cells.lo.y, cells.lo.z};
    for (size_t i = 0; i < 3; ++i) {
      cell[i] = point.steps[i] >> 8;
      seed.fraction[static_cast<int>(i)] =
          static_cast<float>(point.steps[i] - cell[i] * steps) / surface_steps_per_voxel;
      seed.position[i] = static_cast<uint16_t>(point.steps[i] - lo[i] * steps);
    }
    seed.cell = static_cast<int32_t>(windows.now.index(cell[0], cell[1], cell[2]));
    seeds.push_back(seed);
  }
  add_placed_vertices(windows.now, windows.before ? &*windows.before : nullptr, seeds, mesh.vertices);
  windows.put_paint_on(mesh);
  return mesh;
}
static_assert(surface_steps_per_voxel == 256.0F);

/// A window where the field has nothing but air or rock.
BlockWindows plain_windows(const VoxelBox& owned, bool is_rock) {
  return {owned, Window(owned.grown(surface_nets_apron), is_rock ? code_solid : code_air), std::nullopt, {}};
}

bool has_finer(const Neighbours& around) {
  return std::ranges::find(around, Neighbour::finer) != around.end();
}

}  // namespace

VoxelBox samples_of(const SurfaceNode& node) {
  const VoxelCoord lo{node.at.x * block_size, node.at.y * block_size, node.at.z * block_size};
  return {lo, lo + VoxelCoord{block_size, block_size, block_size}};
}

std::optional<NodeJob> gather_node(SurfaceLevels& levels, Field& field, const SurfaceNode& node,
                                   const Neighbours& around, Polygoniser polygoniser) {
  NodeJob job{node, around, polygoniser, {}, {}, false, false};
  const VoxelBox box = samples_of(node);
  const auto is_rock = [&](int level, VoxelCoord p) { return levels.is_rock(field, level, p); };
  job.own = levels.gather(field, node.level, box);
  if (!job.own) job.own_is_rock = is_rock(node.level, box.lo);
  if (has_finer(around)) {
    // More than the apron: leaves that lie known_around the node are shaded, too.
    const VoxelBox fine{scaled(box.lo, 2), scaled(box.hi, 2)};
    job.finer = levels.gather(field, node.level - 1, fine.grown(known_around));
    if (!job.finer) job.finer_is_rock = is_rock(node.level - 1, fine.lo);
    if (!job.own && !job.finer && job.own_is_rock == job.finer_is_rock) return std::nullopt;
    return job;
  }
  if (!job.own) return std::nullopt;
  return job;
}

NodeMesh mesh_node(const NodeJob& job) {
  const bool finer = has_finer(job.around);
  if (job.polygoniser == Polygoniser::nets && is_uniform(job.around))
    return {job.node, job.node.level, job.own->mesh()};
  const int unit = finer ? 2 : 1;
  const VoxelBox own = samples_of(job.node);
  const VoxelBox node{scaled(own.lo, unit), scaled(own.hi, unit)};
  const std::optional<BlockWindows>& windows = finer ? job.finer : job.own;
  const BlockWindows& shading =
      windows ? *windows
              : plain_windows(node.grown(known_around), finer ? job.finer_is_rock : job.own_is_rock);
  const LeafGrid grid = grid_of(job, node, unit);
  const BlockWindows& coarse = job.own ? *job.own : plain_windows(own, job.own_is_rock);
  const NodeRules rules(job, node, unit, coarse.now, shading.now);
  const LeafMesh leaves = leaf_surface(grid, leaves_of(grid, node), rules);
  NodeMesh done{job.node, job.node.level - (finer ? 1 : 0), {}};
  if (!leaves.indices.empty()) done.mesh = shaded(leaves, grid.cells, shading);
  return done;
}

}  // namespace scree
