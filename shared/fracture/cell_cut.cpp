#include "shared/fracture/cell_cut.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <glm/geometric.hpp>

#include "shared/base/check.h"
#include "shared/base/vector_clones.h"
#include "shared/field/voxel_vector.h"

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

/// Voxels along z that are cut at a time, in one vector, spelt out. Left to itself the compiler did this
/// loop, the dearest of a carve, one voxel at a time.
constexpr int cut_width = 8;
using Lanes = float __attribute__((vector_size(32)));

/// Far inside every plane, voxels.
constexpr float deep_inside = -2.0F * band_voxels;

/// Distance beyond the farthest of the bisectors, the nearest over the own seeds of each neighbour. `planes`
/// holds own · neighbours bisectors, those of one neighbour together.
inline void cut_row(const std::vector<Bisector>& planes, size_t own, glm::vec3 first, Lanes& row) {
  const Lanes steps = {0.0F, 1.0F, 2.0F, 3.0F, 4.0F, 5.0F, 6.0F, 7.0F};
  row = steps * 0.0F + deep_inside;
  for (size_t p = 0; p < planes.size(); p += own) {
    Lanes near{};
    for (size_t k = 0; k < own; ++k) {
      const Bisector& plane = planes[p + k];
      const float base =
          plane.offset + (plane.normal.x * first.x + plane.normal.y * first.y + plane.normal.z * first.z);
      const Lanes at = base + plane.normal.z * steps;
      near = k == 0 ? at : (at < near ? at : near);
    }
    row = near > row ? near : row;
  }
}

using IntLanes = int __attribute__((vector_size(32)));
using CodeLanes = Code __attribute__((vector_size(8)));

/// encode() of each.
inline void encode_row(const Lanes& distances, IntLanes& codes) {
  const Lanes scaled = distances * codes_per_voxel;
  const Lanes low = scaled < -127.0F ? Lanes{} - 127.0F : scaled;
  const Lanes clamped = low > 127.0F ? Lanes{} + 127.0F : low;
  codes = __builtin_convertvector(clamped + (clamped < 0.0F ? Lanes{} - 0.5F : Lanes{} + 0.5F), IntLanes);
}

/// occupancy() of each.
inline void occupancy_row(const IntLanes& codes, IntLanes& units) {
  const IntLanes ramp = 127 - 6 * codes;
  const IntLanes low = ramp < 0 ? IntLanes{} : ramp;
  units = low > units_per_voxel ? IntLanes{} + units_per_voxel : low;
}

/// Cuts `count` voxels of a row of the volume, at most cut_width, from `first` on.
inline void cut_voxels(const std::vector<Bisector>& planes, size_t own, glm::vec3 first, int count,
                       const Code* from, Code* to, uint8_t* within) {
  CodeLanes codes = CodeLanes{} + code_air, shares{};
  std::memcpy(&codes, from, static_cast<size_t>(count));
  // No part has a share in a row of air.
  constexpr uint64_t all_air = 0x7F7F7F7F7F7F7F7FU;
  uint64_t eight;
  std::memcpy(&eight, &codes, sizeof(eight));
  if (eight != all_air) {
    Lanes distances;
    cut_row(planes, own, first, distances);
    IntLanes cut, units;
    encode_row(distances, cut);
    occupancy_row(cut, units);
    const auto narrow = __builtin_convertvector(cut, CodeLanes);
    codes = codes > narrow ? codes : narrow;
    shares = __builtin_convertvector(units, CodeLanes);
  }
  std::memcpy(to, &codes, static_cast<size_t>(count));
  std::memcpy(within, &shares, static_cast<size_t>(count));
}

/// Calls f(x, y, index in the whole, index in the part) for each row of the part; x and y are relative to the
/// whole.
template <typename F>
void for_each_row(const VoxelBox& whole, const VoxelBox& part, F&& f) {
  const VoxelCoord size = whole.size(), own = part.size();
  size_t from = 0;
  for (int x = part.lo.x; x < part.hi.x; ++x)
    for (int y = part.lo.y; y < part.hi.y; ++y, from += static_cast<size_t>(own.z))
      f(x - whole.lo.x, y - whole.lo.y,
        (static_cast<size_t>(x - whole.lo.x) * static_cast<size_t>(size.y) +
         static_cast<size_t>(y - whole.lo.y)) *
                static_cast<size_t>(size.z) +
            static_cast<size_t>(part.lo.z - whole.lo.z),
        from);
}

