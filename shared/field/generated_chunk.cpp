#include "shared/field/generated_chunk.h"

#include <algorithm>
#include <vector>

#include "shared/base/check.h"

namespace scree {

namespace {

/// `slots[i]`: the brick's place in `own`, or none when chunk.bricks[i] is a shared one.
void adopt_bricks(GeneratedChunk& chunk, const std::vector<Brick>& own,
                  const std::array<size_t, chunk_brick_count>& slots) {
  chunk.storage = std::make_unique<Brick[]>(own.size());
  chunk.stored = static_cast<uint32_t>(own.size());
  std::ranges::copy(own, chunk.storage.get());
  for (size_t i = 0; i < chunk_brick_count; ++i)
    if (chunk.bricks[i] == nullptr) chunk.bricks[i] = chunk.storage.get() + slots[i];
  CHECK(std::ranges::find(chunk.bricks, nullptr) == chunk.bricks.end());
}

/// `brick_at(i)`: brick i, by value or reference.
template <typename F>
GeneratedChunk chunk_from(F&& brick_at) {
  GeneratedChunk chunk;
  std::vector<Brick> own;
  std::array<size_t, chunk_brick_count> slots{};
  for (size_t i = 0; i < chunk_brick_count; ++i) {
    const Brick& brick = brick_at(i);
    chunk.bricks[i] = uniform_equivalent(brick);
    slots[i] = own.size();
    if (chunk.bricks[i] == nullptr) own.push_back(brick);
  }
  adopt_bricks(chunk, own, slots);
  return chunk;
}

}  // namespace

PackedChunkMaterials::PackedChunkMaterials(const ChunkMaterials& materials) {
  for (size_t i = 0; i < materials.size(); ++i) {
    const auto found = std::ranges::find(distinct_, materials[i]);
    places_[i] = static_cast<uint8_t>(found - distinct_.begin());
    if (found == distinct_.end()) distinct_.push_back(materials[i]);
  }
  distinct_.shrink_to_fit();
}

size_t PackedChunkMaterials::bytes() const {
  size_t sum = sizeof(*this) + distinct_.size() * sizeof(BrickMaterials);
  for (const BrickMaterials& materials : distinct_) sum += materials.bytes();
  return sum;
}

bool PackedChunkMaterials::operator==(const PackedChunkMaterials& other) const {
  for (int i = 0; i < static_cast<int>(chunk_brick_count); ++i)
    if (!(at(i) == other.at(i))) return false;
  return true;
}

std::shared_ptr<const PackedChunkMaterials> stored_materials_of(const ChunkMaterials& materials) {
  if (std::ranges::all_of(materials, &BrickMaterials::is_ground)) return nullptr;
  return std::make_shared<const PackedChunkMaterials>(materials);
}

size_t GeneratedChunk::bytes() const {
  size_t sum = sizeof(GeneratedChunk) + stored * sizeof(Brick);
  if (stored_materials == nullptr) return sum;
  return sum + stored_materials->bytes();
}

GeneratedChunk uniform_chunk(const Brick& brick) {
  GeneratedChunk chunk;
  chunk.bricks.fill(&brick);
  return chunk;
}

GeneratedChunk split_into_bricks(const Window& window, ChunkCoord coord) {
  Brick brick;
  return chunk_from([&](size_t i) -> const Brick& {
    const VoxelCoord first = first_voxel(brick_in_chunk(coord, static_cast<int>(i)));
    for (int x = 0; x < brick_size; ++x)
      for (int y = 0; y < brick_size; ++y)
        std::copy_n(window.codes.data() + window.index(first.x + x, first.y + y, first.z), brick_size,
                    brick.codes.data() + Brick::index(x, y, 0));
    return brick;
  });
}

GeneratedChunk chunk_of_bricks(const std::array<Brick, chunk_brick_count>& bricks) {
  return chunk_from([&](size_t i) -> const Brick& { return bricks[i]; });
}

GeneratedChunk copy_of(const GeneratedChunk& from) {
  GeneratedChunk chunk = chunk_from([&](size_t i) -> const Brick& { return *from.bricks[i]; });
  chunk.stored_materials = from.stored_materials;
  chunk.exact = from.exact;
  return chunk;
}

bool same_bricks(const GeneratedChunk& a, const GeneratedChunk& b) {
  const bool same = a.stored_materials == nullptr || b.stored_materials == nullptr
                        ? a.stored_materials == b.stored_materials
                        : *a.stored_materials == *b.stored_materials;
  return same && std::ranges::equal(a.bricks, b.bricks,
                                    [](const Brick* x, const Brick* y) { return x == y || *x == *y; });
}

}  // namespace scree
