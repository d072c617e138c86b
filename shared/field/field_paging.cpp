// Field's chunks that are out of memory (paging.h).
#include <algorithm>
#include <bit>

#include "shared/base/check.h"
#include "shared/field/field.h"

namespace scree {

Result<PagedChunk> paged_of(ChunkCoord chunk, std::span<const BrickPatch> bricks) {
  if (bricks.empty()) return fail("a chunk comes without bricks");
  PagedChunk left;
  for (const BrickPatch& patch : bricks) {
    if (chunk_of(patch.coord) != chunk) return fail("a brick lies outside its chunk");
    const uint64_t bit = uint64_t{1} << index_in_chunk(patch.coord);
    if ((left.bricks & bit) != 0) return fail("a brick comes twice");
    left.bricks |= bit;
    left.hash += brick_hash(patch.coord, patch.brick, patch.paint);
    left.mass += brick_mass(patch.brick);
  }
  return left;
}

void Field::page_by(ReadChunk read) {
  CHECK(below_ == nullptr && read != nullptr);
  if (read_ == nullptr) {
    for (const auto& [chunk, edited] : edited_) in_.insert(chunk);
    bricks_in_ = edited_bricks_;
  }
  read_ = std::move(read);
}

void Field::page_out(ChunkCoord chunk) {
  CHECK(pages());
  EditedChunk& edited = edited_.at(chunk);
  CHECK(!edited.out);
  const std::vector<BrickCoord> bricks = edited_bricks(chunk);
  edited.mass = 0;
  for (const BrickCoord brick : bricks) edited.mass += brick_mass(*find_edited(brick));
  for (const BrickCoord brick : bricks) erase_edited(brick);
  chunk_left(chunk);
  edited.paint.clear();
  edited.out = true;
  in_.erase(chunk);
  CHECK(bricks_in_ >= bricks.size());
  bricks_in_ -= bricks.size();
  last_.reset();
}

void Field::add_out(ChunkCoord chunk, const PagedChunk& left) {
  CHECK(pages() && left.bricks != 0);
  const auto [at, is_new] = edited_.try_emplace(chunk);
  CHECK(is_new);
  at->second.hash = left.hash;
  at->second.bricks = left.bricks;
  at->second.mass = left.mass;
  at->second.out = true;
  edited_bricks_ += static_cast<size_t>(std::popcount(left.bricks));
  hash_ += left.hash;
  last_.reset();
}

std::optional<PagedChunk> Field::paged(ChunkCoord chunk) const {
  const auto found = edited_.find(chunk);
  if (found == edited_.end() || !found->second.out) return std::nullopt;
  return PagedChunk{found->second.hash, found->second.bricks, found->second.mass};
}

bool Field::is_out(ChunkCoord chunk) const {
  const auto found = edited_.find(chunk);
  return found != edited_.end() && found->second.out;
}

bool Field::page_in(ChunkCoord chunk, std::span<const BrickPatch> bricks) {
  const std::optional<PagedChunk> left = paged(chunk);
  CHECK(left.has_value());
  const Result<PagedChunk> read = paged_of(chunk, bricks);
  if (!read || read->bricks != left->bricks || read->hash != left->hash) return false;
  enter(chunk, edited_.at(chunk), bricks);
  return true;
}

void Field::enter(ChunkCoord chunk, EditedChunk& edited, std::span<const BrickPatch> bricks) {
  for (const BrickPatch& patch : bricks) {
    store_edited(patch.coord, patch.brick);
    if (patch.paint) edited.paint[index_in_chunk(patch.coord)] = *patch.paint;
  }
  edited.out = false;
  edited.used = turn_;
  in_.insert(chunk);
  bricks_in_ += bricks.size();
  last_.reset();
}

void Field::use(ChunkCoord chunk, EditedChunk& edited) {
  edited.used = turn_;
  if (!edited.out) {
    if (edited.bricks == 0) in_.insert(chunk);  // its first edit follows
    return;
  }
  ++page_waits_;
  const Result<std::vector<BrickPatch>> read = read_(chunk);
  if (!read) throw ChunkUnreadable(read.error().message);
  if (!page_in(chunk, *read))
    throw ChunkUnreadable("chunk " + std::to_string(chunk.x) + ", " + std::to_string(chunk.y) + ", " +
                          std::to_string(chunk.z) + " was read, and is not what left memory");
}

void Field::keep(ChunkCoord chunk) {
  const auto found = edited_.find(chunk);
  if (found != edited_.end()) found->second.used = turn_;
}

void Field::begin_turn() {
  ++turn_;
  last_.reset();
}

bool Field::is_idle(ChunkCoord chunk, uint64_t turns) const {
  const auto found = edited_.find(chunk);
  return found != edited_.end() && !found->second.out && found->second.used + turns <= turn_;
}

std::vector<ChunkCoord> Field::idle_chunks(uint64_t turns) const {
  std::vector<std::pair<uint64_t, ChunkCoord>> idle;
  for (const ChunkCoord chunk : in_) {
    const uint64_t used = edited_.at(chunk).used;
    if (used + turns <= turn_) idle.emplace_back(used, chunk);
  }
  std::ranges::sort(idle);
  std::vector<ChunkCoord> chunks;
  for (const auto& [used, chunk] : idle) chunks.push_back(chunk);
  return chunks;
}

}  // namespace scree
