#include "client/render/bricks/clip_level.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <mutex>
#include <optional>
#include <utility>

#include "client/render/scene/limits.h"

namespace scree {

uint32_t store_before(LevelBrick::Before kind, const AtlasBrick& brick, BrickAtlas& atlas) {
  switch (kind) {
    case LevelBrick::Before::same:
      return 0;
    case LevelBrick::Before::air:
      return ClipEntry::air << 24U;
    case LevelBrick::Before::rock:
      return ClipEntry::rock << 24U;
    case LevelBrick::Before::mixed:
      break;
  }
  const std::optional<AtlasSlot> slot = atlas.add(brick);
  return slot ? ClipEntry::packed(ClipEntry::mixed, *slot) : 0;
}

uint32_t store_looks(const BrickLooks& looks, const ClipEntry& old, CornerAtlas<Look>& atlas) {
  if (looks.each != nullptr) {
    if (old.has_looks_slot()) {
      atlas.replace(ClipEntry::slot_of(old.looks), *looks.each);
      return old.looks;
    }
    if (const auto slot = atlas.add(*looks.each)) return ClipEntry::packed(ClipEntry::looks_mixed, *slot);
  }
  if (old.has_looks_slot()) atlas.remove(ClipEntry::slot_of(old.looks));
  return looks.all.shown | static_cast<uint32_t>(looks.all.bare) << 8U;
}

uint32_t store_planes(const PlaneBrick* planes, const ClipEntry& old, CornerAtlas<FacePlane>& atlas) {
  if (planes == nullptr) {
    if (old.has_planes_slot()) atlas.remove(ClipEntry::slot_of(old.planes));
    return 0;
  }
  if (old.has_planes_slot()) {
    atlas.replace(ClipEntry::slot_of(old.planes), *planes);
    return ClipEntry::packed(edge_eighths(*planes), ClipEntry::slot_of(old.planes));
  }
  const std::optional<AtlasSlot> slot = atlas.add(*planes);
  return slot ? ClipEntry::packed(edge_eighths(*planes), *slot) : 0;
}

struct ClipLevel::Inbox {
  struct Generated {
    ChunkCoord coord;
    GeneratedChunk chunk;
  };
  std::mutex mutex;
  std::vector<Generated> generated;
};

ClipLevel::ClipLevel(WorkPool& pool, const TerrainSource& source, int level, int side, FaceEdges edges)
    : pool_(pool), bricks_(source, level, edges), window_(side), inbox_(std::make_shared<Inbox>()) {}

ClipLevel::~ClipLevel() = default;

void ClipLevel::release(const ClipEntry& entry, BrickAtlas& atlas) {
  if (entry.kind() == ClipEntry::stored) atlas.remove(ClipEntry::slot_of(entry.field));
  if (entry.has_before_slot()) atlas.remove(ClipEntry::slot_of(entry.before));
  if (entry.has_looks_slot()) atlas.looks().remove(ClipEntry::slot_of(entry.looks));
  if (entry.has_planes_slot()) atlas.planes().remove(ClipEntry::slot_of(entry.planes));
}

void ClipLevel::follow(glm::vec3 eye_m, BrickAtlas& atlas) {
  const float chunk_m = voxel_m() * static_cast<float>(chunk_size);
  const auto whole = [chunk_m](float v) { return static_cast<int>(std::lround(v / chunk_m)); };
  const ChunkCoord centre{whole(eye_m.x), whole(eye_m.y), whole(eye_m.z)};
  const BrickCoord half{window_.side() / 2, window_.height() / 2, window_.side() / 2};
  const BrickCoord origin = first_brick(centre) - half;
  if (placed_ && origin == window_.origin()) return;
  placed_ = true;
  window_.move_to(origin, [&](const ClipEntry& entry) { release(entry, atlas); });
  std::erase_if(shown_, [&](ChunkCoord chunk) { return !window_.holds(first_brick(chunk)); });
  list_pending(eye_m);
}

void ClipLevel::list_pending(glm::vec3 eye_m) {
  pending_.clear();
  const BrickCoord origin = window_.origin();
  for (int x = 0; x < window_.side(); x += chunk_bricks)
    for (int y = 0; y < window_.height(); y += chunk_bricks)
      for (int z = 0; z < window_.side(); z += chunk_bricks) {
        const ChunkCoord chunk = chunk_of(origin + BrickCoord{x, y, z});
        if (!shown_.contains(chunk)) pending_.push_back(chunk);
      }
  const float chunk_m = voxel_m() * static_cast<float>(chunk_size);
  std::ranges::sort(pending_, std::greater<>{}, [&](ChunkCoord chunk) {
    const glm::vec3 away = (glm::vec3(chunk.x, chunk.y, chunk.z) + 0.5F) * chunk_m - eye_m;
    return glm::dot(away, away);
  });
}

void ClipLevel::collect_generated(const Field& field) {
  std::vector<Inbox::Generated> generated;
  {
    const std::lock_guard lock(inbox_->mutex);
    std::swap(generated, inbox_->generated);
  }
  for (Inbox::Generated& each : generated) {
    generating_.erase(each.coord);
    bricks_.adopt_generated(field, each.coord, std::move(each.chunk));
  }
}

bool ClipLevel::generated_around(const Field& field, ChunkCoord chunk) {
  bool all = true;
  for (int i = 0; i < 27; ++i) {
    const ChunkCoord coord = chunk + ChunkCoord{i / 9 - 1, i / 3 % 3 - 1, i % 3 - 1};
    if (bricks_.has_generated(field, coord)) continue;
    all = false;
    if (generating_.size() >= limits::chunks_generating_max || generating_.contains(coord)) continue;
    if (!is_here(bricks_.source(), coord)) continue;  // the next time, or the one after
    generating_.insert(coord);
    pool_.submit(WorkPool::Urgency::load, [inbox = inbox_, source = bricks_.source(), coord] {
      GeneratedChunk generated = generate_chunk(source, coord);
      const std::lock_guard lock(inbox->mutex);
      inbox->generated.push_back({coord, std::move(generated)});
    });
  }
  return all;
}

size_t ClipLevel::load(const Field& field, size_t chunks_max, BrickAtlas& atlas) {
  collect_generated(field);
  size_t read_chunks = 0;
  size_t examined = 0;
  for (size_t i = pending_.size(); i-- > 0;) {
    if (read_chunks >= chunks_max || examined++ >= limits::chunks_examined_max) break;
    const ChunkCoord chunk = pending_[i];
    if (!generated_around(field, chunk)) continue;
    for (int j = 0; j < chunk_bricks * chunk_bricks * chunk_bricks; ++j)
      read(field, brick_in_chunk(chunk, j), atlas);
    shown_.insert(chunk);
    ++read_chunks;
    pending_.erase(pending_.begin() + static_cast<std::ptrdiff_t>(i));
  }
  return read_chunks;
}

void ClipLevel::changed(const Field& field, const std::vector<BrickCoord>& bricks, BrickAtlas& atlas) {
  std::unordered_set<BrickCoord, CoordHash> stale;
  for (const BrickCoord brick : bricks) {
    const LevelBricks::Range range = bricks_.shown_in(brick);
    for (int x = range.lo.x; x < range.hi.x; ++x)
      for (int y = range.lo.y; y < range.hi.y; ++y)
        for (int z = range.lo.z; z < range.hi.z; ++z) stale.insert({x, y, z});
  }
  for (const BrickCoord brick : stale)
    if (shown_.contains(chunk_of(brick))) read(field, brick, atlas);
}

void ClipLevel::read(const Field& field, BrickCoord brick, BrickAtlas& atlas) {
  const ClipEntry old = window_.at(brick);
  const LevelBrick now = bricks_.read(field, brick);
  ClipEntry entry;
  if (now.kind == LevelBrick::Kind::stored) {
    if (old.kind() == ClipEntry::stored) {
      entry.field = old.field;
      atlas.replace(ClipEntry::slot_of(old.field), now.field);
    } else if (const auto slot = atlas.add(now.field)) {
      entry.field = ClipEntry::packed(ClipEntry::stored, *slot);
    }  // without room in the atlas a coarser level shows the brick
  } else {
    entry.field = now.kind == LevelBrick::Kind::empty ? clip_empty : ClipEntry::solid << 24U;
  }
  // Generated codes never change: a brick of them keeps its slot.
  const bool keeps = now.before_kind == LevelBrick::Before::mixed && old.has_before_slot();
  entry.before = keeps ? old.before : store_before(now.before_kind, now.before, atlas);
  entry.looks = store_looks(now.looks, old, atlas.looks());
  entry.planes = store_planes(now.planes.get(), old, atlas.planes());
  if (old.kind() == ClipEntry::stored && entry.kind() != ClipEntry::stored)
    atlas.remove(ClipEntry::slot_of(old.field));
  if (old.has_before_slot() && !keeps) atlas.remove(ClipEntry::slot_of(old.before));
  window_.set(brick, entry);
}

size_t ClipLevel::cpu_bytes() const {
  return window_.bytes() + shown_.size() * sizeof(ChunkCoord) + pending_.size() * sizeof(ChunkCoord);
}

}  // namespace scree
