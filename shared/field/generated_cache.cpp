#include "shared/field/generated_cache.h"

#include <utility>

#include "shared/base/check.h"

namespace scree {

void GeneratedCache::make_room(size_t bytes) {
  if (used_.chunks.empty() || used_.bytes + bytes <= bytes_max_ / 2) return;
  unused_ = std::exchange(used_, {});
  ++drops_;
}

GeneratedChunk* GeneratedCache::find(ChunkCoord chunk) {
  const auto found = used_.chunks.find(chunk);
  if (found != used_.chunks.end()) return &found->second;
  auto again = unused_.chunks.extract(chunk);
  if (again.empty()) return nullptr;
  const size_t bytes = again.mapped().bytes();
  unused_.bytes -= bytes;
  make_room(bytes);
  used_.bytes += bytes;
  return &used_.chunks.insert(std::move(again)).position->second;
}

GeneratedChunk& GeneratedCache::add(ChunkCoord chunk, GeneratedChunk generated) {
  make_room(generated.bytes());
  used_.bytes += generated.bytes();
  return used_.chunks.emplace(chunk, std::move(generated)).first->second;
}

void GeneratedCache::replace(GeneratedChunk& old, GeneratedChunk generated) {
  used_.bytes = used_.bytes - old.bytes() + generated.bytes();
  old = std::move(generated);
}

bool GeneratedCache::has_exact(ChunkCoord chunk) const {
  for (const Chunks* found_chunk : {&used_.chunks, &unused_.chunks})
    if (const auto found = found_chunk->find(chunk); found != found_chunk->end()) return found->second.exact;
  return false;
}

void GeneratedCache::bound(size_t bytes_max) {
  CHECK(bytes_max > 0);
  bytes_max_ = bytes_max;
  if (bytes() <= bytes_max) return;
  used_ = {};
  unused_ = {};
  ++drops_;
}

}  // namespace scree
