#include "shared/field/field.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <glm/geometric.hpp>
#include <utility>

#include "shared/base/check.h"
#include "shared/base/limits.h"

namespace scree {

namespace {

/// A row's codes, eight at most: calling memcpy took longer than the copy.
inline void copy_row(Code* to, const Code* from, size_t count) {
  if (count == brick_size) {
    std::memcpy(to, from, brick_size);
  } else if (count >= 4) {
    std::memcpy(to, from, 4);
    std::memcpy(to + count - 4, from + count - 4, 4);
  } else {
    for (size_t i = 0; i < count; ++i) to[i] = from[i];
  }
}

/// The part of a brick that lies in a box, as ranges relative to the brick.
struct Overlap {
  VoxelCoord lo;
  VoxelCoord hi;
};

Overlap overlap(BrickCoord brick, const VoxelBox& box) {
  const VoxelCoord first = first_voxel(brick);
  const auto low = [](int a, int b) { return std::max(a - b, 0); };
  const auto high = [](int a, int b) { return std::min(a - b, brick_size); };
  return {{low(box.lo.x, first.x), low(box.lo.y, first.y), low(box.lo.z, first.z)},
          {high(box.hi.x, first.x), high(box.hi.y, first.y), high(box.hi.z, first.z)}};
}

/// Calls f(offset in the brick, offset in the window, count) for each row along z.
template <typename F>
void for_each_row(BrickCoord brick, const Window& window, F&& f) {
  const Overlap part = overlap(brick, window.box);
  const VoxelCoord first = first_voxel(brick);
  const auto count = static_cast<size_t>(part.hi.z - part.lo.z);
  CHECK_DEBUG(count > 0 && count <= brick_size);
  const VoxelCoord size = window.box.size();
  const auto step_y = static_cast<size_t>(size.z), step_x = static_cast<size_t>(size.y) * step_y;
  size_t plane = window.index(first.x + part.lo.x, first.y + part.lo.y, first.z + part.lo.z);
  for (int x = part.lo.x; x < part.hi.x; ++x, plane += step_x) {
    size_t row = plane;
    for (int y = part.lo.y; y < part.hi.y; ++y, row += step_y)
      f(static_cast<size_t>(Brick::index(x, y, part.lo.z)), row, count);
  }
}

}  // namespace

uint64_t brick_hash(BrickCoord coord, const Brick& brick, std::optional<Material> paint) {
  return paint ? painted_brick_hash(coord, brick, static_cast<uint8_t>(*paint)) : brick_hash(coord, brick);
}

Field::Field(const TerrainSource& source)
    : source_(source), generated_bytes_max_(limits::generated_bytes_max) {
  CHECK(source.voxel_size_m > 0.0F);
}

Field::Field(Field* below)
    : source_(below->source_), below_(below), generated_bytes_max_(limits::generated_bytes_max) {}

uint64_t Field::edited_bits(ChunkCoord chunk) const {
  const auto found = edited_.find(chunk);
  const uint64_t own = found == edited_.end() ? 0 : found->second.bricks;
  return below_ == nullptr ? own : own | below_->edited_bits(chunk);
}

size_t Field::generated_chunks() const {
  return keeper().generated_.chunks.size() + keeper().unused_.chunks.size();
}

size_t Field::generated_bytes() const {
  return keeper().generated_.bytes + keeper().unused_.bytes;
}

void Field::make_room(size_t bytes) {
  if (generated_.chunks.empty() || generated_.bytes + bytes <= generated_bytes_max_ / 2) return;
  unused_ = std::exchange(generated_, {});
  last_.reset();
}

GeneratedChunk* Field::find_generated(ChunkCoord chunk) {
  const auto found = generated_.chunks.find(chunk);
  if (found != generated_.chunks.end()) return &found->second;
  auto used = unused_.chunks.extract(chunk);
  if (used.empty()) return nullptr;
  const size_t bytes = used.mapped().bytes();
  unused_.bytes -= bytes;
  make_room(bytes);
  generated_.bytes += bytes;
  return &generated_.chunks.insert(std::move(used)).position->second;
}

GeneratedChunk& Field::add_generated(ChunkCoord chunk, GeneratedChunk generated) {
  make_room(generated.bytes());
  generated_.bytes += generated.bytes();
  return generated_.chunks.emplace(chunk, std::move(generated)).first->second;
}

void Field::replace_generated(GeneratedChunk& old, GeneratedChunk generated) {
  generated_.bytes = generated_.bytes - old.bytes() + generated.bytes();
  old = std::move(generated);
}

const GeneratedChunk& Field::generated_chunk(ChunkCoord chunk) {
  if (below_ != nullptr) return below_->generated_chunk(chunk);
  GeneratedChunk* const found = find_generated(chunk);
  if (found == nullptr) return add_generated(chunk, generate_chunk(source_, chunk));
  if (!found->exact && is_here(source_, chunk)) replace_generated(*found, generate_chunk(source_, chunk));
  return *found;
}

void Field::bound_generated(size_t bytes) {
  CHECK(below_ == nullptr && bytes > 0 && bytes <= limits::generated_bytes_max);
  generated_bytes_max_ = bytes;
  if (generated_bytes() <= bytes) return;
  generated_ = {};
  unused_ = {};
  last_.reset();
}

Field::LastChunk& Field::last_chunk(ChunkCoord chunk) {
  if (last_ && last_->coord == chunk && below_ == nullptr) return *last_;
  if (read_ != nullptr)
    if (const auto found = edited_.find(chunk); found != edited_.end()) use(chunk, found->second);
  return last_.emplace(LastChunk{chunk, edited_bits(chunk), nullptr});
}

const Brick& Field::generated_brick(BrickCoord coord) {
  if (below_ != nullptr) return below_->generated_brick(coord);
  const ChunkCoord chunk = chunk_of(coord);
  LastChunk last = last_chunk(chunk);
  if (last.generated == nullptr) {
    last.generated = &generated_chunk(chunk);
    if (last.generated->exact) last_ = last;
  }
  return *last.generated->bricks[static_cast<size_t>(index_in_chunk(coord))];
}

Field::ChunkBricks Field::chunk_bricks(ChunkCoord chunk) {
  return {generated_chunk(chunk), edited_bits(chunk)};
}

const Brick& Field::brick(BrickCoord coord) {
  const bool edited = ((last_chunk(chunk_of(coord)).edited >> index_in_chunk(coord)) & 1U) != 0;
  CHECK_DEBUG(edited == (find_edited(coord) != nullptr));
  return edited ? *find_edited(coord) : generated_brick(coord);
}

void Field::set_brick(BrickCoord coord, const Brick& brick) {
  CHECK_DEBUG(std::ranges::count(brick.codes, Code{-128}) == 0);
  EditedChunk& chunk = edited_[chunk_of(coord)];
  if (read_ != nullptr) use(chunk_of(coord), chunk);
  const uint64_t bit = uint64_t{1} << index_in_chunk(coord);
  const std::optional<Material> paint = painted(coord);
  const bool edited = (chunk.bricks & bit) != 0 || find_below(coord) != nullptr;
  CHECK_DEBUG(edited == (find_edited(coord) != nullptr));
  uint64_t change = brick_hash(coord, brick, paint);
  if (edited) change -= brick_hash(coord, *find_edited(coord), paint);
  store_edited(coord, brick);
  edited_bricks_ += edited ? 0 : 1;
  bricks_in_ += edited || read_ == nullptr ? 0 : 1;
  chunk.bricks |= bit;
  if (paint) chunk.paint[index_in_chunk(coord)] = *paint;  // a layer's own from now on
  if (last_ && last_->coord == chunk_of(coord)) last_->edited = chunk.bricks;
  chunk.hash += change;
  hash_ += change;
}

std::optional<Material> Field::painted(BrickCoord coord) const {
  const auto chunk = edited_.find(chunk_of(coord));
  const bool own = chunk != edited_.end() && ((chunk->second.bricks >> index_in_chunk(coord)) & 1U) != 0;
  if (!own) return below_ == nullptr ? std::nullopt : below_->painted(coord);
  // Bringing a chunk in changes nothing that can be seen.
  if (chunk->second.out) const_cast<Field*>(this)->use(chunk->first, const_cast<EditedChunk&>(chunk->second));
  const auto paint = chunk->second.paint.find(index_in_chunk(coord));
  if (paint == chunk->second.paint.end()) return std::nullopt;
  return paint->second;
}

void Field::paint_brick(BrickCoord coord, std::optional<Material> paint) {
  const std::optional<Material> before = painted(coord);
  if (before == paint) return;
  const bool own = below_ == nullptr && is_edited(coord);
  if (!own) set_brick(coord, Brick(brick(coord)));
  EditedChunk& chunk = edited_[chunk_of(coord)];
  const Brick& codes = *find_edited(coord);
  const uint64_t change = brick_hash(coord, codes, paint) - brick_hash(coord, codes, before);
  if (paint)
    chunk.paint[index_in_chunk(coord)] = *paint;
  else
    chunk.paint.erase(index_in_chunk(coord));
  chunk.hash += change;
  hash_ += change;
}

void Field::forget_chunk(ChunkCoord chunk) {
  CHECK(below_ == nullptr && read_ == nullptr);
  const auto found = edited_.find(chunk);
  if (found == edited_.end()) return;
  last_.reset();
  uint64_t hash_left = found->second.hash;
  for (const BrickCoord coord : edited_bricks(chunk)) {
    hash_left -= brick_hash(coord, *find_edited(coord), painted(coord));
    erase_edited(coord);
  }
  const auto forgotten = static_cast<size_t>(std::popcount(found->second.bricks));
  CHECK(edited_bricks_ >= forgotten);
  edited_bricks_ -= forgotten;
  CHECK(hash_left == 0);  // a chunk's hash is the sum over its edited bricks
  hash_ -= found->second.hash;
  edited_.erase(found);
  CHECK(!edited_.empty() || hash_ == 0);
}

uint64_t Field::chunk_hash(ChunkCoord chunk) const {
  const auto found = edited_.find(chunk);
  const uint64_t own = found == edited_.end() ? 0 : found->second.hash;
  return below_ == nullptr ? own : own + below_->chunk_hash(chunk);
}

std::vector<ChunkCoord> Field::edited_chunks() const {
  std::vector<ChunkCoord> chunks;
  if (below_ != nullptr) chunks = below_->edited_chunks();
  chunks.reserve(chunks.size() + edited_.size());
  for (const auto& [coord, chunk] : edited_) chunks.push_back(coord);
  std::ranges::sort(chunks);
  chunks.erase(std::unique(chunks.begin(), chunks.end()),
               chunks.end());  // clang 14 lacks std::ranges::unique
  return chunks;
}

std::vector<BrickCoord> Field::edited_bricks(ChunkCoord chunk) const {
  std::vector<BrickCoord> bricks;
  for (uint64_t left = edited_bits(chunk); left != 0; left &= left - 1)
    bricks.push_back(brick_in_chunk(chunk, std::countr_zero(left)));
  return bricks;
}

void Field::adopt_generated(ChunkCoord chunk, GeneratedChunk generated) {
  if (below_ != nullptr) return below_->adopt_generated(chunk, std::move(generated));
  CHECK(std::ranges::find(generated.bricks, nullptr) == generated.bricks.end());
  if (!generated.exact) return;
  GeneratedChunk* const kept = find_generated(chunk);
  if (kept == nullptr)
    add_generated(chunk, std::move(generated));
  else if (!kept->exact)
    replace_generated(*kept, std::move(generated));
}

bool Field::has_generated(ChunkCoord chunk) const {
  const Field& field = keeper();
  for (const auto* kept : {&field.generated_.chunks, &field.unused_.chunks})
    if (const auto found = kept->find(chunk); found != kept->end()) return found->second.exact;
  return false;
}

bool Field::keep_generated(ChunkCoord chunk) {
  if (below_ != nullptr) return below_->keep_generated(chunk);
  const GeneratedChunk* const found = find_generated(chunk);
  return found != nullptr && found->exact;
}

const Brick* MapField::find_edited(BrickCoord coord) const {
  const auto found = slots_.find(coord);
  return found == slots_.end() ? find_below(coord) : found->second.brick;
}

void MapField::store_edited(BrickCoord coord, const Brick& brick) {
  Slot& slot = slots_[coord];
  if (const Brick* uniform = uniform_equivalent(brick)) {
    slot = {uniform, nullptr};
    return;
  }
  if (slot.own == nullptr) slot.own = std::make_unique<Brick>();
  *slot.own = brick;
  slot.brick = slot.own.get();
}

void MapField::erase_edited(BrickCoord coord) {
  slots_.erase(coord);
}

Window gather(Field& field, const VoxelBox& box) {
  CHECK(!box.empty());
  Window window(box);
  for_each_brick(box, [&](BrickCoord coord) {
    const Brick& brick = field.brick(coord);
    for_each_row(coord, window, [&](size_t from, size_t to, size_t count) {
      copy_row(window.codes.data() + to, brick.codes.data() + from, count);
    });
  });
  return window;
}

std::vector<BrickCoord> scatter(Field& field, const Window& window) {
  std::vector<BrickCoord> changed;
  CHECK_EQ(window.codes.size(), Window::count(window.box));
  for_each_brick(window.box, [&](BrickCoord coord) {
    const Brick& old = field.brick(coord);
    Brick brick = old;
    for_each_row(coord, window, [&](size_t to, size_t from, size_t count) {
      copy_row(brick.codes.data() + to, window.codes.data() + from, count);
    });
    if (brick == old) return;
    field.set_brick(coord, brick);
    changed.push_back(coord);
  });
  CHECK_DEBUG(std::ranges::is_sorted(changed));
  return changed;
}

FieldSample sample(Field& field, glm::vec3 p_voxels) {
  const VoxelCoord v{floor_to_int(p_voxels.x), floor_to_int(p_voxels.y), floor_to_int(p_voxels.z)};
  const float fx = p_voxels.x - static_cast<float>(v.x);
  const float fy = p_voxels.y - static_cast<float>(v.y);
  const float fz = p_voxels.z - static_cast<float>(v.z);
  float c[8];
  const BrickCoord home = brick_of(v);
  const VoxelCoord in{v.x & 7, v.y & 7, v.z & 7};
  if (in.x < 7 && in.y < 7 && in.z < 7) {
    const Brick& brick = field.brick(home);
    for (int i = 0; i < 8; ++i)
      c[i] = brick.codes[static_cast<size_t>(
          Brick::index(in.x + (i >> 2), in.y + ((i >> 1) & 1), in.z + (i & 1)))];
  } else {
    for (int i = 0; i < 8; ++i) {
      const VoxelCoord at{v.x + (i >> 2), v.y + ((i >> 1) & 1), v.z + (i & 1)};
      c[i] = field.brick(brick_of(at)).codes[static_cast<size_t>(Brick::index(at.x & 7, at.y & 7, at.z & 7))];
    }
  }
  const float x00 = c[0] + (c[4] - c[0]) * fx, x01 = c[1] + (c[5] - c[1]) * fx;
  const float x10 = c[2] + (c[6] - c[2]) * fx, x11 = c[3] + (c[7] - c[3]) * fx;
  const float y0 = x00 + (x10 - x00) * fy, y1 = x01 + (x11 - x01) * fy;
  const float low_x = (c[4] - c[0]) * (1 - fy) + (c[6] - c[2]) * fy;
  const float high_x = (c[5] - c[1]) * (1 - fy) + (c[7] - c[3]) * fy;
  const float scale = band_voxels / 127.0F;
  return {
      (y0 + (y1 - y0) * fz) * scale,
      glm::vec3(low_x + (high_x - low_x) * fz, (x10 - x00) * (1 - fz) + (x11 - x01) * fz, y1 - y0) * scale};
}

std::optional<float> trace(Field& field, glm::vec3 from_voxels, glm::vec3 direction,
                           float distance_max_voxels) {
  constexpr float close_enough = 0.02F;
  CHECK(std::abs(glm::dot(direction, direction) - 1.0F) < 1e-3F);
  float along = 0.0F;
  while (along <= distance_max_voxels) {
    const float distance = sample(field, from_voxels + direction * along).distance_voxels;
    if (distance < close_enough) return along;
    along += distance * 0.9F;
  }
  return std::nullopt;
}

}  // namespace scree
