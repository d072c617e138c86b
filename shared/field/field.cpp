#include "shared/field/field.h"

#include <algorithm>
#include <bit>
#include <utility>

#include "shared/base/check.h"
#include "shared/base/limits.h"

namespace scree {

Field::Field(const TerrainSource& source) : source_(source), generated_(limits::generated_bytes_max) {
  CHECK(source.voxel_size_m > 0.0F);
}

Field::Field(const Field* below)
    : source_(below->source_), below_(below), generated_(limits::generated_bytes_max) {}

uint64_t Field::edited_bits(ChunkCoord chunk) const {
  const auto found = edited_.find(chunk);
  const uint64_t own = found == edited_.end() ? 0 : found->second.bricks;
  return below_ == nullptr ? own : own | below_->edited_bits(chunk);
}

size_t Field::generated_chunks() const {
  return generated_owner().generated_.chunks();
}

size_t Field::generated_bytes() const {
  return generated_owner().generated_.bytes();
}

void Field::heed_drops() const {
  if (drops_heeded_ == generated_.drops()) return;
  drops_heeded_ = generated_.drops();
  last_.reset();
}

const GeneratedChunk& Field::generated_chunk(ChunkCoord chunk) const {
  if (below_ != nullptr) return below_->generated_chunk(chunk);
  GeneratedChunk* found = generated_.find(chunk);
  if (found == nullptr)
    found = &generated_.add(chunk, generate_chunk(source_, chunk));
  else if (!found->exact && is_here(source_, chunk))
    generated_.replace(*found, generate_chunk(source_, chunk));
  heed_drops();
  return *found;
}

void Field::bound_generated(size_t bytes) {
  CHECK(below_ == nullptr && bytes <= limits::generated_bytes_max);
  generated_.bound(bytes);
  heed_drops();
}

Field::LastChunk& Field::last_chunk(ChunkCoord chunk) const {
  if (last_ && last_->coord == chunk && below_ == nullptr) return *last_;
  if (pages())
    if (const auto found = edited_.find(chunk); found != edited_.end()) use(chunk, found->second);
  return last_.emplace(LastChunk{chunk, edited_bits(chunk), nullptr});
}

const Brick& Field::generated_brick(BrickCoord coord) const {
  if (below_ != nullptr) return below_->generated_brick(coord);
  const ChunkCoord chunk = chunk_of(coord);
  LastChunk last = last_chunk(chunk);
  if (last.generated == nullptr) {
    last.generated = &generated_chunk(chunk);
    if (last.generated->exact) last_ = last;
  }
  return *last.generated->bricks[static_cast<size_t>(index_in_chunk(coord))];
}

Field::ChunkBricks Field::chunk_bricks(ChunkCoord chunk) const {
  return {generated_chunk(chunk), edited_bits(chunk)};
}

const Brick& Field::brick(BrickCoord coord) const {
  const bool edited = ((last_chunk(chunk_of(coord)).edited >> index_in_chunk(coord)) & 1U) != 0;
  CHECK_DEBUG(edited == (find_edited(coord) != nullptr));
  return edited ? *find_edited(coord) : generated_brick(coord);
}

void Field::write_brick(BrickCoord coord, const Brick& brick, const BrickMaterials* materials) {
  CHECK_DEBUG(std::ranges::count(brick.codes, Code{-128}) == 0);
  EditedChunk& chunk = edited_[chunk_of(coord)];
  if (pages()) {
    use(chunk_of(coord), chunk);
    if (chunk.bricks == 0) residence_.enter(chunk_of(coord), 0);  // its first edit follows
  }
  const int index = index_in_chunk(coord);
  const uint64_t bit = uint64_t{1} << index;
  const bool own = (chunk.bricks & bit) != 0;
  const Brick* const old = own ? find_edited(coord) : find_below(coord);
  CHECK_DEBUG(old == find_edited(coord));
  const auto said = own ? chunk.materials.find(index) : chunk.materials.end();
  BrickMaterials before;
  if (said != chunk.materials.end())
    before = said->second;
  else if (!own && below_ != nullptr)
    before = below_->materials(coord);
  if (replaced_ != nullptr)
    replaced_->push_back({coord, old != nullptr ? *old : generated_brick(coord), before});
  const BrickMaterials& now = materials == nullptr ? before : *materials;
  uint64_t change = brick_hash(coord, brick, now);
  if (old != nullptr) change -= brick_hash(coord, *old, before);
  store_edited(coord, brick);
  edited_bricks_ += old != nullptr ? 0 : 1;
  if (old == nullptr && pages()) residence_.add_brick();
  chunk.bricks |= bit;
  if (now.is_ground()) {
    if (said != chunk.materials.end()) chunk.materials.erase(said);
  } else if (said == chunk.materials.end()) {
    chunk.materials.emplace(index, now);  // also what a layer's brick said below
  } else if (materials != nullptr) {
    said->second = now;
  }
  if (last_ && last_->coord == chunk_of(coord)) last_->edited = chunk.bricks;
  chunk.hash += change;
  hash_ += change;
}

BrickMaterials Field::materials(BrickCoord coord) const {
  const auto chunk = edited_.find(chunk_of(coord));
  const bool own = chunk != edited_.end() && ((chunk->second.bricks >> index_in_chunk(coord)) & 1U) != 0;
  if (!own) return below_ == nullptr ? BrickMaterials() : below_->materials(coord);
  if (chunk->second.out) use(chunk->first, chunk->second);
  const auto said = chunk->second.materials.find(index_in_chunk(coord));
  return said == chunk->second.materials.end() ? BrickMaterials() : said->second;
}

void Field::set_materials(BrickCoord coord, const BrickMaterials& now) {
  if (!(materials(coord) == now)) set_brick(coord, Brick(brick(coord)), now);
}

bool Field::may_be_layered(ChunkCoord chunk) const {
  const int first = first_voxel(chunk).y;
  return layers_.possible(first, first + chunk_size);
}

const BrickMaterials& Field::ground_materials(BrickCoord coord) const {
  if (below_ != nullptr) return below_->ground_materials(coord);
  const ChunkCoord chunk = chunk_of(coord);
  const bool stored = source_.heights != nullptr && source_.heights->bricks().has_value();
  if (!stored && !may_be_layered(chunk)) return bulk_;
  const GeneratedChunk& generated = generated_chunk(chunk);
  const PackedChunkMaterials* materials = generated.stored_materials.get();
  const BrickMaterials* says = materials == nullptr ? nullptr : &materials->at(index_in_chunk(coord));
  if (says != nullptr && !says->says_ground()) return *says;
  const bool silent = says == nullptr || says->is_ground();
  if (!stored || (silent && !may_be_layered(chunk))) return bulk_;
  return ground_materials_.of(source_, coord, generated);
}

std::optional<Field::ChunkRock> Field::chunk_rock(ChunkCoord chunk) const {
  const bool stored = source_.heights != nullptr && source_.heights->bricks().has_value();
  if (below_ != nullptr || stored) return std::nullopt;
  ChunkRock rock;
  if (const auto edited = edited_.find(chunk); edited != edited_.end()) {
    if (edited->second.out) use(chunk, edited->second);
    if (!edited->second.materials.empty()) rock.said = &edited->second.materials;
  }
  if (may_be_layered(chunk)) rock.ground = generated_chunk(chunk).stored_materials.get();
  return rock;
}

void Field::forget_chunk(ChunkCoord chunk) {
  CHECK(below_ == nullptr && !pages());
  const auto found = edited_.find(chunk);
  if (found == edited_.end()) return;
  last_.reset();
  uint64_t hash_left = found->second.hash;
  for (const BrickCoord coord : edited_bricks(chunk)) {
    hash_left -= brick_hash(coord, *find_edited(coord), materials(coord));
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

void Field::mark_chunk(ChunkCoord chunk, uint64_t bricks, uint64_t hash,
                       std::map<int, BrickMaterials> materials) {
  CHECK(below_ == nullptr && !pages());
  EditedChunk& edited = edited_[chunk];
  edited_bricks_ -= static_cast<size_t>(std::popcount(edited.bricks));
  edited_bricks_ += static_cast<size_t>(std::popcount(bricks));
  hash_ += hash - edited.hash;
  edited.bricks = bricks;
  edited.hash = hash;
  edited.materials = std::move(materials);
  if (bricks == 0) edited_.erase(chunk);
  last_.reset();
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

void Field::adopt_generated(ChunkCoord chunk, GeneratedChunk generated) const {
  if (below_ != nullptr) return below_->adopt_generated(chunk, std::move(generated));
  CHECK(std::ranges::find(generated.bricks, nullptr) == generated.bricks.end());
  if (!generated.exact) return;
  GeneratedChunk* const found_chunk = generated_.find(chunk);
  if (found_chunk == nullptr)
    generated_.add(chunk, std::move(generated));
  else if (!found_chunk->exact)
    generated_.replace(*found_chunk, std::move(generated));
  heed_drops();
}

bool Field::has_generated(ChunkCoord chunk) const {
  return generated_owner().generated_.has_exact(chunk);
}

bool Field::touch_generated(ChunkCoord chunk) const {
  if (below_ != nullptr) return below_->touch_generated(chunk);
  const GeneratedChunk* const found = generated_.find(chunk);
  heed_drops();
  return found != nullptr && found->exact;
}

void Field::page_by(ReadChunk read) {
  CHECK(below_ == nullptr && read != nullptr);
  if (!pages())
    for (const auto& [chunk, edited] : edited_)
      residence_.enter(chunk, static_cast<size_t>(std::popcount(edited.bricks)));
  residence_.page_by([this, read = std::move(read)](ChunkCoord chunk) { bring_in(chunk, read); });
}

void Field::page_out(ChunkCoord chunk) {
  CHECK(pages());
  EditedChunk& edited = edited_.at(chunk);
  CHECK(!edited.out);
  const std::vector<BrickCoord> bricks = edited_bricks(chunk);
  edited.mass = 0;
  for (const BrickCoord brick : bricks)
    edited.mass += brick_mass(source_, brick, *find_edited(brick), materials(brick));
  for (const BrickCoord brick : bricks) erase_edited(brick);
  chunk_left(chunk);
  edited.materials.clear();
  edited.out = true;
  residence_.leave(chunk, bricks.size());
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
  const Result<PagedChunk> read = paged_of(source_, chunk, bricks);
  if (!read || read->bricks != left->bricks || read->hash != left->hash) return false;
  enter(chunk, edited_.at(chunk), bricks);
  return true;
}

void Field::enter(ChunkCoord chunk, EditedChunk& edited, std::span<const BrickPatch> bricks) {
  for (const BrickPatch& patch : bricks) {
    store_edited(patch.coord, patch.brick);
    if (!patch.materials.is_ground()) edited.materials[index_in_chunk(patch.coord)] = patch.materials;
  }
  edited.out = false;
  edited.used = residence_.turn();
  residence_.enter(chunk, bricks.size());
  last_.reset();
}

void Field::use(ChunkCoord chunk, const EditedChunk& edited) const {
  edited.used = residence_.turn();
  if (edited.out) residence_.bring_in(chunk);
}

/// Codes and materials stay the same for every reader.
void Field::bring_in(ChunkCoord chunk, const ReadChunk& read) {
  residence_.count_wait();
  const Result<std::vector<BrickPatch>> bricks = read(chunk);
  if (!bricks) throw ChunkUnreadable(bricks.error().message);
  if (!page_in(chunk, *bricks))
    throw ChunkUnreadable("chunk " + std::to_string(chunk.x) + ", " + std::to_string(chunk.y) + ", " +
                          std::to_string(chunk.z) + " was read, and differs from the chunk that left memory");
}

void Field::touch(ChunkCoord chunk) {
  const auto found = edited_.find(chunk);
  if (found != edited_.end()) found->second.used = residence_.turn();
}

void Field::begin_turn() {
  residence_.begin_turn();
  last_.reset();
}

bool Field::is_idle(ChunkCoord chunk, uint64_t turns) const {
  const auto found = edited_.find(chunk);
  return found != edited_.end() && !found->second.out && found->second.used + turns <= residence_.turn();
}

std::vector<ChunkCoord> Field::idle_chunks(uint64_t turns) const {
  std::vector<std::pair<uint64_t, ChunkCoord>> idle;
  for (const ChunkCoord chunk : residence_.chunks()) {
    const uint64_t used = edited_.at(chunk).used;
    if (used + turns <= residence_.turn()) idle.emplace_back(used, chunk);
  }
  std::ranges::sort(idle);
  std::vector<ChunkCoord> chunks;
  for (const auto& [used, chunk] : idle) chunks.push_back(chunk);
  return chunks;
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

}  // namespace scree
