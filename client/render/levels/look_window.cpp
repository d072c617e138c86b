#include "client/render/levels/look_window.h"

#include <algorithm>
#include <array>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "shared/field/voxel_vector.h"

namespace scree {
namespace {

/// Writes looks into a window, which stays empty as long as all look as the ground does.
class Looks {
 public:
  Looks(const VoxelBox& box, Material bulk) : bulk_(said(bulk)) { looks_.box = box; }

  uint8_t look_of(VoxelMaterial voxel) const { return voxel == bulk_ ? ground_own : voxel; }

  void set(VoxelCoord voxel, Look look) {
    if (looks_.each.empty() && look == Look{}) return;
    if (looks_.each.empty()) looks_.each.resize(Window::count(looks_.box));
    looks_.each[index(voxel)] = look;
  }
  /// What a cut lays bare where the voxel says nothing.
  void set_bare(VoxelCoord voxel, uint8_t bare) {
    if (bare == 0) return;
    if (!looks_.each.empty() && looks_.each[index(voxel)].shown != 0) return;
    set(voxel, {0, bare});
  }
  LookWindow&& take() { return std::move(looks_); }

 private:
  size_t index(VoxelCoord v) const {
    const VoxelCoord size = looks_.box.size(), off = v - looks_.box.lo;
    return (static_cast<size_t>(off.x) * static_cast<size_t>(size.y) + static_cast<size_t>(off.y)) *
               static_cast<size_t>(size.z) +
           static_cast<size_t>(off.z);
  }

