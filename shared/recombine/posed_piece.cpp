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

/// A volume's codes by cells. A cell lies between eight voxels. Its four in one plane of x are one word, (y,
/// z) lowest, then (y, z + 1), (y + 1, z), (y + 1, z + 1). The other four are the next plane's word.
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

/// Where a voxel lies in the volume: the cell, as the place of its lowest voxel among the cells' words, and
/// how far along each of its sides.
struct CellPlace {
  int index;
  int outside;  ///< all ones where there is no such cell, else 0
  float x, y, z;
};

inline CellPlace place_of(size_t i, size_t count, const float* __restrict offsets, const Cells& cells,
                          glm::vec3 plane, glm::vec3 centre) {
  const float x = plane.x + offsets[i] + centre.x + offsets[i + 3 * count];
  const float y = plane.y + offsets[i + count] + centre.y + offsets[i + 4 * count];
  const float z = plane.z + offsets[i + 2 * count] + centre.z + offsets[i + 5 * count];
  const int cell_x = cell_of(x), cell_y = cell_of(y), cell_z = cell_of(z);
  const int at_x = cell_x - cells.lo_x, at_y = cell_y - cells.lo_y, at_z = cell_z - cells.lo_z;
  // All six comparisons at once, by their signs.
  const int outside =
      (at_x | at_y | at_z | (cells.last_x - at_x) | (cells.last_y - at_y) | (cells.last_z - at_z)) >> 31;
  return {(at_x * cells.step_x + at_y * cells.step_y + at_z) & ~outside, outside,
          x - static_cast<float>(cell_x), y - static_cast<float>(cell_y), z - static_cast<float>(cell_z)};
}

inline float between(const CellPlace& at, uint32_t near, uint32_t far) {
  const float z00 = code_in<0>(near) + (code_in<1>(near) - code_in<0>(near)) * at.z;
  const float z01 = code_in<2>(near) + (code_in<3>(near) - code_in<2>(near)) * at.z;
  const float z10 = code_in<0>(far) + (code_in<1>(far) - code_in<0>(far)) * at.z;
  const float z11 = code_in<2>(far) + (code_in<3>(far) - code_in<2>(far)) * at.z;
  const float low = z00 + (z01 - z00) * at.y, high = z10 + (z11 - z10) * at.y;
  return low + (high - low) * at.x;
}

inline int nearest_code(float code, int outside) {
  const int nearest = static_cast<int>(code + (code < 0.0F ? -0.5F : 0.5F));
  return (nearest & ~outside) | (code_air & outside);
}

/// The nearest codes of a plane's voxels, trilinearly; air outside the cells. No branch, so that it runs in
/// vectors.
SCREE_VECTOR_CLONES
void sample_plane(size_t count, const float* __restrict offsets, const Cells& cells, glm::vec3 plane,
                  glm::vec3 centre, int* __restrict out) {
  const uint32_t* __restrict words = cells.words.data();
  for (size_t i = 0; i < count; ++i) {
    const CellPlace at = place_of(i, count, offsets, cells, plane, centre);
    CHECK_DEBUG(at.index >= 0 && static_cast<size_t>(at.index + cells.step_x) < cells.words.size());
    out[i] = nearest_code(between(at, words[at.index], words[at.index + cells.step_x]), at.outside);
  }
}

/// The codes' slopes along one axis, from the side on which they bend less: near the edge of a face that is
/// the face's own.
SCREE_VECTOR_CLONES
void find_slopes(ptrdiff_t count, ptrdiff_t step, const Code* __restrict c, int8_t* __restrict out) {
  constexpr int16_t steepest = 64;  // a code of a distance changes by 43 at most
  for (ptrdiff_t i = 0; i < count; ++i) {
    const int16_t own = c[i];
    const auto below = static_cast<int16_t>(own - c[i - step]);
    const auto above = static_cast<int16_t>(c[i + step] - own);
    const auto bend_below = static_cast<int16_t>(below - c[i - step] + c[i - 2 * step]);
    const auto bend_above = static_cast<int16_t>(c[i + 2 * step] - c[i + step] - above);
    const auto low = static_cast<int16_t>(bend_below < 0 ? -bend_below : bend_below);
    const auto high = static_cast<int16_t>(bend_above < 0 ? -bend_above : bend_above);
    const int16_t slope = low <= high ? below : above;
    out[i] = static_cast<int8_t>(std::clamp<int16_t>(slope, -steepest, steepest));
  }
}

/// Each voxel's plane in one word: its slopes along x, y and z, x lowest, and its code.
SCREE_VECTOR_CLONES
void pack_planes(size_t count, const int8_t* __restrict x, const int8_t* __restrict y,
                 const int8_t* __restrict z, const Code* __restrict c, uint32_t* __restrict words) {
  for (size_t i = 0; i < count; ++i)
    words[i] = static_cast<uint32_t>(static_cast<uint8_t>(x[i])) |
               static_cast<uint32_t>(static_cast<uint8_t>(y[i])) << 8U |
               static_cast<uint32_t>(static_cast<uint8_t>(z[i])) << 16U |
               static_cast<uint32_t>(static_cast<uint8_t>(c[i])) << 24U;
}

