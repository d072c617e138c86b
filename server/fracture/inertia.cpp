#include "server/fracture/inertia.h"

#include <algorithm>
#include <array>
#include <glm/vec3.hpp>

#include "shared/base/check.h"
#include "shared/field/eight_bytes.h"
#include "shared/field/mass.h"

namespace scree {

namespace {

/// Sums over one row of voxels along z: of their units, and of units times z and times z².
struct RowSums {
  int64_t units = 0;
  int64_t z = 0;
  int64_t zz = 0;
};

/// Voxels whose three sums fit a word side by side, and the sums' first bits: 64 · 254 < 2^16,
/// 254 · Σk < 2^20, 254 · Σk² < 2^25.
constexpr int stretch = 64;
constexpr int z_bit = 16, zz_bit = 36;

constexpr std::array<uint64_t, stretch> make_weights() {
  std::array<uint64_t, stretch> weights{};
  for (uint64_t k = 0; k < stretch; ++k) weights[k] = 1 | k << z_bit | k * k << zz_bit;
  return weights;
}
constexpr std::array<uint64_t, stretch> weights = make_weights();

/// occupancy() by code + 128.
constexpr std::array<uint8_t, 256> make_occupancies() {
  std::array<uint8_t, 256> units{};
  for (int code = -128; code < 128; ++code)
    units[static_cast<size_t>(code + 128)] = static_cast<uint8_t>(occupancy(code));
  return units;
}
constexpr std::array<uint8_t, 256> occupancies = make_occupancies();

/// Whether a row has no mass, as most rows of a piece's window have none; may miss it of short rows.
bool is_empty(const Code* codes, int count) {
  constexpr Code outside = 22;  // the least code of no occupancy
  static_assert(occupancy(outside) == 0 && occupancy(outside - 1) > 0);
  if (count < 8) return false;
  bool mass = any_below(codes + count - 8, outside);
  for (int from = 0; from + 8 < count; from += 8) mass |= any_below(codes + from, outside);
  return !mass;
}

RowSums sums_of_row(const Code* codes, int count) {
  RowSums sums;
  if (is_empty(codes, count)) return sums;
  for (int from = 0; from < count; from += stretch) {
    uint64_t all = 0;
    const int to = std::min(count - from, stretch);
    for (int k = 0; k < to; ++k)
      all += occupancies[static_cast<size_t>(codes[from + k] + 128)] * weights[static_cast<size_t>(k)];
    const auto units = static_cast<int64_t>(all & ((1U << z_bit) - 1));
    const auto first = static_cast<int64_t>((all >> z_bit) & ((1U << (zz_bit - z_bit)) - 1));
    const auto second = static_cast<int64_t>(all >> zz_bit);
    sums.units += units;
    sums.z += first + int64_t{from} * units;
    sums.zz += second + 2 * int64_t{from} * first + int64_t{from} * from * units;
  }
  return sums;
}

/// The end of the voxels of one material that begin at `from`.
int end_of_run(const Material* materials, int from, int count) {
  int to = from + 1;
  while (to < count && materials[to] == materials[from]) ++to;
  return to;
}

/// Moments about a place: mass (units), squares of x, y, z, and products yz, xz, xy.
struct Moments {
  double mass = 0.0;
  glm::dvec3 squares{0.0}, products{0.0};

  void add(double units, const glm::dvec3& at) {
    mass += units;
    squares += units * at * at;
    products += units * glm::dvec3(at.y * at.z, at.x * at.z, at.x * at.y);
  }
};

/// Curvature, in codes, from which on the surface has an edge across that axis: two planes meet within a
/// third of a voxel.
constexpr int edge_bend = 30;
constexpr double codes_a_voxel = 127.0 / 3.0;

/// Where a voxel of the surface has rock, as a part of it: by the ramp about a plane, and about an edge or a
/// corner by the product of two or three. The mass of the field goes by the ramp alone, which has too much at
/// edges.
struct VoxelContent {
  double share = 0.0;
  glm::dvec3 middle{0.0};   ///< of the rock, from the voxel's
  glm::dvec3 thinner{0.0};  ///< by so much its variance is less than a whole voxel's
};

VoxelContent content_of(const Code* at, const std::array<ptrdiff_t, 3>& strides) {
  const double ramp = static_cast<double>(occupancy(*at)) / units_per_voxel;
  glm::dvec3 slopes(0.0);
  std::array<bool, 3> bends{};
  int edges = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const int low = at[-strides[static_cast<size_t>(axis)]], high = at[strides[static_cast<size_t>(axis)]];
    slopes[axis] = std::clamp(0.5 * (high - low) / codes_a_voxel, -1.0, 1.0);
    bends[static_cast<size_t>(axis)] = low + high - 2 * *at > edge_bend;
    edges += bends[static_cast<size_t>(axis)] ? 1 : 0;
  }
  VoxelContent content{ramp, {}, {}};
  for (int axis = 0; axis < 3; ++axis) {
    const bool is_edge = edges > 1 && bends[static_cast<size_t>(axis)];
    const double towards = is_edge ? (slopes[axis] < 0.0 ? -1.0 : 1.0) : slopes[axis];
    content.middle[axis] = -0.5 * towards * (1.0 - ramp);
    content.thinner[axis] = towards * towards * (1.0 - ramp * ramp) / 12.0;
  }
  for (int more = 1; more < edges; ++more) content.share *= ramp;
  return content;
}

/// What the moments of a row of voxels change by where the surface goes through them. `first`: the row's
/// first voxel, from the centre; those at the ends of the row have no neighbours in it.
void mend_surface(const Code* codes, int count, const std::array<ptrdiff_t, 3>& strides,
                  const glm::dvec3& first, Moments& moments) {
  for (int z = 1; z + 1 < count; ++z) {
    const int units = occupancies[static_cast<size_t>(codes[z] + 128)];
    if (units == 0 || units == units_per_voxel) continue;
    const VoxelContent content = content_of(codes + z, strides);
    const glm::dvec3 at(first.x, first.y, first.z + z);
    const double held = content.share * units_per_voxel;
    moments.add(-static_cast<double>(units), at);
    moments.add(held, at + content.middle);
    moments.squares -= held * content.thinner;
  }
}

glm::mat3 tensor_of(const glm::dvec3& squares, const glm::dvec3& products) {
  const glm::dvec3 moments(squares.y + squares.z, squares.x + squares.z, squares.x + squares.y);
  return glm::mat3(glm::dmat3(moments.x, -products.z, -products.y,  //
                              -products.z, moments.y, -products.x,  //
                              -products.y, -products.x, moments.z));
}

}  // namespace

