#include "shared/recombine/posed_piece.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <glm/common.hpp>
#include <glm/gtc/quaternion.hpp>
#include <limits>

#include "shared/base/check.h"
#include "shared/base/vector_clones.h"

namespace scree {

namespace {

struct PosedAxes {
  glm::mat3 to_local;      ///< world directions to the volume's axes
  glm::vec3 world_centre;  ///< voxels
  glm::vec3 local_centre;

  PosedAxes(const Volume& volume, const QuantisedPose& quantised, float voxel_size_m) {
    const Pose pose = dequantise(quantised);
    to_local = glm::transpose(glm::mat3_cast(pose.rotation));
    world_centre = pose.position_m / voxel_size_m;
    local_centre = volume.centre_voxels;
  }
  glm::vec3 local(glm::vec3 world) const { return to_local * (world - world_centre) + local_centre; }
};

constexpr Code near_code_max = 21;  ///< half a voxel

static_assert(std::endian::native == std::endian::little, "near_bits reads eight codes as one word");

/// The highest bit of each byte: whether that code is near the surface or inside.
uint64_t near_bits(const Code* codes) {
  constexpr uint64_t highest = 0x8080808080808080ULL, ones = 0x0101010101010101ULL;
  uint64_t eight = 0;
  std::memcpy(&eight, codes, sizeof(eight));
  // Adding this carries codes that are not negative into the highest bit when they are above.
  return (eight | ~((eight & ~highest) + ones * (127 - near_code_max))) & highest;
}

struct Range {
  int first, last;
};

/// Where the first and the last code near the surface lie in a row; first = count where none does.
Range near_range(const Code* row, int count) {
  constexpr int word = sizeof(uint64_t);
  int first = 0, last = count - 1;
  if (count < word) {
    while (first < count && row[first] > near_code_max) ++first;
    while (last > first && row[last] > near_code_max) --last;
    return {first, last};
  }
  uint64_t bits = 0;
  for (;; first += word) {
    first = std::min(first, count - word);
    bits = near_bits(row + first);
    if (bits != 0) break;
    if (first == count - word) return {count, count - 1};
  }
  first += std::countr_zero(bits) / 8;
  for (last = count - word;; last -= word) {
    last = std::max(last, 0);
    bits = near_bits(row + last);
    if (bits != 0) break;
  }
  return {first, last + word - 1 - std::countl_zero(bits) / 8};
}

/// Calls f(x, y, first z, last z) for the rows with voxels near the surface or inside.
template <typename F>
void for_each_near_row(const Window& window, F&& f) {
  const VoxelBox& all = window.box;
  const int nz = all.hi.z - all.lo.z;
  const Code* row = window.codes.data();
  for (int x = all.lo.x; x < all.hi.x; ++x)
    for (int y = all.lo.y; y < all.hi.y; ++y, row += nz) {
      const Range near = near_range(row, nz);
      if (near.first < nz) f(x, y, all.lo.z + near.first, all.lo.z + near.last);
    }
}

int ceil_to_int(float x) {
  return -floor_to_int(-x);
}

/// A volume's codes by cells: where a cell lies between eight voxels, its four in one plane of x are one
/// word, (y, z) lowest, then (y, z + 1), (y + 1, z), (y + 1, z + 1), and the other four are the next plane's
/// word.
struct Cells {
  int lo_x, lo_y, lo_z;
  int last_x, last_y, last_z;  ///< of the cells; a cell's far corner must lie in the window, too
  int step_x, step_y;
  std::vector<uint32_t> words;

