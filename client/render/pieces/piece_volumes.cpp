#include "client/render/pieces/piece_volumes.h"

#include <algorithm>
#include <bit>
#include <cstddef>

#include "client/render/bricks/clip_level.h"
#include "client/render/levels/block_windows.h"
#include "client/render/levels/look_window.h"
#include "client/render/scene/piece_tint.h"

namespace scree {
namespace {

constexpr size_t entries_at_first = size_t{PieceVolumes::entries_row} * 64;

/// The smallest box with all rock of a volume; empty if there is none.
VoxelBox rock_box(const Window& window) {
  VoxelBox rock{window.box.hi, window.box.lo};
  size_t i = 0;
  for (int x = window.box.lo.x; x < window.box.hi.x; ++x)
    for (int y = window.box.lo.y; y < window.box.hi.y; ++y)
      for (int z = window.box.lo.z; z < window.box.hi.z; ++z, ++i) {
        if (window.codes[i] >= 0) continue;
        rock.lo = {std::min(rock.lo.x, x), std::min(rock.lo.y, y), std::min(rock.lo.z, z)};
        rock.hi = {std::max(rock.hi.x, x + 1), std::max(rock.hi.y, y + 1), std::max(rock.hi.z, z + 1)};
      }
  return rock;
}

/// The samples of a brick that begins at a voxel; air outside of the window.
AtlasBrick brick_from(const Window& window, VoxelCoord first) {
  AtlasBrick brick;
  size_t i = 0;
  for (int x = 0; x < atlas_brick_side; ++x)
    for (int y = 0; y < atlas_brick_side; ++y)
      for (int z = 0; z < atlas_brick_side; ++z, ++i) {
        const VoxelCoord v =
            first + VoxelCoord{x - atlas_apron_low, y - atlas_apron_low, z - atlas_apron_low};
        brick[i] = window.box.holds(v) ? window.at(v.x, v.y, v.z) : code_air;
      }
  return brick;
}

/// A volume's codes, air about them, as far as the planes of bricks over a box need them.
Window padded_to(const Window& window, const VoxelBox& bricks) {
  const VoxelBox needed = bricks.grown(1 + plane_brick_reach), &own = window.box;
  Window padded(
      {{std::min(needed.lo.x, own.lo.x), std::min(needed.lo.y, own.lo.y), std::min(needed.lo.z, own.lo.z)},
       {std::max(needed.hi.x, own.hi.x), std::max(needed.hi.y, own.hi.y), std::max(needed.hi.z, own.hi.z)}});
  put(window, padded);
  return padded;
}

std::array<float, 3> as_floats(VoxelCoord v) {
  return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}

}  // namespace

PieceVolumes::PieceVolumes(FaceEdges edges) : edges_(edges) {
  entries_.resize(entries_at_first);
  glBindTexture(GL_TEXTURE_2D, entries_texture_.name());
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
  upload_entries(0, static_cast<uint32_t>(entries_.size()));

  glBindVertexArray(array_.name());
  glBindBuffer(GL_ARRAY_BUFFER, instance_buffer_.name());
  const auto attribute = [](GLuint at, GLint count, size_t offset) {
    glEnableVertexAttribArray(at);
    glVertexAttribPointer(at, count, GL_FLOAT, GL_FALSE, sizeof(Instance),
                          reinterpret_cast<const void*>(offset));
    glVertexAttribDivisor(at, 1);
  };
  attribute(0, 4, offsetof(Instance, place));
  attribute(1, 4, offsetof(Instance, rotation));
  attribute(2, 3, offsetof(Instance, centre));
  attribute(3, 3, offsetof(Instance, size));
  attribute(4, 3, offsetof(Instance, origin));
  glEnableVertexAttribArray(5);
  glVertexAttribIPointer(5, 4, GL_INT, sizeof(Instance),
                         reinterpret_cast<const void*>(offsetof(Instance, bricks)));
  glVertexAttribDivisor(5, 1);
  glBindVertexArray(0);
}

void PieceVolumes::update(const Field& field, const ScenePieces& pieces, BrickAtlas& atlas) {
  std::erase_if(stored_, [&](const auto& entry) {
    const auto found = pieces.find(entry.first);
    const bool gone = found == pieces.end() || found->second.volume != entry.second.volume;
    if (gone) drop(entry.second, atlas);
    return gone;
  });
  for (const auto& [id, piece] : pieces)
    if (!stored_.contains(id)) stored_.emplace(id, store(field, piece, atlas));
  upload_instances(pieces);
}

uint32_t PieceVolumes::allocate_run(uint32_t count) {
  const auto size_class = static_cast<size_t>(std::bit_width(count - 1));
  std::vector<uint32_t>& runs = free_runs_[size_class];
  if (!runs.empty()) {
    const uint32_t first = runs.back();
    runs.pop_back();
    return first;
  }
  const uint32_t first = used_;
  used_ += 1U << size_class;
  if (used_ > entries_.size()) {
    entries_.resize(std::bit_ceil(size_t{used_}));
    upload_entries(0, static_cast<uint32_t>(entries_.size()));
  }
  return first;
}

PieceVolumes::Stored PieceVolumes::store(const Field& field, const ScenePiece& piece, BrickAtlas& atlas) {
  const Window& window = piece.volume->window;
  const VoxelBox rock = rock_box(window);
  Stored stored{piece.volume, {}, 0, 0};
  if (rock.empty()) return stored;
  const VoxelCoord first = rock.lo - VoxelCoord{1, 1, 1};
  const VoxelCoord size = rock.hi - first;
  const auto along = [](int voxels) { return (voxels + brick_size - 1) / brick_size; };
  const VoxelCoord bricks{along(size.x), along(size.y), along(size.z)};
  const Window padded =
      padded_to(window, {first, first + first_voxel(BrickCoord{bricks.x, bricks.y, bricks.z})});
  const Window before = gather_generated(field, window.box);
  const LookWindow looks = looks_of(field, *piece.volume);
  stored.count = static_cast<uint32_t>(bricks.x * bricks.y * bricks.z);
  stored.first = allocate_run(stored.count);
  ClipEntry* entry = &entries_[stored.first];
  for (int x = 0; x < bricks.x; ++x)
    for (int y = 0; y < bricks.y; ++y)
      for (int z = 0; z < bricks.z; ++z, ++entry) {
        const VoxelCoord at = first + first_voxel(BrickCoord{x, y, z});
        const AtlasBrick codes = brick_from(window, at);
        const LevelBrick::Kind kind = kind_of(codes);
        *entry = {kind == LevelBrick::Kind::solid ? ClipEntry::solid << 24U : clip_empty, 0, 0, 0};
        if (kind != LevelBrick::Kind::stored) continue;
        if (const auto slot = atlas.add(codes)) entry->field = ClipEntry::packed(ClipEntry::stored, *slot);
        const AtlasBrick generated = brick_from(before, at);
        entry->before = store_before(before_kind_of(generated), generated, atlas);
        entry->looks = store_looks(looks_of(looks, window, at), {}, atlas.looks());
        if (edges_ == FaceEdges::rounded) continue;
        entry->planes = store_planes(planes_of(padded, at).get(), {}, atlas.planes());
      }
  upload_entries(stored.first, stored.count);
  const glm::vec3 centre = piece.volume->centre_voxels - glm::vec3(first.x, first.y, first.z);
  stored.instance.centre = {centre.x, centre.y, centre.z};
  stored.instance.size = as_floats(size);
  stored.instance.origin = as_floats(first);
  stored.instance.bricks = {static_cast<int32_t>(stored.first), bricks.x, bricks.y, bricks.z};
  return stored;
}

void PieceVolumes::drop(const Stored& stored, BrickAtlas& atlas) {
  if (stored.count == 0) return;
  for (uint32_t i = stored.first; i < stored.first + stored.count; ++i) {
    const ClipEntry& entry = entries_[i];
    if (entry.kind() == ClipEntry::stored) atlas.remove(ClipEntry::slot_of(entry.field));
    if (entry.has_before_slot()) atlas.remove(ClipEntry::slot_of(entry.before));
    if (entry.has_looks_slot()) atlas.looks().remove(ClipEntry::slot_of(entry.looks));
    if (entry.has_planes_slot()) atlas.planes().remove(ClipEntry::slot_of(entry.planes));
  }
  free_runs_[static_cast<size_t>(std::bit_width(stored.count - 1))].push_back(stored.first);
}

void PieceVolumes::upload_entries(uint32_t first, uint32_t count) {
  glBindTexture(GL_TEXTURE_2D, entries_texture_.name());
  glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
  const auto rows = static_cast<GLsizei>(entries_.size() / entries_row);
  if (count == entries_.size()) {
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA32UI, entries_row, rows, 0, GL_RGBA_INTEGER, GL_UNSIGNED_INT,
                 entries_.data());
    return;
  }
  const uint32_t top = first / entries_row;
  const uint32_t end = (first + count - 1) / entries_row + 1;
  glTexSubImage2D(GL_TEXTURE_2D, 0, 0, static_cast<GLint>(top), entries_row, static_cast<GLsizei>(end - top),
                  GL_RGBA_INTEGER, GL_UNSIGNED_INT, &entries_[size_t{top} * entries_row]);
}

