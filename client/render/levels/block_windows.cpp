#include "client/render/levels/block_windows.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <utility>

#include "shared/field/material.h"
#include "shared/surface/marching_cubes.h"

namespace scree {
namespace {

/// Of the field as generated: from here on, looks are those of a cut (shaders/bricks.glsl).
constexpr Code cut_begins = -10;

/// Calls f(coordinate, index in the chunk) for each brick of the chunk that the box touches.
template <typename F>
void for_each_brick_in(ChunkCoord chunk, const VoxelBox& box, F&& f) {
  const VoxelCoord first = first_voxel(chunk);
  const VoxelBox part{{std::max(box.lo.x, first.x), std::max(box.lo.y, first.y), std::max(box.lo.z, first.z)},
                      {std::min(box.hi.x, first.x + chunk_size), std::min(box.hi.y, first.y + chunk_size),
                       std::min(box.hi.z, first.z + chunk_size)}};
  for_each_brick(part, [&](BrickCoord coord) { f(coord, index_in_chunk(coord)); });
}

bool is_bit(uint64_t bits, int index) {
  return ((bits >> index) & 1U) != 0;
}

/// The common properties of a box's bricks.
struct Survey {
  bool air = true;
  bool rock = true;
  bool edited = false;
  std::map<BrickCoord, Material> paint;
};

Survey survey(Field& field, const VoxelBox& box) {
  Survey seen;
  for_each_chunk(box, [&](ChunkCoord chunk) {
    const Field::ChunkBricks bricks = field.chunk_bricks(chunk);
    for_each_brick_in(chunk, box, [&](BrickCoord coord, int index) {
      const bool edited = is_bit(bricks.edited, index);
      const Brick* brick = edited ? &field.brick(coord) : bricks.generated.bricks[static_cast<size_t>(index)];
      seen.air = seen.air && brick == &air_brick();
      seen.rock = seen.rock && brick == &solid_brick();
      seen.edited = seen.edited || edited;
      if (const auto painted = edited ? field.painted(coord) : std::nullopt) seen.paint[coord] = *painted;
    });
  });
  return seen;
}

/// The brick's part of the window.
void copy_brick(BrickCoord coord, const Brick& brick, Window& window) {
  const VoxelBox& box = window.box;
  const VoxelCoord first = first_voxel(coord);
  const VoxelCoord lo{std::max(first.x, box.lo.x), std::max(first.y, box.lo.y), std::max(first.z, box.lo.z)};
  const VoxelCoord hi{std::min(first.x + brick_size, box.hi.x), std::min(first.y + brick_size, box.hi.y),
                      std::min(first.z + brick_size, box.hi.z)};
  const auto count = static_cast<size_t>(hi.z - lo.z);
  const auto stride = static_cast<size_t>(box.size().z);
  for (int x = lo.x; x < hi.x; ++x) {
    const Code* from =
        &brick.codes[static_cast<size_t>(Brick::index(x - first.x, lo.y - first.y, lo.z - first.z))];
    Code* to = &window.at(x, lo.y, lo.z);
    for (int y = lo.y; y < hi.y; ++y, from += brick_size, to += stride) {
      if (count == brick_size) {
        std::memcpy(to, from, brick_size);
      } else {
        std::memcpy(to, from, count);
      }
    }
  }
}

}  // namespace

SurfaceMesh BlockWindows::mesh(const CellMask* mask, const SheetPlace* place) const {
  const Window* then = before ? &*before : nullptr;
  SurfaceMesh made = place == nullptr ? surface_nets(now, owned, then, mask)
                                      : surface_nets_placed(now, owned, then, mask, *place);
  put_paint_on(made);
  return made;
}

SurfaceMesh BlockWindows::mesh_by_cubes(const CellMask* mask) const {
  SurfaceMesh made = marching_cubes(now, owned, before ? &*before : nullptr, mask);
  put_paint_on(made);
  return made;
}

uint8_t BlockWindows::layer_in_cut(const SurfaceMesh& mesh, const SurfaceVertex& vertex) const {
  const glm::vec3 origin(mesh.origin.x, mesh.origin.y, mesh.origin.z);
  const glm::vec3 steps(vertex.position[0], vertex.position[1], vertex.position[2]);
  const glm::vec3 p = origin + steps / surface_steps_per_voxel;
  const MaterialHeights layers = layers_of(source);
  const float height_m = p.y * source.voxel_size_m;
  const bool soil = height_m < layers.soil_below_m;
  if (!soil && height_m <= layers.ice_above_m) return 0;
  // Mostly the window shows that the ground's surface is farther above than the layer's depth.
  const float end =
      p.y + traits_of(soil ? Material::soil : Material::ice).layer_depth_m / source.voxel_size_m;
  const VoxelCoord above{floor_to_int(p.x), std::min(floor_to_int(end) + 1, before->box.hi.y - 1),
                         floor_to_int(p.z)};
  if (before->box.holds(above) &&
      static_cast<float>(above.y) - decode(before->at(above.x, above.y, above.z)) > end + 1.0F)
    return 0;
  return layer_number(material_at(source, p * source.voxel_size_m));
}

void BlockWindows::put_paint_on(SurfaceMesh& mesh) const {
  if (!before) return;  // nothing was edited here
  constexpr int steps = surface_steps;
  // One sample for two voxels along a side, in a block of usual size.
  constexpr int looks = 10;
  std::array<uint8_t, looks * looks * looks> looked{};  // 1 + the layer's number
  for (SurfaceVertex& vertex : mesh.vertices) {
    if (vertex.before < cut_begins) {
      const int x = vertex.position[0] / (2 * steps), y = vertex.position[1] / (2 * steps),
                z = vertex.position[2] / (2 * steps);
      uint8_t own = 0;
      uint8_t& known =
          std::max({x, y, z}) < looks ? looked[static_cast<size_t>((x * looks + y) * looks + z)] : own;
      if (known == 0) known = static_cast<uint8_t>(1 + layer_in_cut(mesh, vertex));
      vertex.paint = static_cast<uint8_t>(known - 1);
    }
    if (paint.empty()) continue;
    const auto nearest = [&](size_t axis) { return (vertex.position[axis] + steps / 2) / steps; };
    const auto found = paint.find(brick_of(mesh.origin + VoxelCoord{nearest(0), nearest(1), nearest(2)}));
    if (found != paint.end()) vertex.paint = paint_number(found->second);
  }
}

uint8_t paint_number(const Field& field, const Volume& piece) {
  const glm::vec3 centre = piece.centre_voxels + 0.5F;
  const BrickCoord birthplace =
      brick_of(VoxelCoord{floor_to_int(centre.x), floor_to_int(centre.y), floor_to_int(centre.z)});
  return field.painted(birthplace) ? paint_number(piece.material) : layer_number(piece.material);
}

std::optional<BlockWindows> gather_windows(Field& field, const VoxelBox& owned) {
  const VoxelBox box = owned.grown(surface_nets_apron);
  Survey seen = survey(field, box);
  if (seen.air || seen.rock) return std::nullopt;
  BlockWindows windows{owned, Window(box), std::nullopt, std::move(seen.paint), field.source()};
  if (seen.edited) windows.before.emplace(box);
  for_each_chunk(box, [&](ChunkCoord chunk) {
    const Field::ChunkBricks bricks = field.chunk_bricks(chunk);
    for_each_brick_in(chunk, box, [&](BrickCoord coord, int index) {
      const Brick& generated = *bricks.generated.bricks[static_cast<size_t>(index)];
      copy_brick(coord, is_bit(bricks.edited, index) ? field.brick(coord) : generated, windows.now);
      if (windows.before) copy_brick(coord, generated, *windows.before);
    });
  });
  return windows;
}

Window gather_generated(Field& field, const VoxelBox& box) {
  Window window(box);
  for_each_brick(box, [&](BrickCoord coord) { copy_brick(coord, field.generated_brick(coord), window); });
  return window;
}

}  // namespace scree
