#include "client/render/bricks/brick_world.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <glm/common.hpp>
#include <glm/gtc/type_ptr.hpp>

#include "client/render/scene/limits.h"
#include "shared/base/check.h"

namespace scree {
namespace {

/// As client/shaders/bricks.glsl declares its arrays.
constexpr size_t levels_max = 8;

/// The border of client/shaders/bricks.glsl, and one more for rounding.
constexpr int border_bricks = 3;

/// The finest level reaches two thirds of the view radius at least: beyond, a pixel is hardly smaller than
/// its voxels.
int side_for(float view_radius_m, float brick_m) {
  const auto bricks = static_cast<unsigned>(std::ceil(view_radius_m * (4.0F / 3.0F) / brick_m));
  return std::clamp(static_cast<int>(std::bit_ceil(bricks)), 16, 64);
}

size_t levels_for(float half_m, float horizon_m) {
  size_t levels = 1;
  while (levels < levels_max && half_m < horizon_m) {
    half_m *= 2.0F;
    ++levels;
  }
  return levels;
}

float brick_m(const TerrainSource& source) {
  return source.voxel_size_m * static_cast<float>(brick_size);
}

size_t bricks_for(int side, size_t levels) {
  return static_cast<size_t>(side) * static_cast<size_t>(side) * (limits::bricks_per_column * levels);
}

}  // namespace

BrickWorld::BrickWorld(WorkPool& pool, const TerrainSource& source, float view_radius_m, FaceEdges edges)
    : atlas_(bricks_for(side_for(view_radius_m, brick_m(source)), 4)),
      side_(side_for(view_radius_m, brick_m(source))) {
  const float half_m = brick_m(source) * static_cast<float>(side_) * 0.5F;
  const size_t levels = levels_for(half_m, view_radius_m * limits::horizon_per_view_radius);
  for (size_t i = 0; i < levels; ++i) levels_.emplace_back(pool, source, static_cast<int>(i), side_, edges);
  glBindTexture(GL_TEXTURE_3D, entries_.name());
  const std::vector<ClipEntry> unloaded(static_cast<size_t>(side_ * side_) * static_cast<size_t>(side_ / 2) *
                                        levels);
  glTexImage3D(GL_TEXTURE_3D, 0, GL_RGBA32UI, side_, side_ / 2 * static_cast<int>(levels), side_, 0,
               GL_RGBA_INTEGER, GL_UNSIGNED_INT, unloaded.data());
  glTexParameteri(GL_TEXTURE_3D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  glTexParameteri(GL_TEXTURE_3D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
}

void BrickWorld::update(const Field& field, const std::vector<BrickCoord>& changed, glm::vec3 eye_m) {
  size_t left = limits::chunks_read_max;
  // The coarsest first: it is shown where a finer one is not loaded yet.
  for (size_t i = levels_.size(); i-- > 0;) {
    ClipLevel& level = levels_[i];
    level.follow(eye_m, atlas_);
    if (!changed.empty()) level.changed(field, changed, atlas_);
    left -= level.load(field, left, atlas_);
    level.window().settle();
    upload_entries(level);
  }
}

void BrickWorld::upload_entries(ClipLevel& level) {
  glBindTexture(GL_TEXTURE_3D, entries_.name());
  glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
  level.window().drain_changed_slabs([&](int x, const ClipEntry* entries) {
    glTexSubImage3D(GL_TEXTURE_3D, 0, 0, side_ / 2 * level.level(), x, side_, side_ / 2, 1, GL_RGBA_INTEGER,
                    GL_UNSIGNED_INT, entries);
  });
}

void BrickWorld::use(const gl::Program& program, glm::vec3 eye_m) const {
  std::array<glm::vec3, levels_max> eye_in{};
  std::array<glm::ivec3, levels_max> wrap{};
  std::array<float, levels_max> per_m{};
  for (size_t i = 0; i < levels_.size(); ++i) {
    const double voxel = static_cast<double>(levels_[i].voxel_m());
    const BrickCoord origin = levels_[i].window().origin();
    const VoxelCoord first = first_voxel(origin);
    eye_in[i] = glm::vec3(glm::dvec3(eye_m) / voxel - glm::dvec3(first.x, first.y, first.z));
    wrap[i] = {origin.x & (side_ - 1), origin.y & (side_ / 2 - 1), origin.z & (side_ - 1)};
    per_m[i] = static_cast<float>(1.0 / voxel);
  }
  const auto count = static_cast<GLsizei>(levels_.size());
  glUniform3fv(program.uniform("u_eye_in"), count, glm::value_ptr(eye_in[0]));
  glUniform3iv(program.uniform("u_wrap"), count, glm::value_ptr(wrap[0]));
  glUniform1fv(program.uniform("u_voxels_per_m"), count, per_m.data());
  program.set("u_levels", static_cast<int>(count));
  glUniform3i(program.uniform("u_window"), side_, side_ / 2, side_);
  const auto [width, height, depth] = atlas_.size();
  program.set("u_atlas_texel", 1.0F / glm::vec3(width, height, depth));
  program.set("u_entries", 0);
  program.set("u_atlas", 1);
  program.set("u_looks", looks_unit);
  program.set("u_planes", planes_unit);
  glActiveTexture(GL_TEXTURE0);
  glBindTexture(GL_TEXTURE_3D, entries_.name());
  glActiveTexture(GL_TEXTURE1);
  glBindTexture(GL_TEXTURE_3D, atlas_.texture());
  glActiveTexture(GL_TEXTURE0 + looks_unit);
  glBindTexture(GL_TEXTURE_3D, atlas_.looks().texture());
  glActiveTexture(GL_TEXTURE0 + planes_unit);
  glBindTexture(GL_TEXTURE_3D, atlas_.planes().texture());
  glActiveTexture(GL_TEXTURE0);
}

std::optional<BrickWorld::Plain> BrickWorld::plain(glm::vec3 lo_m, glm::vec3 hi_m, int level) const {
  if (level >= static_cast<int>(levels_.size())) return std::nullopt;
  const ClipLevel& shown = levels_[static_cast<size_t>(level)];
  const ClipWindow& window = shown.window();
  // A box that ends where a brick begins does not reach into it.
  constexpr float end_voxels = 1e-3F;
  const glm::ivec3 lo(glm::floor((lo_m / shown.voxel_m() + end_voxels) / static_cast<float>(brick_size)));
  const glm::ivec3 hi(glm::floor((hi_m / shown.voxel_m() - end_voxels) / static_cast<float>(brick_size)));
  // Near the window's end the next level shows (client/shaders/bricks.glsl).
  const BrickCoord margin{border_bricks, border_bricks, border_bricks};
  if (!window.holds(BrickCoord{lo.x, lo.y, lo.z} - margin) ||
      !window.holds(BrickCoord{hi.x, hi.y, hi.z} + margin))
    return std::nullopt;
  std::optional<Plain> found;
  for (int x = lo.x; x <= hi.x; ++x)
    for (int y = lo.y; y <= hi.y; ++y)
      for (int z = lo.z; z <= hi.z; ++z) {
        const ClipEntry& entry = window.at({x, y, z});
        const bool rock = entry.kind() == ClipEntry::solid;
        if (!rock && !entry.is_empty()) return std::nullopt;
        const Plain kind = rock ? Plain::rock : Plain::air;
        if (found && *found != kind) return std::nullopt;
        found = kind;
      }
  return found;
}

bool BrickWorld::is_untouched() const {
  return std::ranges::all_of(levels_, [](const ClipLevel& level) { return level.window().touched() == 0; });
}

size_t BrickWorld::waiting() const {
  size_t sum = 0;
  for (const ClipLevel& level : levels_) sum += level.waiting();
  return sum;
}

float BrickWorld::reach_m() const {
  return levels_.back().voxel_m() * static_cast<float>((side_ / 2 - chunk_bricks) * brick_size);
}

MemoryCounts BrickWorld::memory() const {
  const size_t entries = static_cast<size_t>(side_ * side_) * static_cast<size_t>(side_ / 2) * levels_.size();
  size_t cpu_bytes = 0;
  for (const ClipLevel& level : levels_) cpu_bytes += level.cpu_bytes();
  return {{"atlas", 0, atlas_.bytes()}, {"windows", cpu_bytes, entries * sizeof(ClipEntry)}};
}

}  // namespace scree
