#include "client/render/levels/look_window.h"

#include <algorithm>
#include <array>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <utility>

#include "shared/base/vector_clones.h"
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
    looks_.each[looks_.index(voxel)] = look;
  }
  /// What a cut lays bare where the voxel says nothing.
  void set_bare(VoxelCoord voxel, uint8_t bare) {
    if (bare == 0) return;
    if (!looks_.each.empty() && looks_.each[looks_.index(voxel)].shown != 0) return;
    set(voxel, {0, bare});
  }
  LookWindow&& take() { return std::move(looks_); }

 private:
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

/// Voxels that all say the same, on ground that does.
void add_uniform(VoxelMaterial voxel, VoxelMaterial own, const VoxelBox& part, Looks& looks) {
  const uint8_t look = looks.look_of(voxel == ground_own ? own : voxel);
  for_each_voxel(part, [&](VoxelCoord v) {
    if (voxel == ground_own)
      looks.set_bare(v, look);
    else
      looks.set(v, {look, look});
  });
}

/// The samples of an edited brick, `home`, that lie in `part`, a box of the level's.
void add_edited(const Field& field, const Field& ground, int level, BrickCoord home, const VoxelBox& part,
                Looks& looks) {
  const BrickMaterials materials = field.materials(home);
  const BrickMaterials own = ground.ground_materials(brick_of(part.lo));
  const bool bulk_alone = own.is_uniform() && looks.look_of(own.uniform()) == 0;
  if (materials.is_ground() && bulk_alone) return;
  if (materials.is_uniform() && own.is_uniform())
    return add_uniform(materials.uniform(), own.uniform(), part, looks);
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

/// Decides between voxels that are equally near.
constexpr float half_way = 0.05F;

/// The surface has risen by an eighth of a voxel over a voxel that is this near to it.
constexpr int risen_codes = 5;
constexpr Code buried_code = -64;

/// The 26 places around a voxel: across its faces first, then its edges, then its corners.
constexpr std::array<VoxelCoord, 26> make_around_by_distance() {
  std::array<VoxelCoord, 26> places{};
  size_t count = 0;
  for (int apart = 1; apart <= 3; ++apart)
    for (int i = 0; i < 27; ++i) {
      const VoxelCoord off{i / 9 - 1, i / 3 % 3 - 1, i % 3 - 1};
      if (off.x * off.x + off.y * off.y + off.z * off.z == apart) places[count++] = off;
    }
  return places;
}
constexpr std::array<VoxelCoord, 26> around_by_distance = make_around_by_distance();

/// Whether the surface, near a voxel of rock, has risen there.
SCREE_INLINE bool is_risen(Code here, Code then) {
  return static_cast<bool>(static_cast<int>(here < 0) & static_cast<int>(here >= buried_code) &
                           static_cast<int>(then - here >= risen_codes));
}

/// Whether it has over one of these.
SCREE_VECTOR_CLONES bool has_risen(const Code* here, const Code* then, size_t count) {
  int found = 0;
  for (size_t i = 0; i < count; ++i) found |= static_cast<int>(is_risen(here[i], then[i]));
  return found != 0;
}

/// Steps in a window to the 26 places around a voxel, the nearest first.
std::array<std::ptrdiff_t, 26> steps_around(const Window& window) {
  const VoxelCoord size = window.box.size();
  std::array<std::ptrdiff_t, 26> steps{};
  for (size_t i = 0; i < steps.size(); ++i) {
    const VoxelCoord off = around_by_distance[i];
    steps[i] = (std::ptrdiff_t{off.x} * size.y + off.y) * size.z + off.z;
  }
  return steps;
}

/// The codes of a cell's corners.
using CellCodes = std::array<Code, 8>;

CellCodes codes_of_cell(const Window& now, VoxelCoord cell) {
  const VoxelCoord size = now.box.size();
  const std::ptrdiff_t step_y = size.z, step_x = step_y * size.y;
  const Code* const at = &now.codes[now.index(cell.x, cell.y, cell.z)];
  return {at[0],      at[1],          at[step_y],          at[step_y + 1],
          at[step_x], at[step_x + 1], at[step_x + step_y], at[step_x + step_y + 1]};
}

/// Unit length: the way out of the rock at f, 0..1, in a cell.
glm::vec3 up_in(const CellCodes& codes, glm::vec3 f) {
  const auto mix = [](float a, float b, float t) { return a + (b - a) * t; };
  const auto code = [&](size_t i) { return static_cast<float>(codes[i]); };
  // Along z on four edges, then along y, then along x.
  const float z0 = mix(code(0), code(1), f.z), z1 = mix(code(2), code(3), f.z);
  const float z2 = mix(code(4), code(5), f.z), z3 = mix(code(6), code(7), f.z);
  const float rise0 = mix(code(1) - code(0), code(3) - code(2), f.y);
  const float rise1 = mix(code(5) - code(4), code(7) - code(6), f.y);
  const glm::vec3 slope(mix(z2, z3, f.y) - mix(z0, z1, f.y), mix(z1 - z0, z3 - z2, f.x),
                        mix(rise0, rise1, f.x));
  const float length = glm::length(slope);
  return length > 0.0F ? slope / length : glm::vec3(0.0F, 1.0F, 0.0F);
}

/// The solid corner nearest to a point, in the cell.
size_t nearest_solid(const CellCodes& codes, glm::vec3 point) {
  const size_t round = (point.x > 0.5F ? 4U : 0U) | (point.y > 0.5F ? 2U : 0U) | (point.z > 0.5F ? 1U : 0U);
  if (codes[round] < 0) return round;
  size_t nearest = 0;
  float least = 1e9F;
  for (size_t i = 0; i < codes.size(); ++i) {
    if (codes[i] >= 0) continue;
    const glm::vec3 off = glm::vec3((i >> 2) & 1, (i >> 1) & 1, i & 1) - point;
    const float far = glm::dot(off, off);
    if (far >= least) continue;
    least = far;
    nearest = i;
  }
  return nearest;
}

}  // namespace

