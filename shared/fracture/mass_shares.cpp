#include "shared/fracture/mass_shares.h"

#include <algorithm>
#include <climits>
#include <cstdint>
#include <cstring>

#include "shared/base/check.h"
#include "shared/base/limits.h"
#include "shared/base/vector_clones.h"
#include "shared/field/eight_bytes.h"

namespace scree {

namespace {

/// A row of as many voxels as are shared out at a time, in vectors.
using ShareFloats = float __attribute__((vector_size(32)));
using ShareInts = int __attribute__((vector_size(32)));
using ShareBytes = uint8_t __attribute__((vector_size(8)));
using ShareClaims = uint16_t __attribute__((vector_size(16)));
constexpr size_t share_lanes = cut_width;
static_assert(sizeof(ShareFloats) == share_lanes * sizeof(float));

// The moments of a slice fit an int.
static_assert(int64_t{limits::window_side_max} * limits::window_side_max * limits::window_side_max *
                  UINT8_MAX <=
              INT_MAX);

/// Where rows along z lie in the whole.
struct RowPlaces {
  VoxelCoord low;  ///< the whole's low corner
  size_t step_x, step_y;

  explicit RowPlaces(const VoxelBox& whole)
      : low(whole.lo),
        step_x(static_cast<size_t>(whole.size().y) * static_cast<size_t>(whole.size().z)),
        step_y(static_cast<size_t>(whole.size().z)) {}

  /// The index of a row's first voxel.
  size_t index(VoxelCoord first) const {
    const VoxelCoord off = first - low;
    return static_cast<size_t>(off.x) * step_x + static_cast<size_t>(off.y) * step_y +
           static_cast<size_t>(off.z);
  }
};

/// Mass that is shared out, voxel by voxel in the whole's order, with room for a vector behind the last.
struct SharedMass {
  std::vector<uint8_t> lost;
  std::vector<uint8_t> left;     ///< of it, that no part has got yet
  std::vector<uint16_t> claims;  ///< sums of the parts' shares

  explicit SharedMass(const std::vector<uint8_t>& all) : lost(all), claims(all.size() + share_lanes) {
    lost.resize(claims.size());
    left = lost;
  }
};

void claim(const RowPlaces& places, const CellPart& part, SharedMass& shared) {
  for (const SharedRow& row : part.shares) {
    uint16_t* const to = shared.claims.data() + places.index(row.first);
    ShareBytes own;
    ShareClaims sum;
    std::memcpy(&own, row.within.data(), sizeof(own));
    std::memcpy(&sum, to, sizeof(sum));
    sum += __builtin_convertvector(own, ShareClaims);
    for (size_t lane = 0; lane < share_lanes; ++lane) CHECK_DEBUG(sum[lane] >= own[lane]);
    std::memcpy(to, &sum, sizeof(sum));
  }
}

/// ⌊lost · own / claims⌋, 0 where nothing is claimed. In floats: the product is exact, and of quotients that
/// are below 256, by divisors below 2^16, none is rounded up to the next whole number.
SCREE_INLINE void share_of(const ShareBytes& lost, const ShareBytes& own, const ShareClaims& claims,
                           ShareInts& share) {
  const ShareFloats product =
      __builtin_convertvector(lost, ShareFloats) * __builtin_convertvector(own, ShareFloats);
  const ShareFloats divisor =
      __builtin_convertvector(claims | reinterpret_cast<ShareClaims>(claims == uint16_t{0}), ShareFloats);
  share = __builtin_convertvector(product / divisor, ShareInts);
}

int64_t sum_of(const ShareInts& each) {
  int64_t sum = 0;
  for (size_t lane = 0; lane < share_lanes; ++lane) sum += each[lane];
  return sum;
}

/// Gives the part its share of the voxels that it claimed.
SCREE_VECTOR_CLONES void assign_share(const RowPlaces& places, const CellPart& part, SharedMass& shared,
                                      PartMass& mass) {
  const ShareInts numbers = {0, 1, 2, 3, 4, 5, 6, 7};
  const auto end = part.shares.end();
  for (auto row = part.shares.begin(); row != end;) {
    ShareInts units{}, by_y{}, by_z{};  // of a slice
    const int x = row->first.x;
    for (; row != end && row->first.x == x; ++row) {
      const size_t at = places.index(row->first);
      ShareBytes own, lost, left;
      std::memcpy(&own, row->within.data(), sizeof(own));
      if (all_zero(&shared.lost[at])) continue;
      std::memcpy(&lost, &shared.lost[at], sizeof(lost));
      std::memcpy(&left, &shared.left[at], sizeof(left));
      ShareClaims claims;
      std::memcpy(&claims, &shared.claims[at], sizeof(claims));
      ShareInts share;
      share_of(lost, own, claims, share);
      for (size_t lane = 0; lane < share_lanes; ++lane) CHECK_DEBUG(share[lane] <= left[lane]);
      left -= __builtin_convertvector(share, ShareBytes);
      std::memcpy(&shared.left[at], &left, sizeof(left));
      units += share;
      by_y += share * (row->first.y - places.low.y);
      by_z += share * (numbers + (row->first.z - places.low.z));
    }
    const int64_t all = sum_of(units);
    mass.mass += all;
    mass.x += all * (x - places.low.x);
    mass.y += sum_of(by_y);
    mass.z += sum_of(by_z);
  }
}

/// Mass that nobody claimed, or that rounding left over, goes to the nearest part.
void give_rest(const VoxelCoord& size, const NearestParts& nearest, const std::vector<uint8_t>& left,
               std::vector<PartMass>& masses) {
  size_t row = 0;
  for (int x = 0; x < size.x; ++x)
    for (int y = 0; y < size.y; ++y, row += static_cast<size_t>(size.z))
      for (int from = 0; from < size.z; from += cut_width) {
        if (all_zero(&left[row + static_cast<size_t>(from)])) continue;
        for (int z = from; z < std::min(from + cut_width, size.z); ++z) {
          const size_t at = row + static_cast<size_t>(z);
          const MassUnits units = left[at];
          PartMass& part = masses[nearest.parts[nearest.cells[at]]];
          part.mass += units;
          part.x += units * x;
          part.y += units * y;
          part.z += units * z;
        }
      }
}

}  // namespace

std::vector<PartMass> share_out(const VoxelBox& box, const std::vector<uint8_t>& lost,
                                const NearestParts& nearest, const std::vector<CellPart>& parts) {
  const VoxelCoord size = box.size();
  CHECK_EQ(lost.size(), Window::count(box));
  CHECK_EQ(nearest.cells.size(), lost.size());
  CHECK(std::max({size.x, size.y, size.z}) <= limits::window_side_max);
  SharedMass shared(lost);
  const RowPlaces places(box);
  for (const CellPart& part : parts) {
    CHECK(box.covers(part.window.box));
    claim(places, part, shared);
  }
  std::vector<PartMass> masses(parts.size());
  for (size_t i = 0; i < parts.size(); ++i) assign_share(places, parts[i], shared, masses[i]);
  give_rest(size, nearest, shared.left, masses);
  return masses;
}

}  // namespace scree
