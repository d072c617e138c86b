#include "client/render/meshing/node_mesh.h"

#include <algorithm>
#include <memory>
#include <utility>

#include "client/render/levels/surface_looks.h"
#include "shared/surface/creases.h"
#include "shared/surface/dual_vertex.h"
#include "shared/surface/leaf_surface.h"
#include "shared/surface/marching_cubes.h"
#include "shared/surface/surface_vertices.h"

namespace scree {
namespace {

/// Cells of the finer level known around a node's own: a leaf beside it, and the leaves that divide it.
constexpr int known_around = 4;
/// Sides of the node's own leaves, in cells of the finer level.
constexpr int own_side = 2;

VoxelCoord scaled(VoxelCoord v, int by) {
  return {v.x * by, v.y * by, v.z * by};
}

VoxelBox scaled(const VoxelBox& box, int by) {
  return {scaled(box.lo, by), scaled(box.hi, by)};
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

/// Calls f(kind, box) for the node and the 26 places around it, each as far as that many cells.
template <typename F>
void for_each_place(const Neighbours& around, const VoxelBox& node, int cells, F&& f) {
  const std::array<VoxelCoord, 4> at{node.grown(cells).lo, node.lo, node.hi, node.grown(cells).hi};
  for (size_t i = 0; i < 27; ++i) {
    const size_t x = i / 9, y = i / 3 % 3, z = i % 3;
    f(around[i], VoxelBox{{at[x].x, at[y].y, at[z].z}, {at[x + 1].x, at[y + 1].y, at[z + 1].z}});
  }
}

bool has_finer(const Neighbours& around) {
  return std::ranges::find(around, Neighbour::finer) != around.end();
}

/// Cells of the node's level that no finer node touches: surface nets' and marching cubes' own. All others
/// are leaf_surface's or leaf_cubes'.
CellMask plain_cells(const NodeJob& job) {
  const VoxelBox own = samples_of(job.node);
  CellMask mask({own.lo - VoxelCoord{2, 2, 2}, own.hi + VoxelCoord{1, 1, 1}});
  for_each_place(job.around, own, 2, [&](Neighbour kind, const VoxelBox& box) {
    if (kind != Neighbour::same) mask.remove(kind == Neighbour::finer ? box.grown(1) : box);
  });
  return mask;
}

/// Vertices where they belong, and polygons with the right node.
class NodeRules final : public LeafRules {
 public:
  NodeRules(const NodeJob& job, const CellMask& plain, const SheetPlace& own_place,
            const SheetPlace& finer_place)
      : job_(job),
        plain_(plain),
        own_place_(own_place),
        finer_place_(finer_place),
        node_(scaled(samples_of(job.node), own_side)) {}

  /// Whether this node has the polygon: it is the last node of its level around it, and surface nets leave it
  /// out.
  bool owns(std::span<const Leaf> around) const override {
    BlockCoord last{-1, -1, -1};
    bool any = false;
    bool all_plain = true;
    for (const Leaf& leaf : around) {
      const BlockCoord place = place_of(leaf.at, node_);
      const bool is_own = leaf.side == own_side && neighbour_at(job_.around, place) == Neighbour::same;
      all_plain = all_plain && is_own && plain_.holds(own_cell(leaf));
      if (!is_own) continue;
      last = any ? std::max(last, place) : place;
      any = true;
    }
    return !all_plain && any && last == BlockCoord{};
  }

  /// The place by the samples of the leaf's own level: the same for every node that asks.
  glm::vec3 place(const Leaf& leaf, std::span<const LeafCrossing> crossings) const override {
    return leaf.side == 1 ? finer_place_(leaf.at, crossings) : own_place_(own_cell(leaf), crossings);
  }

 private:
  static VoxelCoord own_cell(const Leaf& leaf) {
    return {leaf.at.x / own_side, leaf.at.y / own_side, leaf.at.z / own_side};
  }

  const NodeJob& job_;
  const CellMask& plain_;
  const SheetPlace& own_place_;
  const SheetPlace& finer_place_;
  VoxelBox node_;
};

/// The box around the finer nodes on which polygons beside them depend: the leaves that they touch, two more
/// until surface nets take over, and one to distinguish the sheets of these.
VoxelBox border_box(const NodeJob& job) {
  constexpr int around = 5 * own_side;
  const VoxelBox node = scaled(samples_of(job.node), own_side);
  VoxelBox all{node.hi, node.lo};
  for_each_place(job.around, node, known_around, [&](Neighbour kind, const VoxelBox& box) {
    if (kind != Neighbour::finer) return;
    all.lo = {std::min(all.lo.x, box.lo.x), std::min(all.lo.y, box.lo.y), std::min(all.lo.z, box.lo.z)};
    all.hi = {std::max(all.hi.x, box.hi.x), std::max(all.hi.y, box.hi.y), std::max(all.hi.z, box.hi.z)};
  });
  return common(all.grown(around), node.grown(known_around));
}

/// Distances at the corners of the node's own leaves; each stands for the points between it and the next,
/// too.
void fill_own_distances(const Window& own, LeafGrid& grid) {
  const VoxelBox& cells = grid.cells;
  const auto count = static_cast<size_t>(cells.hi.z - cells.lo.z + 1);
  for (int x = cells.lo.x; x <= cells.hi.x; ++x)
    for (int y = cells.lo.y; y <= cells.hi.y; ++y) {
      float* to = &grid.distance_at({x, y, cells.lo.z});
      if ((x & 1) != 0 || (y & 1) != 0) {
        std::copy_n(&grid.distance_at({x & ~1, y & ~1, cells.lo.z}), count, to);
        continue;
      }
      const Code* from = &own.codes[own.index(x / own_side, y / own_side, cells.lo.z / own_side)];
      for (size_t i = 0; i < count; ++i) to[i] = static_cast<float>(own_side * from[i / own_side]);
    }
}
static_assert(own_side == 2);

/// In cells of the finer level, distances in its codes.
LeafGrid grid_of(const NodeJob& job, const Window& own, const Window& finer) {
  const VoxelBox node = scaled(samples_of(job.node), own_side);
  LeafGrid grid(border_box(job));
  fill_own_distances(own, grid);
  for_each_place(job.around, node, known_around, [&](Neighbour kind, const VoxelBox& place) {
    const VoxelBox box = common(place, grid.cells);
    if (box.empty()) return;
    const uint8_t side = kind == Neighbour::beyond ? leaf_unknown : (kind == Neighbour::finer ? 1 : own_side);
    for (int x = box.lo.x; x < box.hi.x; ++x)
      for (int y = box.lo.y; y < box.hi.y; ++y)
        std::fill_n(&grid.side_at({x, y, box.lo.z}), box.hi.z - box.lo.z, side);
  });
  for_each_place(job.around, node, known_around, [&](Neighbour kind, const VoxelBox& box) {
    if (kind != Neighbour::finer) return;
    // Points that finer nodes touch have the samples of those.
    for (int x = box.lo.x; x <= box.hi.x; ++x)
      for (int y = box.lo.y; y <= box.hi.y; ++y)
        std::copy_n(&finer.codes[finer.index(x, y, box.lo.z)], box.hi.z - box.lo.z + 1,
                    &grid.distance_at({x, y, box.lo.z}));
  });
  return grid;
}

/// The node's leaves beside which polygons may be other than surface nets'.
std::vector<Leaf> border_leaves(const NodeJob& job) {
  const VoxelBox own = samples_of(job.node);
  CellMask inner(own);
  for_each_place(job.around, own, 1, [&](Neighbour kind, const VoxelBox& box) {
    if (kind == Neighbour::finer) inner.remove(box.grown(2));
  });
  std::vector<Leaf> leaves;
  for (int x = own.lo.x; x < own.hi.x; ++x)
    for (int y = own.lo.y; y < own.hi.y; ++y)
      for (int z = own.lo.z; z < own.hi.z; ++z)
        if (!inner.holds({x, y, z})) leaves.push_back({scaled(VoxelCoord{x, y, z}, own_side), own_side});
  return leaves;
}

/// The node's leaves that finer nodes touch.
std::vector<Leaf> touched_leaves(const NodeJob& job, const CellMask& plain) {
  const VoxelBox own = samples_of(job.node);
  std::vector<Leaf> leaves;
  for (int x = own.lo.x; x < own.hi.x; ++x)
    for (int y = own.lo.y; y < own.hi.y; ++y)
      for (int z = own.lo.z; z < own.hi.z; ++z)
        if (!plain.holds({x, y, z})) leaves.push_back({scaled(VoxelCoord{x, y, z}, own_side), own_side});
  return leaves;
}

/// The points whose place the samples of the node's own level tell.
std::vector<bool> coarse_points(const LeafMesh& leaves) {
  std::vector<bool> coarse;
  for (const LeafPoint& point : leaves.points) coarse.push_back(point.leaf.side == own_side);
  return coarse;
}

/// The looks of coarse points by the node's own samples, as meshes have them that know no others.
void set_coarse_looks(const LeafMesh& leaves, const std::vector<bool>& coarse, const BlockWindows& own,
                      SurfaceMesh& mesh) {
  SurfaceMesh points{own.now.box.lo, {}, {}, {}};
  const std::array<int, 3> lo{points.origin.x, points.origin.y, points.origin.z};
  for (size_t p = 0; p < coarse.size(); ++p) {
    if (!coarse[p]) continue;
    SurfaceVertex& vertex = points.vertices.emplace_back();
    for (size_t i = 0; i < 3; ++i)
      vertex.position[i] =
          static_cast<uint16_t>(leaves.points[p].steps[i] / own_side - lo[i] * surface_steps);
  }
  own.set_looks(points);
  auto next = points.vertices.begin();
  for (size_t p = 0; p < coarse.size(); ++p)
    if (coarse[p]) mesh.vertices[p].look = (next++)->look;
}

void set_looks(const LeafMesh& leaves, const BlockWindows& own, const BlockWindows& finer,
               const std::vector<bool>& coarse, SurfaceMesh& mesh) {
  if (own.is_untouched() && finer.is_untouched()) return;
  finer.set_looks(mesh);
  finer.set_worn(mesh);
  if (own.looks.is_ground() && finer.looks.is_ground()) return;
  set_coarse_looks(leaves, coarse, own, mesh);
  part_looks(mesh, coarse);
}

FaceEdges edges_at(const NodeJob& job, int level) {
  return level == 0 ? job.edges : FaceEdges::rounded;
}

/// Placed and shaded by a window in the grid's units.
SurfaceMesh shaded(const LeafMesh& leaves, VoxelCoord origin, const BlockWindows& own,
                   const BlockWindows& windows, FaceEdges edges) {
  SurfaceMesh mesh;
  mesh.origin = origin;
  mesh.indices = leaves.indices;
  constexpr auto steps = surface_steps;
  std::vector<PlacedVertex> vertices;
  vertices.reserve(leaves.points.size());
  for (const LeafPoint& point : leaves.points) {
    PlacedVertex placed;
    std::array<int, 3> cell{};
    const std::array<int, 3> lo{origin.x, origin.y, origin.z};
    for (size_t i = 0; i < 3; ++i) {
      cell[i] = point.steps[i] >> 8;
      placed.fraction[static_cast<int>(i)] =
          static_cast<float>(point.steps[i] - cell[i] * steps) / surface_steps_per_voxel;
      placed.position[i] = static_cast<uint16_t>(point.steps[i] - lo[i] * steps);
    }
    placed.cell = static_cast<int32_t>(windows.now.index(cell[0], cell[1], cell[2]));
    vertices.push_back(placed);
  }
  add_placed_vertices(windows.now, windows.before ? &*windows.before : nullptr, vertices, mesh);
  const std::vector<bool> coarse = coarse_points(leaves);
  if (edges == FaceEdges::sharp) windows.sharpen(mesh, &coarse);
  set_looks(leaves, own, windows, coarse, mesh);
  return mesh;
}
static_assert(surface_steps_per_voxel == 256.0F);

/// A window where the field has nothing but air or rock.
BlockWindows plain_windows(const VoxelBox& owned, bool is_rock) {
  return {owned, Window(owned.grown(surface_nets_apron), is_rock ? code_solid : code_air), std::nullopt, {}};
}

SheetPlace place_by(Polygoniser polygoniser, const Window& window) {
  if (polygoniser == Polygoniser::nets)
    return [](VoxelCoord, std::span<const LeafCrossing> crossings) { return mean_of(crossings); };
  return [vertices = std::make_shared<DualVertices>(window)](VoxelCoord cell,
                                                             std::span<const LeafCrossing> crossings) {
    return vertices->place(cell, crossings);
  };
}

/// Appends a mesh of the next coarser level.
void append(const SurfaceMesh& coarser, SurfaceMesh& mesh) {
  const auto first = static_cast<uint32_t>(mesh.vertices.size());
  const VoxelCoord off = scaled(coarser.origin, own_side) - mesh.origin;
  constexpr auto steps = surface_steps;
  const std::array<int, 3> from{off.x * steps, off.y * steps, off.z * steps};
  for (SurfaceVertex vertex : coarser.vertices) {
    for (size_t i = 0; i < 3; ++i)
      vertex.position[i] = static_cast<uint16_t>(from[i] + own_side * vertex.position[i]);
    mesh.vertices.push_back(vertex);
  }
  for (const uint32_t index : coarser.indices) mesh.indices.push_back(first + index);
}

LeafMesh border_polygons(const NodeJob& job, const CellMask& plain, const Window& own, const Window& finer) {
  const LeafGrid grid = grid_of(job, own, finer);
  if (job.polygoniser == Polygoniser::cubes) return leaf_cubes(grid, touched_leaves(job, plain));
  const SheetPlace own_place = place_by(job.polygoniser, own);
  const SheetPlace finer_place = place_by(job.polygoniser, finer);
  const NodeRules rules(job, plain, own_place, finer_place);
  return leaf_surface(grid, border_leaves(job), rules);
}

/// The part that mesh_inside() leaves out, where finer nodes touch the node; in samples of those.
SurfaceMesh mesh_border(const NodeJob& job, const CellMask& plain) {
  const VoxelBox own = samples_of(job.node);
  const BlockWindows& coarse = job.own ? *job.own : plain_windows(own, job.own_is_rock);
  const BlockWindows& finer =
      job.finer ? *job.finer
                : plain_windows(scaled(own, own_side).grown(known_around - 2), job.finer_is_rock);
  const LeafMesh leaves = border_polygons(job, plain, coarse.now, finer.now);
  // Marching cubes has no vertices inside cells.
  const FaceEdges edges =
      job.polygoniser == Polygoniser::cubes ? FaceEdges::rounded : edges_at(job, job.node.level - 1);
  // Below all that mesh_inside makes of the node, too.
  const VoxelCoord origin = scaled(own, own_side).grown(known_around).lo;
  return leaves.indices.empty() ? SurfaceMesh{} : shaded(leaves, origin, coarse, finer, edges);
}

/// The mesh by the node's own samples.
SurfaceMesh mesh_inside(const NodeJob& job, const CellMask* plain) {
  if (!job.own) return {};
  if (job.polygoniser == Polygoniser::cubes) return job.own->mesh_by_cubes(plain);
  const SheetPlace place = place_by(job.polygoniser, job.own->now);
  return job.own->mesh(edges_at(job, job.node.level), plain,
                       job.polygoniser == Polygoniser::nets ? nullptr : &place);
}

}  // namespace

VoxelBox samples_of(const SurfaceNode& node) {
  const VoxelCoord lo{node.at.x * block_size, node.at.y * block_size, node.at.z * block_size};
  return {lo, lo + VoxelCoord{block_size, block_size, block_size}};
}

std::optional<NodeJob> gather_node(SurfaceLevels& levels, const Field& field, const SurfaceNode& node,
                                   const Neighbours& around, Polygoniser polygoniser, FaceEdges edges) {
  NodeJob job{node, around, polygoniser, edges, {}, {}, false, false};
  const VoxelBox box = samples_of(node);
  const auto is_rock = [&](int level, VoxelCoord p) { return levels.is_rock(field, level, p); };
  job.own = levels.gather(field, node.level, box);
  if (!job.own) job.own_is_rock = is_rock(node.level, box.lo);
  if (has_finer(around)) {
    // More than the apron: leaves that lie about the node are shaded, too.
    const VoxelBox fine = scaled(box, own_side);
    job.finer = levels.gather(field, node.level - 1, fine.grown(known_around - 2));
    if (!job.finer) job.finer_is_rock = is_rock(node.level - 1, fine.lo);
    if (!job.own && !job.finer && job.own_is_rock == job.finer_is_rock) return std::nullopt;
    return job;
  }
  if (!job.own) return std::nullopt;
  return job;
}

NodeMesh mesh_node(const NodeJob& job) {
  if (is_uniform(job.around)) return {job.node, job.node.level, mesh_inside(job, nullptr)};
  const CellMask plain = plain_cells(job);
  SurfaceMesh inside = mesh_inside(job, &plain);
  if (!has_finer(job.around)) return {job.node, job.node.level, std::move(inside)};
  NodeMesh done{job.node, job.node.level - 1, mesh_border(job, plain)};
  if (done.mesh.empty()) return {job.node, job.node.level, std::move(inside)};
  append(inside, done.mesh);
  return done;
}

}  // namespace scree