  explicit Cells(const Window& window);
};

SCREE_VECTOR_CLONES
void pack_words(ptrdiff_t count, ptrdiff_t step_y, const Code* __restrict c, uint32_t* __restrict words) {
  for (ptrdiff_t i = 0; i < count; ++i)
    words[i] = static_cast<uint32_t>(static_cast<uint8_t>(c[i])) |
               static_cast<uint32_t>(static_cast<uint8_t>(c[i + 1])) << 8U |
               static_cast<uint32_t>(static_cast<uint8_t>(c[i + step_y])) << 16U |
               static_cast<uint32_t>(static_cast<uint8_t>(c[i + step_y + 1])) << 24U;
}

Cells::Cells(const Window& window)
    : lo_x(window.box.lo.x),
      lo_y(window.box.lo.y),
      lo_z(window.box.lo.z),
      last_x(window.box.size().x - 2),
      last_y(window.box.size().y - 2),
      last_z(window.box.size().z - 2),
      step_x(window.box.size().y * window.box.size().z),
      step_y(window.box.size().z),
      words(window.codes.size() + static_cast<size_t>(step_x) + 1) {
  pack_words(static_cast<ptrdiff_t>(window.codes.size()) - step_y - 1, step_y, window.codes.data(),
             words.data());
}

/// The places in the volume of one plane's voxels (constant x), without the plane's own share: for each voxel
/// three numbers by its y and three by its z. Each of the six numbers is stored for all voxels in turn.
struct PlaneOffsets {
  size_t count;
  std::vector<float> numbers;

