#include "client/render/levels/level_bricks.h"

#include <algorithm>
#include <cstdlib>
#include <optional>
#include <utility>
#include <vector>

#include "client/render/levels/air_distances.h"
#include "client/render/levels/block_windows.h"

namespace scree {
namespace {

/// Air farther from rock than this, in voxels, is empty: nearer air is kept for the distances beside the
/// surface that shadows and occlusion read.
constexpr float air_kept_voxels = 1.5F;

/// Beyond this code on either side, the looks do not change (client/shaders/bricks.glsl, worn_all).
constexpr Code code_far = 58;

VoxelBox samples_of(BrickCoord brick) {
  const VoxelCoord first = first_voxel(brick);
  const VoxelCoord lo = first - VoxelCoord{atlas_apron_low, atlas_apron_low, atlas_apron_low};
  return {lo, lo + VoxelCoord{atlas_brick_side, atlas_brick_side, atlas_brick_side}};
}

AtlasBrick as_brick(const Window& window) {
  AtlasBrick brick;
  std::ranges::copy(window.codes, brick.begin());
  return brick;
}

}  // namespace

TerrainSource spaced(TerrainSource source, int level) {
  source.voxel_size_m *= static_cast<float>(1 << level);
  return source;
}

void copy_edits(const Field& field, int level, Window& window, Code far_air) {
  const int step = 1 << level;
  const auto fine = [step](VoxelCoord v) { return VoxelCoord{v.x * step, v.y * step, v.z * step}; };
  // The first sample not below.
  const auto sample = [&](VoxelCoord v) {
    return VoxelCoord{(v.x + step - 1) >> level, (v.y + step - 1) >> level, (v.z + step - 1) >> level};
  };
  const float scale = 1.0F / static_cast<float>(step);
  for_each_chunk({fine(window.box.lo), fine(window.box.hi)}, [&](ChunkCoord chunk) {
    if (!field.has_edits(chunk)) return;
    for (const BrickCoord home : field.edited_bricks(chunk)) {
      const VoxelCoord first = first_voxel(home);
      const VoxelBox brick{first, first + VoxelCoord{brick_size, brick_size, brick_size}};
      const VoxelBox part = common({sample(brick.lo), sample(brick.hi)}, window.box);
      if (part.empty()) continue;
      const Brick& codes = field.brick(home);
      for (int x = part.lo.x; x < part.hi.x; ++x)
        for (int y = part.lo.y; y < part.hi.y; ++y)
          for (int z = part.lo.z; z < part.hi.z; ++z) {
            const VoxelCoord in = fine({x, y, z}) - first;
            const Code code = codes.codes[static_cast<size_t>(Brick::index(in.x, in.y, in.z))];
            window.at(x, y, z) = code == code_air ? far_air : encode(decode(code) * scale);
          }
    }
  });
}

LevelBrick::Kind kind_of(const AtlasBrick& brick) {
  constexpr int lo = atlas_apron_low;
  constexpr int hi = lo + brick_size;
  Code least = code_air;
  Code most = code_solid;
  for (int x = lo; x <= hi; ++x)
    for (int y = lo; y <= hi; ++y) {
      const Code* row = brick.data() + (x * atlas_brick_side + y) * atlas_brick_side;
      for (int z = lo; z <= hi; ++z) {
        least = std::min(least, row[z]);
        most = std::max(most, row[z]);
      }
    }
  if (most < 0) return LevelBrick::Kind::solid;
  return least > encode(air_kept_voxels) ? LevelBrick::Kind::empty : LevelBrick::Kind::stored;
}

LevelBrick::Before before_kind_of(const AtlasBrick& brick) {
  const auto [least, most] = std::ranges::minmax(brick);
  if (least >= code_far) return LevelBrick::Before::air;
  return most <= -code_far ? LevelBrick::Before::rock : LevelBrick::Before::mixed;
}

BrickLooks looks_of(const LookWindow& looks, const Window& now, VoxelCoord first) {
  BrickLooks made;
  if (looks.is_ground()) return made;
  constexpr int side = corner_brick_side;
  const auto is_rock = [&](VoxelCoord v) { return now.box.holds(v) && now.at(v.x, v.y, v.z) < 0; };
  // Rock beside a voxel of air: across its faces first, then its edges, then its corners.
  const auto beside = [&](VoxelCoord v) {
    for (int apart = 1; apart <= 3; ++apart)
      for (int i = 0; i < 27; ++i) {
        const VoxelCoord off{i / 9 - 1, i / 3 % 3 - 1, i % 3 - 1};
        if (off.x * off.x + off.y * off.y + off.z * off.z == apart && is_rock(v + off))
          return std::optional(v + off);
      }
    return std::optional<VoxelCoord>();
  };
  auto each = std::make_unique<LookBrick>();
  std::optional<Look> one;
  bool mixed = false;
  std::vector<size_t> unknown;
  size_t at = 0;
  for (int x = 0; x < side; ++x)
    for (int y = 0; y < side; ++y)
      for (int z = 0; z < side; ++z, ++at) {
        const VoxelCoord v = first + VoxelCoord{x, y, z};
        const std::optional<VoxelCoord> rock = is_rock(v) ? std::optional(v) : beside(v);
        if (!rock) {
          unknown.push_back(at);
          continue;
        }
        (*each)[at] = looks.at(*rock);
        if (!one) one = (*each)[at];
        mixed = mixed || (*each)[at] != *one;
      }
  made.all = one.value_or(Look{});
  for (const size_t air : unknown) (*each)[air] = made.all;
  if (mixed) made.each = std::move(each);
  return made;
}

LevelBricks::LevelBricks(const TerrainSource& source, int level, FaceEdges edges)
    : level_(level), edges_(edges), source_(spaced(source, level)) {
  if (level > 0) coarse_ = std::make_unique<MapField>(source_);
}

bool LevelBricks::has_generated(const Field& field, ChunkCoord chunk) const {
  return coarse_ ? coarse_->has_generated(chunk) : field.has_generated(chunk);
}

void LevelBricks::adopt_generated(const Field& field, ChunkCoord chunk, GeneratedChunk&& generated) {
  generator(field).adopt_generated(chunk, std::move(generated));
}

/// The brick of nothing but air or rock that this one and those after it are, if they are.
const Brick* LevelBricks::uniform_around(const Field& field, BrickCoord brick) const {
  const Brick* first = &generator(field).brick(brick);
  if (first != &air_brick() && first != &solid_brick()) return nullptr;
  for (int i = 1; i < 8; ++i) {
    const BrickCoord other = brick + BrickCoord{i >> 2, (i >> 1) & 1, i & 1};
    if (&generator(field).brick(other) != first) return nullptr;
  }
  return first;
}

bool LevelBricks::edited_around(const Field& field, BrickCoord brick) const {
  const VoxelBox samples = level_ > 0 ? samples_of(brick).grown(air_reach) : samples_of(brick);
  const auto fine = [this](VoxelCoord v) { return VoxelCoord{v.x * step(), v.y * step(), v.z * step()}; };
  bool edited = false;
  const VoxelBox box{fine(samples.lo), fine(samples.hi - VoxelCoord{1, 1, 1}) + VoxelCoord{1, 1, 1}};
  for_each_chunk(box, [&](ChunkCoord chunk) { edited = edited || field.has_edits(chunk); });
  if (!edited || level_ > 0) return edited;
  edited = false;
  for_each_brick(box, [&](BrickCoord coord) { edited = edited || field.is_edited(coord); });
  return edited;
}

/// The samples of a brick of a coarse level.
Window LevelBricks::edited_window(const Field& field, BrickCoord brick) const {
  const VoxelBox samples = samples_of(brick);
  const Window generated = gather_generated(generator(field), samples.grown(air_reach));
  Window around = generated;
  copy_edits(field, level_, around, code_air);
  if (around.codes != generated.codes) lower_air(around);
  return part_of(around, samples);
}

/// `around`: more than the brick's samples, on the finest level.
LookWindow LevelBricks::looks_around(const Field& field, BrickCoord brick, const Window& around,
                                     bool edited) const {
  const Field& ground = generator(field);
  if (level_ > 0 || !edited) return gather_looks(field, ground, level_, samples_of(brick));
  const VoxelBox box = samples_of(brick).grown(1);
  LookWindow looks = gather_looks(field, ground, level_, box);
  if (!looks.is_ground())
    spread_heaps(part_of(around, box), gather_generated(ground, box), samples_of(brick), looks);
  return looks;
}

LevelBrick LevelBricks::read(const Field& field, BrickCoord brick) {
  const bool edited = edited_around(field, brick);
  if (!edited) {
    if (const Brick* uniform = uniform_around(field, brick); uniform != nullptr)
      return {
          uniform == &air_brick() ? LevelBrick::Kind::empty : LevelBrick::Kind::solid, {}, {}, {}, {}, {}};
  }
  const VoxelBox samples = samples_of(brick);
  // Planes need more around.
  const Window around =
      level_ > 0 ? Window() : gather(field, samples.grown(plane_brick_reach - atlas_apron_low));
  const Window window = level_ == 0 ? part_of(around, samples)
                        : edited    ? edited_window(field, brick)
                                    : gather(generator(field), samples);
  std::optional<Window> before;
  if (edited) before = gather_generated(generator(field), window.box);
  LevelBrick read{LevelBrick::Kind::empty, as_brick(window), {}, {}, {}, {}};
  read.kind = kind_of(read.field);
  const Field& ground = generator(field);
  if (read.kind == LevelBrick::Kind::stored && (edited || stores_materials(ground, window.box)))
    read.looks = looks_of(looks_around(field, brick, around, edited), window, first_voxel(brick));
  const bool has_edges = !has_smooth_ground(field.source()) || field.is_edited(brick);
  if (read.kind == LevelBrick::Kind::stored && level_ == 0 && edges_ == FaceEdges::sharp && has_edges)
    read.planes = planes_of(around, first_voxel(brick));
  if (!before || before->codes == window.codes) return read;
  read.before = as_brick(*before);
  read.before_kind = before_kind_of(read.before);
  return read;
}

LevelBricks::Range LevelBricks::shown_in(BrickCoord changed) const {
  // A brick has the samples 8b − 1 … 8b + 9. On coarse levels, those around decide their air.
  const int more = level_ > 0 ? air_reach : 0;
  const auto lo = [&](int v) {
    const int sample = (v * brick_size + step() - 1) >> level_;
    return (sample - more - (atlas_brick_side - 1 - atlas_apron_low) + brick_size - 1) >> 3;
  };
  const auto hi = [&](int v) {
    const int sample = (v * brick_size + brick_size - 1) >> level_;
    return ((sample + more + atlas_apron_low) >> 3) + 1;
  };
  const VoxelCoord first = first_voxel(changed);
  const auto skipped = [this](int v) {
    return ((v + step() - 1) >> level_) > ((v + brick_size - 1) >> level_);
  };
  if (skipped(first.x) || skipped(first.y) || skipped(first.z)) return {};
  return {{lo(changed.x), lo(changed.y), lo(changed.z)}, {hi(changed.x), hi(changed.y), hi(changed.z)}};
}

}  // namespace scree