  VoxelMaterial bulk_;
  LookWindow looks_;
};

VoxelBox box_of(BrickCoord brick) {
  const VoxelCoord first = first_voxel(brick);
  return {first, first + VoxelCoord{brick_size, brick_size, brick_size}};
}

template <typename F>
void for_each_voxel(const VoxelBox& box, F&& f) {
  for (int x = box.lo.x; x < box.hi.x; ++x)
    for (int y = box.lo.y; y < box.hi.y; ++y)
      for (int z = box.lo.z; z < box.hi.z; ++z) f(VoxelCoord{x, y, z});
}

int index_in_brick(VoxelCoord v) {
  return Brick::index(v.x & (brick_size - 1), v.y & (brick_size - 1), v.z & (brick_size - 1));
}

/// What a ground of stored chunks says of materials there; its layers are no part of it. Or null.
std::shared_ptr<const PackedChunkMaterials> stored_materials(const TerrainSource& source, ChunkCoord chunk) {
  if (source.heights == nullptr || !source.heights->bricks()) return nullptr;
  const auto stored = stored_chunk(source, chunk).chunk;
  return stored == nullptr ? nullptr : stored->stored_materials;
}

void add_stored(const Field& ground, const VoxelBox& box, Looks& looks) {
  for_each_chunk(box, [&](ChunkCoord chunk) {
    const auto stored = stored_materials(ground.source(), chunk);
    if (stored == nullptr) return;
    for (int i = 0; i < static_cast<int>(chunk_brick_count); ++i) {
      const BrickMaterials& materials = stored->at(i);
      if (materials.is_ground()) continue;
      for_each_voxel(common(box_of(brick_in_chunk(chunk, i)), box), [&](VoxelCoord v) {
        const uint8_t look = looks.look_of(materials.at(index_in_brick(v)));
        looks.set(v, {look, look});
      });
    }
  });
}

/// The samples of an edited brick, `home`, that lie in `part`, a box of the level's.
void add_edited(const Field& field, const Field& ground, int level, BrickCoord home, const VoxelBox& part,
                Looks& looks) {
  const BrickMaterials materials = field.materials(home);
  const BrickMaterials own = ground.ground_materials(brick_of(part.lo));
  const bool bulk_alone = own.is_uniform() && looks.look_of(own.uniform()) == 0;
  if (materials.is_ground() && bulk_alone) return;
  for_each_voxel(part, [&](VoxelCoord v) {
    const VoxelCoord in{v.x << level, v.y << level, v.z << level};
    const VoxelMaterial voxel = materials.at(index_in_brick(in));
    if (voxel == ground_own) return looks.set_bare(v, looks.look_of(own.at(index_in_brick(v))));
    const uint8_t look = looks.look_of(voxel);
    looks.set(v, {look, look});
  });
}

void add_edits(const Field& field, const Field& ground, int level, const VoxelBox& box, Looks& looks) {
  const auto fine = [level](VoxelCoord v) { return VoxelCoord{v.x << level, v.y << level, v.z << level}; };
  // The first sample not below.
  const auto sample = [level](VoxelCoord v) {
    const int up = (1 << level) - 1;
    return VoxelCoord{(v.x + up) >> level, (v.y + up) >> level, (v.z + up) >> level};
  };
  const VoxelBox around{fine(box.lo), fine(box.hi)};
  for_each_chunk(around, [&](ChunkCoord chunk) {
    if (!field.has_edits(chunk)) return;
    for (const BrickCoord home : field.edited_bricks(chunk)) {
      const VoxelBox brick = box_of(home);
      const VoxelBox part = common({sample(brick.lo), sample(brick.hi)}, box);
      if (!part.empty()) add_edited(field, ground, level, home, part, looks);
    }
  });
}

/// Unit length: the way out of the rock at f, 0..1, in a cell.
glm::vec3 up_in(const Window& now, VoxelCoord cell, glm::vec3 f) {
  glm::vec3 slope(0.0F);
  for (int i = 0; i < 8; ++i) {
    const VoxelCoord bit{i >> 2, (i >> 1) & 1, i & 1};
    const VoxelCoord at = cell + bit;
    const auto code = static_cast<float>(now.at(at.x, at.y, at.z));
    const glm::vec3 part(bit.x != 0 ? f.x : 1.0F - f.x, bit.y != 0 ? f.y : 1.0F - f.y,
                         bit.z != 0 ? f.z : 1.0F - f.z);
    const glm::vec3 sign = 2.0F * as_vector(bit) - 1.0F;
    slope += code * sign * glm::vec3(part.y * part.z, part.x * part.z, part.x * part.y);
  }
  const float length = glm::length(slope);
  return length > 0.0F ? slope / length : glm::vec3(0.0F, 1.0F, 0.0F);
}

}  // namespace

Look LookWindow::at(VoxelCoord voxel) const {
  if (each.empty()) return {};
  CHECK_DEBUG(box.holds(voxel));
  const VoxelCoord size = box.size(), off = voxel - box.lo;
  return each[(static_cast<size_t>(off.x) * static_cast<size_t>(size.y) + static_cast<size_t>(off.y)) *
                  static_cast<size_t>(size.z) +
              static_cast<size_t>(off.z)];
}

VoxelCoord beneath(const Window& now, glm::vec3 p) {
  const auto along = [](float v, int lo, int hi) { return std::clamp(floor_to_int(v), lo, hi - 2); };
  const VoxelBox& box = now.box;
  const VoxelCoord cell{along(p.x, box.lo.x, box.hi.x), along(p.y, box.lo.y, box.hi.y),
                        along(p.z, box.lo.z, box.hi.z)};
  const glm::vec3 in_rock = p - 0.5F * up_in(now, cell, p - as_vector(cell));
  VoxelCoord nearest = cell;
  float least = 1e9F;
  for (int i = 0; i < 8; ++i) {
    const VoxelCoord corner = cell + VoxelCoord{i >> 2, (i >> 1) & 1, i & 1};
    const glm::vec3 off = as_vector(corner) - in_rock;
    // Solid ones before all others.
    const float far = glm::dot(off, off) + (now.at(corner.x, corner.y, corner.z) < 0 ? 0.0F : 100.0F);
    if (far >= least) continue;
    least = far;
    nearest = corner;
  }
  return nearest;
}

LookWindow gather_looks(const Field& field, const Field& ground, int level, const VoxelBox& box) {
  Looks looks(box, field.source().rows.bulk);
  add_stored(ground, box, looks);
  add_edits(field, ground, level, box, looks);
  return looks.take();
}

LookWindow looks_of(const Field& field, const Volume& piece) {
  const VoxelBox& box = piece.window.box;
  Looks looks(box, field.source().rows.bulk);
  if (piece.materials.is_uniform() && looks.look_of(said(piece.materials.all)) == 0) return looks.take();
  for_each_brick(box, [&](BrickCoord coord) {
    const BrickMaterials own = field.ground_materials(coord);
    const auto said_there = stored_materials(field.source(), chunk_of(coord));
    const bool stored = said_there != nullptr && !said_there->at(index_in_chunk(coord)).is_ground();
    for_each_voxel(common(box_of(coord), box), [&](VoxelCoord v) {
      const VoxelMaterial voxel = said(piece.materials.at(v));
      const uint8_t look = looks.look_of(voxel);
      const bool is_layer = !stored && voxel == own.at(index_in_brick(v));
      looks.set(v, {is_layer ? uint8_t{0} : look, look});
    });
  });
  return looks.take();
}

bool stores_materials(const Field& ground, const VoxelBox& box) {
  bool stores = false;
  for_each_chunk(
      box, [&](ChunkCoord chunk) { stores = stores || stored_materials(ground.source(), chunk) != nullptr; });
  return stores;
}

}  // namespace scree
