#include "shared/fracture/cell_cut.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <glm/geometric.hpp>

#include "shared/base/check.h"
#include "shared/base/vector_clones.h"
#include "shared/field/occupancy_byte.h"

namespace scree {

namespace {

/// The plane half-way between two seeds, as distance(v) = offset + dot(normal, v); positive beyond it.
struct Bisector {
  glm::vec3 normal;
  float offset;

  Bisector(glm::vec3 own, glm::vec3 other) {
    const glm::vec3 along = other - own;
    CHECK_DEBUG(glm::dot(along, along) > 0.0F);
    normal = along / std::sqrt(glm::dot(along, along));
    offset = -glm::dot(normal, (own + other) * 0.5F);
  }
};

/// A row of as many voxels as are cut at a time, in vectors, spelt out. Left to itself the compiler did these
/// loops, the dearest of a carve, one voxel at a time.
using Lanes = float __attribute__((vector_size(32)));
using IntLanes = int __attribute__((vector_size(32)));
using CodeLanes = Code __attribute__((vector_size(8)));
constexpr size_t lanes = cut_width;
static_assert(sizeof(Lanes) == lanes * sizeof(float));

/// Far inside every plane, voxels.
constexpr float deep_inside = -2.0F * band_voxels;

/// encode() of each, not yet as bytes.
SCREE_INLINE void encode_row(const Lanes& distances, IntLanes& codes) {
  const Lanes scaled = distances * codes_per_voxel;
  const Lanes low = scaled > -127.0F ? scaled : Lanes{} - 127.0F;
  const Lanes clamped = low < 127.0F ? low : Lanes{} + 127.0F;
  codes = __builtin_convertvector(clamped + (clamped < 0.0F ? Lanes{} - 0.5F : Lanes{} + 0.5F), IntLanes);
}

/// The distances of a row's voxels from a plane, beyond that of the first.
struct alignas(SCREE_CLONES_ALIGNMENT) PlaneSlope {
  Lanes along;
};

/// Rows that are cut together: a plane is loaded once for them, and none waits for another.
constexpr size_t rows_together = 4;

/// A value of each voxel of such rows. Arrays of bytes are told apart from the vectors that hold them, or
/// loops over them would be none of vectors.
using Codes = std::array<Code, rows_together * lanes>;
using Shares = std::array<uint8_t, rows_together * lanes>;

SCREE_INLINE void narrow_all(const int* __restrict from, Code* __restrict codes) {
  for (size_t i = 0; i < Codes().size(); ++i) codes[i] = static_cast<Code>(from[i]);
}

SCREE_INLINE void occupancies_of(const Code* __restrict codes, uint8_t* __restrict units) {
  for (size_t i = 0; i < Codes().size(); ++i) units[i] = occupancy_byte(codes[i]);
}

/// The planes of a part, and the rows of one slice of its window across x, each cut_width voxels long.
/// Distances from a plane grow evenly along a row: those at the first voxels are told once for all rows.
class PlaneRows {
 public:
  void set(const CellBounds& part) {
    const VoxelBox& box = part.box;
    own_ = part.own.size();
    rows_ = static_cast<size_t>(box.size().y) * ((static_cast<size_t>(box.size().z) + lanes - 1) / lanes);
    padded_ = (rows_ + lanes - 1) / lanes * lanes;
    planes_.clear();
    for (const glm::vec3& other : part.neighbours)
      for (const glm::vec3& seed : part.own) planes_.emplace_back(seed, other);
    const Lanes steps = {0.0F, 1.0F, 2.0F, 3.0F, 4.0F, 5.0F, 6.0F, 7.0F};
    slopes_.clear();
    for (const Bisector& plane : planes_) slopes_.push_back({plane.normal.z * steps});
    y_.assign(padded_, 0.0F);
    z_.assign(padded_, 0.0F);
    size_t row = 0;
    for (int y = box.lo.y; y < box.hi.y; ++y)
      for (int z = box.lo.z; z < box.hi.z; z += cut_width, ++row) {
        y_[row] = static_cast<float>(y);
        z_[row] = static_cast<float>(z);
      }
    bases_.resize(planes_.size() * padded_);
  }