void add(PartMass& part, MassUnits mass, int x, int y, int z) {
  part.mass += mass;
  part.x += mass * x;
  part.y += mass * y;
  part.z += mass * z;
}

}  // namespace

SCREE_VECTOR_CLONES CellPart cut_part(const Window& volume, const VoxelBox& box,
                                      const std::vector<glm::vec3>& own,
                                      const std::vector<glm::vec3>& neighbours) {
  CHECK(volume.box.covers(box) && !own.empty());
  std::vector<Bisector> planes;
  planes.reserve(own.size() * neighbours.size());
  for (const glm::vec3& other : neighbours)
    for (const glm::vec3& seed : own) planes.emplace_back(seed, other);
  CellPart part{Window(box), std::vector<uint8_t>(Window::count(box))};
  Code* to = part.window.codes.data();
  uint8_t* within = part.within.data();
  for (int x = box.lo.x; x < box.hi.x; ++x)
    for (int y = box.lo.y; y < box.hi.y; ++y) {
      const Code* from = volume.codes.data() + volume.index(x, y, box.lo.z);
      for (int z = box.lo.z; z < box.hi.z; z += cut_width) {
        const int count = std::min(cut_width, box.hi.z - z);
        const glm::vec3 first = as_vector({x, y, z});
        // A count that is known makes single moves of the copies.
        if (count == cut_width)
          cut_voxels(planes, own.size(), first, cut_width, from, to, within);
        else
          cut_voxels(planes, own.size(), first, count, from, to, within);
        from += count, to += count, within += count;
      }
    }
  return part;
}

std::vector<PartMass> share_out(const VoxelBox& box, const std::vector<uint8_t>& lost,
                                const std::vector<uint16_t>& nearest, const std::vector<CellPart>& parts) {
  CHECK_EQ(lost.size(), Window::count(box));
  CHECK_EQ(nearest.size(), lost.size());
  std::vector<uint16_t> claims(lost.size());
  for (const CellPart& part : parts) {
    CHECK(box.covers(part.window.box));
    const auto count = static_cast<size_t>(part.window.box.size().z);
    for_each_row(box, part.window.box, [&](int, int, size_t to, size_t from) {
      for (size_t k = 0; k < count; ++k) {
        CHECK_DEBUG(claims[to + k] + part.within[from + k] <= UINT16_MAX);
        claims[to + k] = static_cast<uint16_t>(claims[to + k] + part.within[from + k]);
      }
    });
  }
  std::vector<uint8_t> left = lost;
  std::vector<PartMass> masses(parts.size());
  for (size_t i = 0; i < parts.size(); ++i) {
    const CellPart& part = parts[i];
    const int count = part.window.box.size().z, z = part.window.box.lo.z - box.lo.z;
    for_each_row(box, part.window.box, [&](int x, int y, size_t to, size_t from) {
      for (int k = 0; k < count; ++k) {
        const size_t at = to + static_cast<size_t>(k);
        const uint32_t own = part.within[from + static_cast<size_t>(k)];
        if (own == 0 || lost[at] == 0) continue;
        const uint32_t share = own == claims[at] ? lost[at] : lost[at] * own / claims[at];
        CHECK_DEBUG(share <= left[at]);
        left[at] = static_cast<uint8_t>(left[at] - share);
        add(masses[i], share, x, y, z + k);
      }
    });
  }
  const VoxelCoord size = box.size();
  size_t at = 0;
  for (int x = 0; x < size.x; ++x)
    for (int y = 0; y < size.y; ++y)
      for (int z = 0; z < size.z; ++z, ++at)
        if (left[at] != 0 && nearest[at] < masses.size()) add(masses[nearest[at]], left[at], x, y, z);
  return masses;
}

}  // namespace scree