glm::mat3 inertia_of(const Volume& volume) {
  const VoxelBox& b = volume.window.box;
  const VoxelCoord size = b.size();
  const glm::dvec3 centre(volume.centre_voxels);
  const std::array<ptrdiff_t, 3> strides{ptrdiff_t{size.y} * size.z, size.z, 1};
  const double low_z = b.lo.z - centre.z;
  Moments moments;
  const Code* codes = volume.window.codes.data();
  for (int x = b.lo.x; x < b.hi.x; ++x)
    for (int y = b.lo.y; y < b.hi.y; ++y, codes += size.z) {
      const RowSums sums = sums_of_row(codes, size.z);
      if (sums.units == 0) continue;
      const auto units = static_cast<double>(sums.units);
      const double off_x = x - centre.x, off_y = y - centre.y;
      const double first_z = static_cast<double>(sums.z) + low_z * units;
      moments.products += glm::dvec3(off_y * first_z, off_x * first_z, off_x * off_y * units);
      moments.squares.x += off_x * off_x * units;
      moments.squares.y += off_y * off_y * units;
      moments.squares.z +=
          static_cast<double>(sums.zz) + low_z * (2.0 * static_cast<double>(sums.z) + low_z * units);
      moments.mass += units;
      const bool inside = x > b.lo.x && x + 1 < b.hi.x && y > b.lo.y && y + 1 < b.hi.y;
      if (inside) mend_surface(codes, size.z, strides, {off_x, off_y, low_z}, moments);
    }
  CHECK_DEBUG(codes == volume.window.codes.data() + volume.window.codes.size());
  const double mass = std::max(moments.mass, 1.0);
  return tensor_of(moments.squares / mass + 1.0 / 12.0, moments.products / mass);
}

WeightedInertia weighted_inertia_of(const Volume& volume, std::span<const float, 256> densities) {
  CHECK(!volume.materials.is_uniform());
  const VoxelBox& b = volume.window.box;
  const glm::dvec3 origin(volume.centre_voxels);
  const int count = b.size().z;
  const double low_z = b.lo.z - origin.z;
  glm::dvec3 moment(0.0), squares(0.0), products(0.0);
  double mass = 0.0;
  const Code* codes = volume.window.codes.data();
  const Material* materials = volume.materials.each.data();
  for (int x = b.lo.x; x < b.hi.x; ++x)
    for (int y = b.lo.y; y < b.hi.y; ++y, codes += count, materials += count) {
      if (is_empty(codes, count)) continue;
      const double off_x = x - origin.x, off_y = y - origin.y;
      for (int from = 0, to = 0; from < count; from = to) {
        to = end_of_run(materials, from, count);
        const RowSums sums = sums_of_row(codes + from, to - from);
        if (sums.units == 0) continue;
        const auto density = static_cast<double>(densities[row_number(materials[from])]);
        const double weight = density * static_cast<double>(sums.units), first_z = low_z + from;
        const double along_z = density * static_cast<double>(sums.z) + first_z * weight;
        mass += weight;
        moment += glm::dvec3(off_x * weight, off_y * weight, along_z);
        products += glm::dvec3(off_y * along_z, off_x * along_z, off_x * off_y * weight);
        squares.x += off_x * off_x * weight;
        squares.y += off_y * off_y * weight;
        squares.z += density * static_cast<double>(sums.zz) +
                     first_z * (2.0 * density * static_cast<double>(sums.z) + first_z * weight);
      }
    }
  CHECK(mass > 0.0);
  const glm::dvec3 c = moment / mass;
  squares = squares / mass - c * c + glm::dvec3(1.0 / 12.0);
  products = products / mass - glm::dvec3(c.y * c.z, c.x * c.z, c.x * c.y);
  return {glm::vec3(c), tensor_of(squares, products)};
}

}  // namespace scree
