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

}  // namespace

glm::mat3 inertia_of(const Volume& volume) {
  const VoxelBox& b = volume.window.box;
  const glm::dvec3 centre(volume.centre_voxels);
  const int count = b.size().z;
  const double low_z = b.lo.z - centre.z;
  glm::dvec3 squares(0.0), products(0.0);  // of x, y, z; of yz, xz, xy
  double mass = 0.0;
  const Code* codes = volume.window.codes.data();
  for (int x = b.lo.x; x < b.hi.x; ++x)
    for (int y = b.lo.y; y < b.hi.y; ++y, codes += count) {
      const RowSums sums = sums_of_row(codes, count);
      if (sums.units == 0) continue;
      const auto units = static_cast<double>(sums.units);
      const double off_x = x - centre.x, off_y = y - centre.y;
      const double first_z = static_cast<double>(sums.z) + low_z * units;
      products += glm::dvec3(off_y * first_z, off_x * first_z, off_x * off_y * units);
      squares.x += off_x * off_x * units;
      squares.y += off_y * off_y * units;
      squares.z += static_cast<double>(sums.zz) + low_z * (2.0 * static_cast<double>(sums.z) + low_z * units);
      mass += units;
    }
  CHECK_DEBUG(codes == volume.window.codes.data() + volume.window.codes.size());
  if (mass > 0.0) {
    squares /= mass;
    products /= mass;
  }
  squares += glm::dvec3(1.0 / 12.0);
  const glm::dvec3 moments(squares.y + squares.z, squares.x + squares.z, squares.x + squares.y);
  return glm::mat3(glm::dmat3(moments.x, -products.z, -products.y,  //
                              -products.z, moments.y, -products.x,  //
                              -products.y, -products.x, moments.z));
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
  const glm::dvec3 moments(squares.y + squares.z, squares.x + squares.z, squares.x + squares.y);
  return {glm::vec3(c), glm::mat3(glm::dmat3(moments.x, -products.z, -products.y,  //
                                             -products.z, moments.y, -products.x,  //
                                             -products.y, -products.x, moments.z))};
}

}  // namespace scree
