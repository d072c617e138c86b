#include "client/render/details/scatter.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <utility>

#include "client/render/details/ground_cover.h"
#include "client/render/levels/block_windows.h"
#include "client/render/levels/look_window.h"
#include "shared/field/voxel_vector.h"

namespace scree {
namespace {

/// Side of the square that has one detail at the most: as dense as tufts of grass stand.
constexpr float cell_m = 0.4F;

/// A row of random numbers, by a place.
class Draws {
 public:
  explicit Draws(VoxelCoord place) : bits_(mixed_bits(place)) {}
  /// The next one, 0 to 1.
  float next() {
    bits_ = (bits_ ^ (bits_ >> 30U)) * 0xBF58476D1CE4E5B9ULL;
    bits_ ^= bits_ >> 27U;
    return static_cast<float>(bits_ >> 40U) / 16777216.0F;
  }

 private:
  uint64_t bits_;
};

/// Where a column, at a place between voxels, leaves the rock for the air above it.
struct Surface {
  glm::vec3 place;  ///< voxels
  glm::vec3 normal;
  VoxelCoord cell;  ///< around it
};

/// Codes at a height of voxels, between its four columns.
float code_between(const Window& window, float x, int y, float z) {
  const int i = floor_to_int(x), k = floor_to_int(z);
  const float fx = x - static_cast<float>(i), fz = z - static_cast<float>(k);
  const auto code = [&](int dx, int dz) { return static_cast<float>(window.at(i + dx, y, k + dz)); };
  return glm::mix(glm::mix(code(0, 0), code(1, 0), fx), glm::mix(code(0, 1), code(1, 1), fx), fz);
}

std::optional<Surface> surface_at(const Window& window, float x, float z) {
  const VoxelBox& box = window.box;
  const int i = floor_to_int(x), k = floor_to_int(z);
  for (int y = box.hi.y - 2; y >= box.lo.y; --y) {
    if (window.at(i, y, k) == code_air) continue;
    const float below = code_between(window, x, y, z), above = code_between(window, x, y + 1, z);
    if (below >= 0.0F || above < 0.0F) continue;
    const float part = below / (below - above);
    const auto row = static_cast<float>(part < 0.5F ? 0 : 1);
    const int near = y + static_cast<int>(row);
    const float fx = x - static_cast<float>(i), fz = z - static_cast<float>(k);
    const auto code = [&](int dx, int dz) { return static_cast<float>(window.at(i + dx, near, k + dz)); };
    const glm::vec3 slope(glm::mix(code(1, 0) - code(0, 0), code(1, 1) - code(0, 1), fz), above - below,
                          glm::mix(code(0, 1) - code(0, 0), code(1, 1) - code(1, 0), fx));
    return Surface{{x, static_cast<float>(y) + part, z}, glm::normalize(slope), {i, y, k}};
  }
  return std::nullopt;
}

uint8_t as_byte(float part) {
  return static_cast<uint8_t>(255.0F * std::clamp(part, 0.0F, 1.0F) + 0.5F);
}
int8_t as_signed(float part) {
  return static_cast<int8_t>(std::lround(127.0F * std::clamp(part, -1.0F, 1.0F)));
}

void set_colour(Detail& detail, glm::vec3 linear) {
  for (int i = 0; i < 3; ++i) detail.colour.at(static_cast<size_t>(i)) = as_byte(std::sqrt(linear[i]));
}

/// Stands upright, turned about its axis.
void stand(Detail& detail, glm::vec3 normal, float turn, float seen) {
  detail.turn = {as_signed(2.0F * turn - 1.0F), as_signed(normal.x), as_signed(normal.z), as_signed(seen)};
}

/// Turned any way (Shoemake 1992), its fourth number not below zero.
void tumble(Detail& detail, Draws& draws, float seen) {
  const float a = draws.next(), b = 6.2831853F * draws.next(), c = 6.2831853F * draws.next();
  const glm::vec3 axis(std::sqrt(1.0F - a) * std::sin(b), std::sqrt(1.0F - a) * std::cos(b),
                       std::sqrt(a) * std::sin(c));
  const float sign = std::cos(c) < 0.0F ? -1.0F : 1.0F;
  detail.turn = {as_signed(sign * axis.x), as_signed(sign * axis.y), as_signed(sign * axis.z),
                 as_signed(seen)};
}

constexpr glm::vec3 grass_green{0.205F, 0.228F, 0.085F};
constexpr glm::vec3 grass_dry{0.47F, 0.37F, 0.19F};
constexpr glm::vec3 leaf_green{0.150F, 0.180F, 0.075F};
constexpr glm::vec3 leaf_dry{0.27F, 0.22F, 0.12F};

PlacedDetail grass_of(const Surface& ground, const GroundCover& cover, Draws& draws) {
  PlacedDetail made;
  made.kind = DetailKind::grass;
  const float dry = std::clamp(1.08F - cover.green + 0.7F * (draws.next() - 0.5F), 0.0F, 1.0F);
  made.detail.size_m = (0.26F + 0.30F * draws.next() * draws.next()) * (0.65F + 0.35F * cover.green);
  set_colour(made.detail, glm::mix(grass_green, grass_dry, dry) * (0.75F + 0.5F * cover.fine));
  stand(made.detail, ground.normal, draws.next(), 0.35F + 0.65F * std::sqrt(draws.next()));
  return made;
}

PlacedDetail bush_of(const Surface& ground, const GroundCover& cover, Draws& draws) {
  PlacedDetail made;
  made.kind = DetailKind::bush;
  made.detail.size_m = 0.45F + 0.75F * draws.next() * draws.next();
  set_colour(made.detail,
             glm::mix(leaf_green, leaf_dry, draws.next() * draws.next()) * (0.7F + 0.6F * cover.fine));
  stand(made.detail, ground.normal, draws.next(), 1.0F);
  return made;
}

PlacedDetail stone_of(const GroundCover& cover, Draws& draws) {
  PlacedDetail made;
  made.kind = DetailKind::stone;
  // A tenth of the size is a hundred times as frequent (Hartmann 1969, of broken rock).
  const float size = draws.next();
  made.detail.size_m = std::min(0.07F / std::sqrt(1.0F - size), 0.5F);
  set_colour(made.detail, glm::vec3(0.5F * (0.75F + 0.5F * cover.fine)));
  tumble(made.detail, draws, std::clamp(0.3F + 1.6F * made.detail.size_m, 0.0F, 1.0F));
  return made;
}

/// What a place has, or nothing, by how the ground is there.
std::optional<PlacedDetail> detail_on(const Surface& ground, const GroundCover& cover, Draws& draws) {
  const float open = 1.0F - cover.snow;
  const float scrub = cover.flat * cover.green * open, sand = cover.flat * (1.0F - cover.green) * open;
  const float ledge = (1.0F - cover.flat) * glm::smoothstep(0.35F, 0.6F, ground.normal.y);
  float chance = draws.next();
  const auto is = [&](float share) {
    chance -= share;
    return chance < 0.0F;
  };
  if (is(0.012F * scrub + 0.002F * sand)) return bush_of(ground, cover, draws);
  if (is(0.060F * sand + 0.014F * scrub + 0.06F * ledge)) return stone_of(cover, draws);
  if (is(0.92F * scrub + 0.03F * sand)) return grass_of(ground, cover, draws);
  return std::nullopt;
}

/// Whether all of a chunk is air, or all rock, by its heights alone.
bool is_beyond_ground(const TerrainSource& source, ChunkCoord chunk) {
  const float side_m = static_cast<float>(chunk_size) * source.voxel_size_m;
  const float low_m = static_cast<float>(chunk.y) * side_m;
  return low_m > top_m(source) || low_m + side_m < floor_m(source);
}

VoxelBox box_of_chunk(ChunkCoord chunk) {
  const VoxelCoord first = first_voxel(chunk);
  return {first, first + VoxelCoord{chunk_size, chunk_size + 1, chunk_size}};
}

/// Codes of the field one after another, of which many lie in one brick. What would have to be generated is
/// air.
class NearCodes {
 public:
  explicit NearCodes(const Field& field) : field_(field) {}
  Code at(VoxelCoord voxel) {
    const BrickCoord home = brick_of(voxel);
    if (brick_ == nullptr || home != home_) {
      home_ = home;
      const ChunkCoord chunk = chunk_of(home);
      if (!chunk_ || *chunk_ != chunk) {
        chunk_ = chunk;
        is_here_ = field_.has_generated(chunk);
      }
      brick_ = is_here_ ? &field_.brick(home) : &air_brick();
    }
    return brick_->codes[static_cast<size_t>(Brick::index(voxel.x & 7, voxel.y & 7, voxel.z & 7))];
  }

