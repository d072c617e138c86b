#include "server/fracture/surface_crossings.h"

#include <algorithm>
#include <array>
#include <bit>

#ifdef __SSE2__
#include <emmintrin.h>
#endif

#include "shared/base/check.h"

namespace scree {

namespace {

constexpr int word_bits = 64;

/// Bit k: whether the code is inside or on the surface, of sixteen codes.
uint64_t inside_bits(const Code* sixteen) {
#ifdef __SSE2__
  const __m128i codes = _mm_loadu_si128(reinterpret_cast<const __m128i*>(sixteen));
  return static_cast<uint16_t>(~_mm_movemask_epi8(_mm_cmpgt_epi8(codes, _mm_setzero_si128())));
#else
  uint64_t bits = 0;
  for (int k = 0; k < 16; ++k) bits |= static_cast<uint64_t>(sixteen[k] <= 0 ? 1 : 0) << k;
  return bits;
#endif
}

/// The same of `count` codes, at most 64. `room`: how many may be read.
uint64_t inside_bits(const Code* codes, int count, ptrdiff_t room) {
  CHECK_DEBUG(count > 0 && count <= word_bits && count <= room);
  uint64_t bits = 0;
  for (int from = 0; from < count; from += 16) {
    if (room - from >= 16) {
      bits |= inside_bits(codes + from) << from;
      continue;
    }
    std::array<Code, 16> last{};
    std::copy_n(codes + from, count - from, last.begin());
    bits |= inside_bits(last.data()) << from;
  }
  return count == word_bits ? bits : bits & ((uint64_t{1} << count) - 1);
}

/// Whole rows are compared at once: few voxels are near the surface.
class Crossings {
 public:
  explicit Crossings(const Window& window) : window_(window) {
    constexpr size_t of_small_pieces = 192;
    points_.reserve(of_small_pieces);
  }

  std::vector<glm::vec3> find() {
    const VoxelBox& b = window_.box;
    const VoxelCoord size = b.size();
    const auto nz = static_cast<size_t>(size.z), nyz = static_cast<size_t>(size.y) * nz;
    const size_t words = (nz + word_bits - 1) / word_bits;  // of a row
    const std::vector<uint64_t> inside = insides(words);
    const uint64_t* word = inside.data();
    const Code* row = window_.codes.data();
    for (int x = b.lo.x; x < b.hi.x; ++x)
      for (int y = b.lo.y; y < b.hi.y; ++y)
        for (int left = size.z; left > 0; row += std::min(word_bits, left), left -= word_bits, ++word) {
          const uint64_t along_x = x + 1 < b.hi.x ? *word ^ word[static_cast<size_t>(size.y) * words] : 0;
          const uint64_t along_y = y + 1 < b.hi.y ? *word ^ word[words] : 0;
          const int next = std::min(word_bits, left - 1);
          const uint64_t known = next == word_bits ? ~uint64_t{0} : (uint64_t{1} << next) - 1;
          const uint64_t beyond = next == word_bits ? word[1] << (word_bits - 1) : 0;
          const uint64_t along_z = (*word ^ (*word >> 1 | beyond)) & known;
          if ((along_x | along_y | along_z) == 0) continue;
          const glm::vec3 at(static_cast<float>(x), static_cast<float>(y), static_cast<float>(b.hi.z - left));
          cross<0>(row, nyz, along_x, at);
          cross<1>(row, nz, along_y, at);
          cross<2>(row, 1, along_z, at);
        }
    return std::move(points_);
  }

 private:
  /// inside_bits() of every row, in as many words each.
  std::vector<uint64_t> insides(size_t words) const {
    const Code* codes = window_.codes.data();
    const Code* const end = codes + window_.codes.size();
    const auto nz = static_cast<size_t>(window_.box.size().z);
    std::vector<uint64_t> inside;
    inside.reserve(window_.codes.size() / nz * words);
    for (; codes < end; codes += nz)
      for (size_t z = 0; z < nz; z += word_bits)
        inside.push_back(inside_bits(codes + z, static_cast<int>(std::min<size_t>(word_bits, nz - z)),
                                     end - codes - static_cast<ptrdiff_t>(z)));
    return inside;
  }

  template <int axis>
  void cross(const Code* row, size_t step, uint64_t edges, glm::vec3 first) {
    for (; edges != 0; edges &= edges - 1) {
      const int k = std::countr_zero(edges);
      const int a = row[k], c = row[static_cast<size_t>(k) + step];
      CHECK_DEBUG((a <= 0) != (c <= 0));
      glm::vec3 at(first.x, first.y, first.z + static_cast<float>(k));
      at[axis] += static_cast<float>(a) / static_cast<float>(a - c);
      points_.push_back(at);
    }
  }

  const Window& window_;
  std::vector<glm::vec3> points_;
};

}  // namespace

std::vector<glm::vec3> surface_crossings(const Window& window) {
  if (window.codes.empty()) return {};
  return Crossings(window).find();
}

}  // namespace scree
