#include "shared/recombine/merge_kernels.h"

#include <algorithm>
#include <cstring>

#include "shared/base/vector_clones.h"
#include "shared/field/mass.h"
#include "shared/field/occupancy_byte.h"

namespace scree::merge_kernels {

SCREE_VECTOR_CLONES
void unite(size_t count, const Code* __restrict terrain, const Code* __restrict piece,
           Code* __restrict united, uint8_t* __restrict touched) {
  for (size_t i = 0; i < count; ++i) {
    touched[i] =
        static_cast<uint8_t>((piece[i] < terrain[i] ? 0xFF : 0) & (piece[i] < near_surface ? 0xFF : 0));
    united[i] = std::min(piece[i], terrain[i]);
  }
}

SCREE_VECTOR_CLONES
void fill_gaps(ptrdiff_t count, ptrdiff_t step_x, ptrdiff_t step_y, const Code* __restrict c,
               const uint8_t* __restrict touched, Code* __restrict out) {
  constexpr Code too_far = 43;  // a voxel from either side by its own account
  const ptrdiff_t steps[3] = {1, step_y, step_x};
  for (ptrdiff_t i = 0; i < count; ++i) {
    const int8_t own = c[i];
    const auto square = static_cast<int16_t>(own * own);
    int8_t gap = 0;
    for (int axis = 0; axis < 3; ++axis) {
      const ptrdiff_t step = steps[axis];
      const int8_t low = c[i - step], high = c[i + step];
      const auto product = static_cast<int16_t>(low * high);
      const auto narrow = static_cast<int8_t>(square < product ? -1 : 0);
      const auto touches = static_cast<int8_t>(touched[i - step] | touched[i] | touched[i + step]);
      gap = static_cast<int8_t>(gap | (low & high & narrow & touches));
    }
    const auto close = static_cast<int8_t>(gap & (own >= 0 ? -1 : 0) & (own < too_far ? -1 : 0));
    out[i] = close < 0 ? Code{-1} : own;
  }
}

SCREE_VECTOR_CLONES
void find_bends(ptrdiff_t count, ptrdiff_t step_x, ptrdiff_t step_y, const Code* __restrict piece,
                const Code* __restrict united, const uint8_t* __restrict touched, int16_t* __restrict convex,
                int16_t* __restrict concave) {
  for (ptrdiff_t i = 0; i < count; ++i) {
    const int8_t own = united[i];
    const auto near = static_cast<int16_t>((own <= near_surface ? -1 : 0) & (own >= -near_surface ? -1 : 0) &
                                           (piece[i] < near_surface ? -1 : 0));
    const uint8_t* t = touched + i;
    const auto touch =
        static_cast<int8_t>(t[0] | t[-1] | t[1] | t[-step_y] | t[step_y] | t[-step_x] | t[step_x]);
    const int16_t out = bend(piece + i, step_x, step_y);
    // Twice: the rest of a seam must close before the surface moves (measured: bench seams).
    const auto back = static_cast<int16_t>(-2 * bend(united + i, step_x, step_y));
    convex[i] = static_cast<int16_t>(std::clamp<int16_t>(out, 0, curvature_max) & near &
                                     static_cast<int8_t>(touched[i]));
    concave[i] = static_cast<int16_t>(std::clamp<int16_t>(back, 0, curvature_max) & near & touch);
  }
}

SCREE_VECTOR_CLONES
void grow(size_t count, Amounts by, const Code* __restrict united, const Code* __restrict piece,
          const int16_t* __restrict concave, Code* __restrict out) {
  for (size_t i = 0; i < count; ++i) {
    const auto filled =
        static_cast<int16_t>(united[i] - (static_cast<int16_t>(by.curved * concave[i]) >> curvature_bits));
    const auto grown = static_cast<int16_t>(piece[i] == code_air ? code_air : piece[i] - by.uniform);
    out[i] = static_cast<Code>(std::max<int16_t>(code_solid, std::min(filled, grown)));
  }
}

SCREE_VECTOR_CLONES
void shrink(size_t count, Amounts by, const Code* __restrict united, const Code* __restrict terrain,
            const int16_t* __restrict convex, const uint8_t* __restrict touched, Code* __restrict out) {
  for (size_t i = 0; i < count; ++i) {
    const auto raise = static_cast<int16_t>((static_cast<int16_t>(by.curved * convex[i]) >> curvature_bits) +
                                            (by.uniform & static_cast<int8_t>(touched[i])));
    out[i] = static_cast<Code>(std::min<int16_t>(terrain[i], static_cast<int16_t>(united[i] + raise)));
  }
}

SCREE_VECTOR_CLONES
void fill_pits(ptrdiff_t count, ptrdiff_t step_x, ptrdiff_t step_y, const Code* __restrict c,
               const uint8_t* __restrict core, Code* __restrict out) {
  constexpr Code shallow = 15;  // a third of a voxel
  for (ptrdiff_t i = 0; i < count; ++i) {
    const auto along_z = static_cast<int8_t>(c[i - 1] & c[i + 1]);
    const auto along_y = static_cast<int8_t>(c[i - step_y] & c[i + step_y]);
    const auto along_x = static_cast<int8_t>(c[i - step_x] & c[i + step_x]);
    const auto two = static_cast<int8_t>((along_x & along_y) | (along_y & along_z) | (along_x & along_z));
    const int8_t own = c[i];
    // Not below zero, and below `shallow`, by signs alone: comparisons became branches, four times as slow.
    const auto pit = static_cast<int8_t>(two & ~own & (own - shallow) & core[i]);
    out[i] = pit < 0 ? Code{-1} : own;
  }
}

SCREE_VECTOR_CLONES
int settled_sum(ptrdiff_t count, ptrdiff_t step_x, ptrdiff_t step_y, const Code* __restrict c,
                const uint8_t* __restrict inner) {
  int sum = 0;
  for (ptrdiff_t i = 0; i < count; ++i) {
    const int8_t own = c[i];
    const int8_t signs = crossing_signs(c + i, step_x, step_y);
    const auto settled = static_cast<int8_t>(own < 0 ? code_solid : code_air);
    const int8_t code = signs < 0 ? own : settled;
    sum += static_cast<uint8_t>(occupancy_byte(code) & inner[i]);
  }
  return sum;
}

SCREE_VECTOR_CLONES
int settled_mass(ptrdiff_t count, ptrdiff_t step_x, ptrdiff_t step_y, const Code* __restrict c,
                 const Code* __restrict terrain, const uint8_t* __restrict were,
                 const uint8_t* __restrict brought, const uint8_t* __restrict inner) {
  int sum = 0;
  for (ptrdiff_t i = 0; i < count; ++i) {
    const int8_t own = c[i], was = terrain[i];
    const int8_t signs = crossing_signs(c + i, step_x, step_y);
    const auto settled = static_cast<int8_t>(own < 0 ? code_solid : code_air);
    const uint8_t is = occupancy_byte(signs < 0 ? own : settled);
    const auto stays = static_cast<uint8_t>((was < 0 ? 0xFF : 0) | (is == occupancy_byte(was) ? 0xFF : 0));
    const auto fill = static_cast<uint8_t>((were[i] & stays) | (brought[i] & ~stays));
    sum += static_cast<uint8_t>(mass_in_voxel(is, fill) & inner[i]);
  }
  return sum;
}

SCREE_VECTOR_CLONES
int filled_sum(size_t count, const Code* __restrict codes, const uint8_t* __restrict fills,
               const uint8_t* __restrict inner) {
  int sum = 0;
  for (size_t i = 0; i < count; ++i)
    sum += static_cast<uint8_t>(mass_in_voxel(occupancy_byte(codes[i]), fills[i]) & inner[i]);
  return sum;
}

SCREE_VECTOR_CLONES
void find_surface(ptrdiff_t count, ptrdiff_t step_x, ptrdiff_t step_y, const Code* __restrict c,
                  const Code* __restrict piece, const uint8_t* __restrict core, uint8_t* __restrict surface) {
  for (ptrdiff_t i = 0; i < count; ++i) {
    const int8_t signs = crossing_signs(c + i, step_x, step_y);
    surface[i] =
        static_cast<uint8_t>((signs < 0 ? 0xFF : 0) & (piece[i] < near_surface ? 0xFF : 0) & core[i]);
  }
}

SCREE_VECTOR_CLONES
int count_marks(size_t count, const uint8_t* __restrict marks) {
  int sum = 0;
  for (size_t i = 0; i < count; ++i) sum += marks[i] & 1;
  return sum;
}

SCREE_VECTOR_CLONES
int inner_sum(size_t count, const Code* __restrict codes, const uint8_t* __restrict inner) {
  int sum = 0;
  for (size_t i = 0; i < count; ++i) sum += static_cast<uint8_t>(occupancy_byte(codes[i]) & inner[i]);
  return sum;
}

void mark_inner(const VoxelCoord& size, int layers, uint8_t* mask) {
  const ptrdiff_t plane = static_cast<ptrdiff_t>(size.y) * size.z;
  uint8_t* first = mask + layers * plane;
  for (int y = layers; y + layers < size.y; ++y)
    std::memset(first + static_cast<ptrdiff_t>(y) * size.z + layers, 0xFF,
                static_cast<size_t>(size.z - 2 * layers));
  for (int x = layers + 1; x + layers < size.x; ++x)
    std::memcpy(mask + x * plane, first, static_cast<size_t>(plane));
}

}  // namespace scree::merge_kernels