 private:
  const Field& field_;
  BrickCoord home_;
  const Brick* brick_ = nullptr;
  std::optional<ChunkCoord> chunk_;
  bool is_here_ = false;
};

/// Whether a way from there, in voxels, is free of rock.
bool is_free(NearCodes& codes, glm::vec3 from, glm::vec3 direction, float far) {
  constexpr float least_step = 0.7F;
  for (float along = 0.0F; along < far;) {
    const glm::vec3 at = from + direction * along + 0.5F;
    const Code code = codes.at({floor_to_int(at.x), floor_to_int(at.y), floor_to_int(at.z)});
    if (code < 0) return false;
    along += std::max(decode(code) * 0.9F, least_step);
  }
  return true;
}

}  // namespace

bool can_scatter(const Field& field, ChunkCoord chunk) {
  const auto is_known = [&](ChunkCoord at) {
    return is_beyond_ground(field.source(), at) || field.has_generated(at);
  };
  return is_known(chunk) && is_known({chunk.x, chunk.y + 1, chunk.z});
}

std::vector<PlacedDetail> scatter_details(const Field& field, ChunkCoord chunk) {
  std::vector<PlacedDetail> placed;
  const TerrainSource& source = field.source();
  // All is air, or all is rock: a surface would have codes between them.
  if (is_beyond_ground(source, chunk) || field.chunk_bricks(chunk).generated.stored == 0) return placed;
  const VoxelBox box = box_of_chunk(chunk);
  const Window window = gather_generated(field, box);
  const float voxel_m = source.voxel_size_m;
  const int side = std::max(static_cast<int>(cell_m / voxel_m + 0.5F), 1);
  for (int x = box.lo.x; x < box.hi.x - 1; x += side)
    for (int z = box.lo.z; z < box.hi.z - 1; z += side) {
      Draws draws({x, chunk.y, z});
      // Within the columns that the window has.
      const auto within = [&](int lo, int hi) {
        const auto room = static_cast<float>(std::min(side, hi - 1 - lo));
        return static_cast<float>(lo) + room * 0.999F * draws.next();
      };
      const float at_x = within(x, box.hi.x), at_z = within(z, box.hi.z);
      const std::optional<Surface> ground = surface_at(window, at_x, at_z);
      if (!ground) continue;
      const glm::vec3 place_m = ground->place * voxel_m;
      const GroundCover cover = ground_cover(place_m, ground->normal, layers_of(source).ice_above_m);
      std::optional<PlacedDetail> made = detail_on(*ground, cover, draws);
      if (!made) continue;
      made->detail.place_m = place_m;
      made->cell = ground->cell;
      placed.push_back(*made);
    }
  std::ranges::sort(placed, std::ranges::greater(),
                    [](const PlacedDetail& one) { return std::pair(one.detail.turn[3], one.cell); });
  return placed;
}

bool check_standing(const Field& field, ChunkCoord chunk, std::vector<PlacedDetail>& placed) {
  const ChunkCoord above{chunk.x, chunk.y + 1, chunk.z};
  const VoxelBox box = box_of_chunk(chunk);
  const bool edited = field.has_edits(chunk) || field.has_edits(above);
  const bool painted = edited || stores_materials(field, box);
  std::optional<LookWindow> looks;
  std::optional<Window> now, before;
  if (painted && !placed.empty()) looks = gather_looks(field, field, 0, box);
  if (edited && !placed.empty()) {
    now = gather(field, box);
    before = gather_generated(field, box);
  }
  bool changed = false;
  for (PlacedDetail& one : placed) {
    bool stands = true;
    for (int i = 0; i < 8 && stands; ++i) {
      const VoxelCoord at = one.cell + VoxelCoord{i >> 2, (i >> 1) & 1, i & 1};
      if (now && now->at(at.x, at.y, at.z) != before->at(at.x, at.y, at.z)) stands = false;
      if (looks && looks->at(at).shown != 0) stands = false;
    }
    changed = changed || stands != one.stands;
    one.stands = stands;
  }
  return changed;
}

bool light_detail(const Field& field, glm::vec3 sun, PlacedDetail& placed) {
  /// Farther, metres, a shade is of something that the eye does not connect with it; and that hides much sky.
  constexpr float shade_m = 32.0F, roof_m = 5.0F;
  constexpr std::array<glm::vec3, 5> up{glm::vec3{0.0F, 1.0F, 0.0F}, glm::vec3{0.7F, 0.7F, 0.1F},
                                        glm::vec3{-0.7F, 0.7F, -0.1F}, glm::vec3{-0.1F, 0.7F, 0.7F},
                                        glm::vec3{0.1F, 0.7F, -0.7F}};
  const float voxel_m = field.source().voxel_size_m;
  const glm::vec3 from = placed.detail.place_m / voxel_m + glm::vec3(0.0F, 1.0F, 0.0F);
  NearCodes codes(field);
  const unsigned lit = is_free(codes, from + sun * 0.5F, sun, shade_m / voxel_m) ? 15 : 0;
  unsigned open = 0;
  for (const glm::vec3& way : up)
    if (is_free(codes, from, way, roof_m / voxel_m)) open += 3;
  const auto light = static_cast<uint8_t>(lit * 16 + open);
  const bool changed = light != placed.detail.colour[3];
  placed.detail.colour[3] = light;
  return changed;
}

}  // namespace scree