  size_t rows() const { return rows_; }

  /// Turns to the slice at that x.
  SCREE_INLINE void turn_to(float x) {
    float* to = bases_.data();
    for (const Bisector& plane : planes_) {
      const float at_x = plane.normal.x * x;
      for (size_t row = 0; row < padded_; row += lanes, to += lanes) {
        Lanes y, z;
        std::memcpy(&y, &y_[row], sizeof(y));
        std::memcpy(&z, &z_[row], sizeof(z));
        const Lanes base = plane.offset + ((at_x + plane.normal.y * y) + plane.normal.z * z);
        std::memcpy(to, &base, sizeof(base));
      }
    }
  }

  /// Codes of the distances beyond the farthest of the bisectors, the nearest over the own seeds of each
  /// neighbour, of the voxels of some rows: rows_together of them.
  SCREE_INLINE void cut(const uint32_t* rows, Codes& codes) const {
    if (own_ == 1)
      cut_by<true>(rows, codes);
    else
      cut_by<false>(rows, codes);
  }

 private:
  template <bool one_seed>
  SCREE_INLINE void cut_by(const uint32_t* rows, Codes& codes) const {
    Lanes farthest[rows_together];
    for (Lanes& row : farthest) row = Lanes{} + deep_inside;
    const float* base = bases_.data();
    for (size_t p = 0; p < planes_.size(); p += own_) {
      Lanes near[rows_together];
      const Lanes along = slopes_[p].along;
      for (size_t i = 0; i < rows_together; ++i) near[i] = base[rows[i]] + along;
      base += padded_;
      for (size_t k = 1; !one_seed && k < own_; ++k, base += padded_)
        for (size_t i = 0; i < rows_together; ++i) {
          const Lanes at = base[rows[i]] + slopes_[p + k].along;
          near[i] = at < near[i] ? at : near[i];
        }
      for (size_t i = 0; i < rows_together; ++i) farthest[i] = near[i] > farthest[i] ? near[i] : farthest[i];
    }
    std::array<int, Codes().size()> whole;
    for (size_t i = 0; i < rows_together; ++i) {
      IntLanes row;
      encode_row(farthest[i], row);
      std::memcpy(&whole[i * lanes], &row, sizeof(row));
    }
    narrow_all(whole.data(), codes.data());
  }

  size_t own_ = 0;                ///< seeds
  size_t rows_ = 0;               ///< of a slice, along z one behind the other
  size_t padded_ = 0;             ///< rows, filled up to whole vectors
  std::vector<float> y_, z_;      ///< each row's first voxel
  std::vector<Bisector> planes_;  ///< own · neighbours, those of one neighbour together
  std::vector<PlaneSlope> slopes_;
  std::vector<float> bases_;  ///< of each plane and row, at its first voxel
};

/// Moves as many codes as there are, at most cut_width. A count that is known makes one move of it.
template <typename From, typename To>
SCREE_INLINE void move_row(const From* from, To* to, ptrdiff_t there) {
  if (there >= cut_width)
    std::memcpy(to, from, lanes);
  else
    std::memcpy(to, from, static_cast<size_t>(there));
}

/// A byte of a word for each voxel of a row, the first the lowest.
static_assert(std::endian::native == std::endian::little);
constexpr uint64_t row_of_air = 0x0101010101010101U * code_air;

/// The rows of a slice of the volume that are not only air: no part has a share in those.
struct RockRows {
  struct Row {
    uint64_t codes;   ///< of the volume
    uint64_t within;  ///< 255 for each voxel within the box
    int y, z;         ///< of its first voxel, from the box's low corner
  };
  std::vector<Row> rows;
  std::vector<uint32_t> numbers;  ///< of the rows in the slice; more than there are
  size_t count = 0;