  PlaneOffsets(const PosedAxes& axes, const VoxelBox& box)
      : count(static_cast<size_t>(box.size().y) * static_cast<size_t>(box.size().z)), numbers(6 * count) {
    size_t i = 0;
    for (int y = box.lo.y; y < box.hi.y; ++y)
      for (int z = box.lo.z; z < box.hi.z; ++z, ++i)
        for (int axis = 0; axis < 3; ++axis) {
          float* to = numbers.data() + static_cast<size_t>(axis) * count + i;
          to[0] = axes.to_local[1][axis] * (static_cast<float>(y) - axes.world_centre.y);
          to[3 * count] = axes.to_local[2][axis] * (static_cast<float>(z) - axes.world_centre.z);
        }
  }
};

inline int cell_of(float p) {
  const int i = static_cast<int>(p);
  return i - (p < static_cast<float>(i) ? 1 : 0);
}

template <unsigned Byte>
inline float code_in(uint32_t word) {
  return static_cast<float>(static_cast<int32_t>(word << (24U - 8U * Byte)) >> 24U);
}

/// The nearest codes of a plane's voxels, trilinearly; air outside the cells. No branch, so that it runs in
/// vectors.
SCREE_VECTOR_CLONES
void sample_plane(size_t count, const float* __restrict offsets, const Cells& cells, glm::vec3 plane,
                  glm::vec3 centre, int* __restrict out) {
  const float plane_x = plane.x, plane_y = plane.y, plane_z = plane.z;
  const float centre_x = centre.x, centre_y = centre.y, centre_z = centre.z;
  const int lo_x = cells.lo_x, lo_y = cells.lo_y, lo_z = cells.lo_z;
  const int last_x = cells.last_x, last_y = cells.last_y, last_z = cells.last_z;
  const int step_x = cells.step_x, step_y = cells.step_y;
  const uint32_t* __restrict words = cells.words.data();
  for (size_t i = 0; i < count; ++i) {
    const float x = plane_x + offsets[i] + centre_x + offsets[i + 3 * count];
    const float y = plane_y + offsets[i + count] + centre_y + offsets[i + 4 * count];
    const float z = plane_z + offsets[i + 2 * count] + centre_z + offsets[i + 5 * count];
    const int cell_x = cell_of(x), cell_y = cell_of(y), cell_z = cell_of(z);
    const float part_x = x - static_cast<float>(cell_x), part_y = y - static_cast<float>(cell_y),
                part_z = z - static_cast<float>(cell_z);
    const int at_x = cell_x - lo_x, at_y = cell_y - lo_y, at_z = cell_z - lo_z;
    // All six comparisons at once, by their signs.
    const int outside =
        (at_x | at_y | at_z | (last_x - at_x) | (last_y - at_y) | (last_z - at_z)) >> 31;  // all ones or 0
    const int index = (at_x * step_x + at_y * step_y + at_z) & ~outside;
    CHECK_DEBUG(index >= 0 && static_cast<size_t>(index + step_x) < cells.words.size());
    const uint32_t near = words[index], far = words[index + step_x];
    const float z00 = code_in<0>(near) + (code_in<1>(near) - code_in<0>(near)) * part_z;
    const float z01 = code_in<2>(near) + (code_in<3>(near) - code_in<2>(near)) * part_z;
    const float z10 = code_in<0>(far) + (code_in<1>(far) - code_in<0>(far)) * part_z;
    const float z11 = code_in<2>(far) + (code_in<3>(far) - code_in<2>(far)) * part_z;
    const float low = z00 + (z01 - z00) * part_y, high = z10 + (z11 - z10) * part_y;
    const float code = low + (high - low) * part_x;
    const int nearest = static_cast<int>(code + (code < 0.0F ? -0.5F : 0.5F));
    out[i] = (nearest & ~outside) | (code_air & outside);
  }
}

}  // namespace

VoxelBox near_box(const Window& window) {
  VoxelBox found{window.box.hi, window.box.lo};
  for_each_near_row(window, [&](int x, int y, int first, int last) {
    found.lo = {std::min(found.lo.x, x), std::min(found.lo.y, y), std::min(found.lo.z, first)};
    found.hi = {std::max(found.hi.x, x + 1), std::max(found.hi.y, y + 1), std::max(found.hi.z, last + 1)};
  });
  return found;
}

VoxelBox posed_bounds(const Volume& volume, const QuantisedPose& pose, float voxel_size_m) {
  const PosedAxes axes(volume, pose, voxel_size_m);
  const glm::mat3 to_world = glm::transpose(axes.to_local);
  glm::vec3 lo(std::numeric_limits<float>::max()), hi(-lo);
  const auto include = [&](int x, int y, int z) {
    const glm::vec3 local(static_cast<float>(x), static_cast<float>(y), static_cast<float>(z));
    const glm::vec3 world = to_world * (local - axes.local_centre);
    lo = glm::min(lo, world);
    hi = glm::max(hi, world);
  };
  for_each_near_row(volume.window, [&](int x, int y, int first, int last) {
    include(x, y, first);
    include(x, y, last);
  });
  if (lo.x > hi.x) {
    const VoxelBox& box = volume.window.box;
    for (int corner = 0; corner < 8; ++corner)
      include((corner & 4) != 0 ? box.hi.x - 1 : box.lo.x, (corner & 2) != 0 ? box.hi.y - 1 : box.lo.y,
              (corner & 1) != 0 ? box.hi.z - 1 : box.lo.z);
  }
  // Interpolation carries a voxel's code less than one voxel along each of the volume's axes.
  const glm::vec3 reach = glm::abs(to_world[0]) + glm::abs(to_world[1]) + glm::abs(to_world[2]);
  const glm::vec3 first = axes.world_centre + lo - reach, last = axes.world_centre + hi + reach;
  const VoxelBox box{{ceil_to_int(first.x), ceil_to_int(first.y), ceil_to_int(first.z)},
                     {floor_to_int(last.x) + 1, floor_to_int(last.y) + 1, floor_to_int(last.z) + 1}};
  CHECK(!box.empty());
  return box;
}

Window posed_codes(const Volume& volume, const QuantisedPose& pose, float voxel_size_m, const VoxelBox& box) {
  Window out(box);
  if (box.empty()) return out;
  const PosedAxes axes(volume, pose, voxel_size_m);
  const Cells cells(volume.window);
  const PlaneOffsets offsets(axes, box);
  std::vector<int> codes(offsets.count);
  Code* to = out.codes.data();
  for (int x = box.lo.x; x < box.hi.x; ++x, to += offsets.count) {
    const glm::vec3 plane = axes.to_local[0] * (static_cast<float>(x) - axes.world_centre.x);
    sample_plane(offsets.count, offsets.numbers.data(), cells, plane, axes.local_centre, codes.data());
    for (size_t i = 0; i < offsets.count; ++i) to[i] = static_cast<Code>(codes[i]);
  }
  return out;
}

}  // namespace scree