void PieceVolumes::upload_instances(const ScenePieces& pieces) {
  instances_.clear();
  for (const auto& [id, piece] : pieces) {
    const Stored& stored = stored_.at(id);
    if (stored.count == 0) continue;
    Instance instance = stored.instance;
    const Pose& pose = piece.pose;
    instance.place = {pose.position_m.x, pose.position_m.y, pose.position_m.z, tint_of(id)};
    instance.rotation = {pose.rotation.x, pose.rotation.y, pose.rotation.z, pose.rotation.w};
    instances_.push_back(instance);
  }
  if (instances_.empty()) return;  // WebGL takes a length of nothing for all memory that there is
  glBindBuffer(GL_ARRAY_BUFFER, instance_buffer_.name());
  glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(instances_.size() * sizeof(Instance)),
               instances_.data(), GL_STREAM_DRAW);
}

void PieceVolumes::draw() const {
  if (instances_.empty()) return;
  glBindVertexArray(array_.name());
  glCullFace(GL_FRONT);
  glDrawArraysInstanced(GL_TRIANGLES, 0, 36, static_cast<GLsizei>(instances_.size()));
  glCullFace(GL_BACK);
}

size_t PieceVolumes::gpu_bytes() const {
  return entries_.size() * sizeof(ClipEntry) + instances_.size() * sizeof(Instance);
}

size_t PieceVolumes::cpu_bytes() const {
  return entries_.size() * sizeof(ClipEntry) +
         stored_.size() * (sizeof(Stored) + sizeof(PieceId) + 2 * sizeof(void*));
}

}  // namespace scree