  /// Makes room for so many rows a slice.
  void set(size_t all) {
    rows.resize(all + 1);
    numbers.resize(all + rows_together);
  }

  SCREE_INLINE void read(const Window& volume, const VoxelBox& box, int x) {
    const Code* const end = volume.codes.data() + volume.codes.size();
    const Code* from = volume.codes.data() + volume.index(x, box.lo.y, box.lo.z);
    const VoxelCoord size = box.size();
    const ptrdiff_t step_y = volume.box.size().z;
    Row* row = rows.data();
    uint32_t* to = numbers.data();
    uint32_t number = 0;
    for (int y = 0; y < size.y; ++y, from += step_y)
      for (int z = 0; z < size.z; z += cut_width, ++number) {
        uint64_t codes = 0;
        move_row(from + z, &codes, end - (from + z));
        row->within = ~uint64_t{0} >> (8 * std::max(z + cut_width - size.z, 0));
        row->codes = (codes & row->within) | (row_of_air & ~row->within);
        row->y = y;
        row->z = z;
        *to = number;
        if (row->codes == row_of_air) continue;
        ++row;
        ++to;
      }
    count = static_cast<size_t>(row - rows.data());
    // Rows that are cut together with the last ones.
    for (size_t i = 0; i < rows_together; ++i) to[i] = 0;
  }
};

/// Scratch memory of a part after the other.
struct PartScratch {
  PlaneRows planes;
  RockRows rock;
  std::vector<SharedRow> shares;
};

SCREE_VECTOR_CLONES void cut_part(const Window& volume, const CellBounds& bounds, PartScratch& scratch,
                                  CellPart& part) {
  const VoxelBox& box = bounds.box;
  auto& [planes, rock, shares] = scratch;
  planes.set(bounds);
  rock.set(planes.rows());
  shares.clear();
  const auto slice = static_cast<size_t>(box.size().y) * static_cast<size_t>(box.size().z);
  Code* to = part.window.codes.data();
  const Code* const end = to + part.window.codes.size();
  for (int x = box.lo.x; x < box.hi.x; ++x, to += slice) {
    rock.read(volume, box, x);
    if (rock.count == 0) continue;
    planes.turn_to(static_cast<float>(x));
    for (size_t first = 0; first < rock.count; first += rows_together) {
      const size_t together = std::min(rows_together, rock.count - first);
      Codes codes;
      Shares units;
      planes.cut(&rock.numbers[first], codes);
      occupancies_of(codes.data(), units.data());
      for (size_t i = 0; i < together; ++i) {
        const RockRows::Row& row = rock.rows[first + i];
        SharedRow shared{{x, box.lo.y + row.y, box.lo.z + row.z}, {}};
        uint64_t within;
        std::memcpy(&within, &units[i * lanes], sizeof(within));
        within &= row.within;
        std::memcpy(shared.within.data(), &within, sizeof(within));
        if (within != 0) shares.push_back(shared);
        CodeLanes cut, whole;
        std::memcpy(&cut, &codes[i * lanes], sizeof(cut));
        std::memcpy(&whole, &row.codes, sizeof(whole));
        cut = whole > cut ? whole : cut;
        // What goes beyond the row is overwritten by the next one's, or is air.
        Code* const at = to + static_cast<ptrdiff_t>(row.y) * box.size().z + row.z;
        move_row(&cut, at, end - at);
      }
    }
  }
  part.shares = shares;
}

}  // namespace

std::vector<CellPart> cut_parts(const Window& volume, const std::vector<CellBounds>& bounds) {
  std::vector<CellPart> parts;
  parts.reserve(bounds.size());
  PartScratch scratch;
  for (const CellBounds& one : bounds) {
    CHECK(volume.box.covers(one.box) && !one.own.empty());
    parts.push_back({Window(one.box), {}});
    cut_part(volume, one, scratch, parts.back());
  }
  return parts;
}

}  // namespace scree