size_t LookWindow::index(VoxelCoord voxel) const {
  CHECK_DEBUG(box.holds(voxel));
  const VoxelCoord size = box.size(), off = voxel - box.lo;
  return (static_cast<size_t>(off.x) * static_cast<size_t>(size.y) + static_cast<size_t>(off.y)) *
             static_cast<size_t>(size.z) +
         static_cast<size_t>(off.z);
}

Look LookWindow::at(VoxelCoord voxel) const {
  return each.empty() ? Look{} : each[index(voxel)];
}

VoxelCoord beneath(const Window& now, glm::vec3 p) {
  const auto along = [](float v, int lo, int hi) { return std::clamp(floor_to_int(v), lo, hi - 2); };
  const VoxelBox& box = now.box;
  const VoxelCoord cell{along(p.x, box.lo.x, box.hi.x), along(p.y, box.lo.y, box.hi.y),
                        along(p.z, box.lo.z, box.hi.z)};
  const CellCodes codes = codes_of_cell(now, cell);
  const glm::vec3 in_cell = p - as_vector(cell);
  // On a flat face places lie half-way between voxels: all take the lower one.
  const size_t nearest = nearest_solid(codes, in_cell - 0.5F * up_in(codes, in_cell) - half_way);
  return cell + VoxelCoord{static_cast<int>(nearest >> 2), static_cast<int>((nearest >> 1) & 1),
                           static_cast<int>(nearest & 1)};
}

void spread_heaps(const Window& now, const Window& before, const VoxelBox& asked, LookWindow& looks) {
  if (looks.is_ground()) return;
  CHECK(looks.box.covers(asked.grown(1)));
  CHECK(now.box == looks.box && before.box == looks.box);
  const std::array<std::ptrdiff_t, 26> around = steps_around(now);
  const auto along = static_cast<size_t>(asked.hi.z - asked.lo.z);
  std::vector<std::pair<size_t, uint8_t>> spread;
  const auto is_heap = [&](size_t at) {
    return looks.each[at].shown != 0 && now.codes[at] < 0 && before.codes[at] >= 0;
  };
  // The nearest one's looks.
  const auto heap_beside = [&](size_t at) {
    for (const std::ptrdiff_t step : around) {
      const size_t other = at + static_cast<size_t>(step);
      if (is_heap(other)) return looks.each[other].shown;
    }
    return uint8_t{0};
  };
  for (int x = asked.lo.x; x < asked.hi.x; ++x)
    for (int y = asked.lo.y; y < asked.hi.y; ++y) {
      const size_t row = now.index(x, y, asked.lo.z);
      if (!has_risen(&now.codes[row], &before.codes[row], along)) continue;
      for (size_t at = row; at < row + along; ++at)
        if (is_risen(now.codes[at], before.codes[at]) && !is_heap(at))
          if (const uint8_t look = heap_beside(at)) spread.emplace_back(at, look);
    }
  for (const auto& [at, look] : spread) looks.each[at].shown = look;
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