/// Layers of air around a volume whose planes are looked for: slopes reach two voxels.
constexpr int plane_margin = 2;

/// In the window's order; those of the two outermost layers are level.
std::vector<uint32_t> planes_of(const Window& window) {
  const size_t all = window.codes.size();
  const ptrdiff_t step_y = window.box.size().z, step_x = step_y * window.box.size().y;
  const ptrdiff_t first = 2 * step_x, count = static_cast<ptrdiff_t>(all) - 2 * first;
  std::vector<int8_t> slopes(3 * all);
  const auto along = [&](size_t axis) { return slopes.data() + axis * all; };
  find_slopes(count, step_x, window.codes.data() + first, along(0) + first);
  find_slopes(count, step_y, window.codes.data() + first, along(1) + first);
  find_slopes(count, 1, window.codes.data() + first, along(2) + first);
  std::vector<uint32_t> words(all + static_cast<size_t>(step_x) + 1);
  pack_planes(all, along(0), along(1), along(2), window.codes.data(), words.data());
  return words;
}

inline float on_plane(uint32_t word, float x, float y, float z) {
  return code_in<3>(word) + (code_in<0>(word) * x + code_in<1>(word) * y + code_in<2>(word) * z);
}

/// Like sample_plane(), by the planes at the corners of each cell (Reading::planes).
SCREE_VECTOR_CLONES
void sample_by_planes(size_t count, const float* __restrict offsets, const Cells& cells,
                      const uint32_t* __restrict planes, glm::vec3 plane, glm::vec3 centre,
                      int* __restrict out) {
  const uint32_t* __restrict words = cells.words.data();
  const int step_x = cells.step_x, step_y = cells.step_y;
  for (size_t i = 0; i < count; ++i) {
    const CellPlace at = place_of(i, count, offsets, cells, plane, centre);
    const float smooth = between(at, words[at.index], words[at.index + step_x]);
    const float back_x = at.x - 1.0F, back_y = at.y - 1.0F, back_z = at.z - 1.0F;
    const uint32_t p000 = planes[at.index], p001 = planes[at.index + 1];
    const uint32_t p010 = planes[at.index + step_y], p011 = planes[at.index + step_y + 1];
    const uint32_t p100 = planes[at.index + step_x], p101 = planes[at.index + step_x + 1];
    const uint32_t p110 = planes[at.index + step_x + step_y], p111 = planes[at.index + step_x + step_y + 1];
    const float a = on_plane(p000, at.x, at.y, at.z), b = on_plane(p001, at.x, at.y, back_z);
    const float c = on_plane(p010, at.x, back_y, at.z), d = on_plane(p011, at.x, back_y, back_z);
    const float e = on_plane(p100, back_x, at.y, at.z), f = on_plane(p101, back_x, at.y, back_z);
    const float g = on_plane(p110, back_x, back_y, at.z), h = on_plane(p111, back_x, back_y, back_z);
    const float most =
        std::max(std::max(std::max(a, b), std::max(c, d)), std::max(std::max(e, f), std::max(g, h)));
    const float least =
        std::min(std::min(std::min(a, b), std::min(c, d)), std::min(std::min(e, f), std::min(g, h)));
    const float sharp = smooth + std::min(0.0F, most - smooth) + std::max(0.0F, least - smooth);
    // Rock stays within the bounds of the voxels near it (posed_bounds).
    const float nearest = std::min(
        std::min(std::min(code_in<3>(p000), code_in<3>(p001)), std::min(code_in<3>(p010), code_in<3>(p011))),
        std::min(std::min(code_in<3>(p100), code_in<3>(p101)), std::min(code_in<3>(p110), code_in<3>(p111))));
    const float code = nearest > static_cast<float>(near_code_max) ? smooth : sharp;
    out[i] = nearest_code(std::max(-127.0F, std::min(127.0F, code)), at.outside);
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

Window posed_codes(const Volume& volume, const QuantisedPose& pose, float voxel_size_m, const VoxelBox& box,
                   Reading reading) {
  Window out(box);
  if (box.empty()) return out;
  const bool by_planes = reading == Reading::planes;
  Window padded;
  if (by_planes) {
    padded = Window(volume.window.box.grown(plane_margin));
    put(volume.window, padded);
  }
  const Cells cells(by_planes ? padded : volume.window);
  const std::vector<uint32_t> planes = by_planes ? planes_of(padded) : std::vector<uint32_t>();
  const PosedAxes axes(volume, pose, voxel_size_m);
  const PlaneOffsets offsets(axes, box);
  std::vector<int> codes(offsets.count);
  Code* to = out.codes.data();
  for (int x = box.lo.x; x < box.hi.x; ++x, to += offsets.count) {
    const glm::vec3 plane = axes.to_local[0] * (static_cast<float>(x) - axes.world_centre.x);
    if (by_planes)
      sample_by_planes(offsets.count, offsets.numbers.data(), cells, planes.data(), plane, axes.local_centre,
                       codes.data());
    else
      sample_plane(offsets.count, offsets.numbers.data(), cells, plane, axes.local_centre, codes.data());
    for (size_t i = 0; i < offsets.count; ++i) to[i] = static_cast<Code>(codes[i]);
  }
  return out;
}

}  // namespace scree
