#include "shared/falling/support_parts.h"

#include <algorithm>
#include <limits>
#include <numeric>

#include "shared/base/check.h"
#include "shared/field/mass.h"

namespace scree {

namespace {

constexpr uint32_t unread = UINT32_MAX - 1;
constexpr uint64_t row_y = 0xFFU;                ///< y = 0
constexpr uint64_t row_z = 0x0101010101010101U;  ///< z = 0

/// The voxels of one layer along an axis.
BrickBits layer(const BrickBits& bits, int axis, int k) {
  BrickBits out;
  for (size_t x = 0; x < bits.words.size(); ++x) {
    if (axis == 0 && static_cast<int>(x) != k) continue;
    const uint64_t mask = axis == 1 ? row_y << (8 * k) : axis == 2 ? row_z << k : ~uint64_t{0};
    out.words[x] = bits.words[x] & mask;
  }
  return out;
}

/// Voxels whose next neighbour along the axis is set, too.
BrickBits followed(const BrickBits& bits, int axis) {
  BrickBits out;
  for (size_t x = 0; x < bits.words.size(); ++x) {
    const uint64_t word = bits.words[x];
    if (axis == 0) out.words[x] = x + 1 < bits.words.size() ? word & bits.words[x + 1] : 0;
    if (axis == 1) out.words[x] = word & (word >> 8U);
    if (axis == 2) out.words[x] = word & (word >> 1U) & ~(row_z << 7U);
  }
  return out;
}

/// How many bits each byte of the word has, in that byte.
uint64_t byte_counts(uint64_t word) {
  word -= (word >> 1U) & 0x5555555555555555U;
  word = (word & 0x3333333333333333U) + ((word >> 2U) & 0x3333333333333333U);
  return (word + (word >> 4U)) & 0x0F0F0F0F0F0F0F0FU;
}

/// Rows become columns: bit y·8 + z becomes bit z·8 + y. (Hacker's Delight, 7-3.)
uint64_t transposed(uint64_t word) {
  uint64_t swapped = (word ^ (word >> 7U)) & 0x00AA00AA00AA00AAU;
  word ^= swapped ^ (swapped << 7U);
  swapped = (word ^ (word >> 14U)) & 0x0000CCCC0000CCCCU;
  word ^= swapped ^ (swapped << 14U);
  swapped = (word ^ (word >> 28U)) & 0x00000000F0F0F0F0U;
  return word ^ swapped ^ (swapped << 28U);
}

/// Voxels in each layer along the axis.
std::array<uint8_t, brick_size> layer_counts(const BrickBits& bits, int axis) {
  std::array<uint8_t, brick_size> counts{};
  uint64_t sums = 0;  // 64 voxels a layer at most: no byte overflows
  for (size_t x = 0; x < bits.words.size(); ++x) {
    const uint64_t bytes = byte_counts(axis == 2 ? transposed(bits.words[x]) : bits.words[x]);
    if (axis == 0) counts[x] = static_cast<uint8_t>((bytes * row_z) >> 56U);
    sums += bytes;
  }
  for (size_t k = 0; k < counts.size() && axis != 0; ++k) counts[k] = static_cast<uint8_t>(sums >> (8 * k));
  return counts;
}

/// The layer up to which half of the voxels lie.
int middle_of(const std::array<uint8_t, brick_size>& layers, int voxels) {
  CHECK_DEBUG(std::accumulate(layers.begin(), layers.end(), 0) == voxels);
  size_t k = 0;
  for (int below = layers[0]; 2 * below < voxels; below += layers[k]) ++k;
  return static_cast<int>(k);
}

void measure(SupportPart& part) {
  part.voxels = part.bits == ~BrickBits{} ? SupportPart::whole_voxels : part.bits.count();
  for (size_t axis = 0; axis < 3; ++axis) {
    auto& sections = part.sections[axis];
    sections.fill(brick_size * brick_size);
    part.layers[axis].fill(brick_size * brick_size);
    part.middle[axis] = brick_size / 2 - 1;
    if (part.is_whole()) continue;
    part.layers[axis] = layer_counts(part.bits, static_cast<int>(axis));
    part.middle[axis] = middle_of(part.layers[axis], part.voxels);
    const auto pairs = layer_counts(followed(part.bits, static_cast<int>(axis)), static_cast<int>(axis));
    std::copy_n(pairs.begin(), sections.size(), sections.begin());
  }
}

/// The number of cells in a box of that size.
template <typename C>
size_t cells(C size) {
  return static_cast<size_t>(size.x) * static_cast<size_t>(size.y) * static_cast<size_t>(size.z);
}
template <typename C>
size_t cell(C at, C size) {
  return (static_cast<size_t>(at.x) * static_cast<size_t>(size.y) + static_cast<size_t>(at.y)) *
             static_cast<size_t>(size.z) +
         static_cast<size_t>(at.z);
}

BrickCoord least(BrickCoord a, BrickCoord b) {
  return {std::min(a.x, b.x), std::min(a.y, b.y), std::min(a.z, b.z)};
}
BrickCoord most(BrickCoord a, BrickCoord b) {
  return {std::max(a.x, b.x), std::max(a.y, b.y), std::max(a.z, b.z)};
}

}  // namespace

SupportParts::SupportParts(Field& field, const Palette& palette, std::span<const BrickCoord> changed,
                           int reach_bricks, size_t parts_max, const Holding* holding)
    : field_(field), palette_(palette), ground_(field), parts_max_(parts_max), holding_(holding) {
  CHECK(reach_bricks >= 0 && parts_max < unread);
  if (changed.empty()) return;
  BrickCoord lo = changed.front(), hi = changed.front();
  for (const BrickCoord brick : changed) {
    lo = least(lo, brick);
    hi = most(hi, brick);
  }
  const BrickCoord reach{reach_bricks, reach_bricks, reach_bricks};
  lo_ = lo - reach;
  size_ = hi + reach + BrickCoord{1, 1, 1} - lo_;
  firsts_.assign(cells(size_), unread);
  const ChunkCoord lo_chunk = chunk_of(lo_ - BrickCoord{1, 1, 1}), hi_chunk = chunk_of(lo_ + size_);
  lo_chunk_ = lo_chunk;
  size_chunks_ = hi_chunk - lo_chunk + ChunkCoord{1, 1, 1};
  holds_.assign(cells(size_chunks_), Holds::unknown);
  parts_.reserve(firsts_.size() / 2);  // as many as a slope has; a search in rock has less
  links_.reserve(firsts_.size());
  for (const BrickCoord brick : changed) {
    load(brick);
    for (const BrickCoord face : brick_faces)
      if (inside(brick + face)) load(brick + face);
  }
  for (uint32_t part = 0; part < parts_.size() && !overflow_; ++part)
    for (size_t face = 0; face < brick_faces.size(); ++face) connect(part, face);
}

bool SupportParts::inside(BrickCoord brick) const {
  const BrickCoord at = brick - lo_;
  return at.x >= 0 && at.y >= 0 && at.z >= 0 && at.x < size_.x && at.y < size_.y && at.z < size_.z;
}

uint32_t& SupportParts::first_of_brick(BrickCoord brick) {
  CHECK_DEBUG(inside(brick));
  return firsts_[cell(brick - lo_, size_)];
}

bool SupportParts::is_ground(BrickCoord brick) {
  const ChunkCoord chunk = chunk_of(brick);
  Holds& holds = holds_[cell(chunk - lo_chunk_, size_chunks_)];
  if (holds == Holds::unknown) holds = ground_.holds(brick) ? Holds::yes : Holds::no;
  return holds == Holds::yes;
}

void SupportParts::add(BrickCoord brick, const BrickBits& bits, float fill, uint32_t& first) {
  if (parts_.size() == parts_max_) {
    overflow_ = true;
    return;
  }
  SupportPart part;
  part.brick = brick;
  part.bits = bits;
  part.fill = fill;
  part.next = first;
  measure(part);
  read_materials(part);
  part.held = is_held(part);
  first = static_cast<uint32_t>(parts_.size());
  parts_.push_back(part);
}

void SupportParts::read_materials(SupportPart& part) const {
  if (const auto one = one_material_of(field_, part.brick)) {
    part.material = *one;
    part.density_kg_m3 = palette_.row_or_first(*one).density_kg_m3;
    part.bending_pa = palette_.row_or_first(*one).bearing.bending_pa;
    return;
  }
  auto each = std::make_shared<const BrickRock>(materials_of(field_, part.brick));
  std::array<int, 256> counts{};
  for (size_t x = 0; x < part.bits.words.size(); ++x)
    for (uint64_t left = part.bits.words[x]; left != 0; left &= left - 1)
      ++counts[row_number((*each)[x * 64 + static_cast<size_t>(std::countr_zero(left))])];
  double density = 0.0;
  part.bending_pa = std::numeric_limits<float>::max();
  for (size_t number = 0; number < counts.size(); ++number) {
    if (counts[number] == 0) continue;
    part.material = static_cast<Material>(number);
    const MaterialRow& row = palette_.row_or_first(part.material);
    density += static_cast<double>(row.density_kg_m3) * counts[number] / part.voxels;
    part.bending_pa = std::min(part.bending_pa, row.bearing.bending_pa);
    if (counts[number] != part.voxels) part.each = each;
  }
  part.density_kg_m3 = static_cast<float>(density);
}

bool SupportParts::is_held(const SupportPart& part) {
  if (is_ground(part.brick)) return true;
  for (size_t face = 0; face < brick_faces.size(); ++face) {
    const BrickCoord beyond = part.brick + brick_faces[face];
    if ((!inside(beyond) || is_ground(beyond)) && across(part.bits, face).any()) return true;
  }
  return holding_ != nullptr && holding_->holds(part.brick, part.bits);
}

uint32_t SupportParts::load(BrickCoord brick) {
  uint32_t& first = first_of_brick(brick);
  if (first != unread) return first;
  first = SupportPart::none;
  const Brick& codes = field_.brick(brick);
  const BrickBits solid = solid_bits(codes);
  if (!solid.any()) return first;
  const bool whole = solid == ~BrickBits{};
  const float fill =
      static_cast<float>(brick_mass(codes)) / static_cast<float>(units_per_voxel * solid.count());
  for (BrickBits left = solid; left.any();) {
    const BrickBits bits = whole ? solid : flooded(first_of(left), solid);
    add(brick, bits, fill, first);
    left = left & ~bits;
  }
  return first;
}

void SupportParts::connect(uint32_t part, size_t face) {
  if (parts_[part].held) return;  // the parts below it do not matter
  const BrickBits reached = across(parts_[part].bits, face);
  if (!reached.any()) return;
  const BrickCoord beyond = parts_[part].brick + brick_faces[face];
  const bool up = face % 2 == 0;
  for (uint32_t i = load(beyond); i != SupportPart::none; i = parts_[i].next) {
    if (!(parts_[i].bits & reached).any()) continue;
    // Each pair once: from the lower part, or from the upper one when the lower is held and makes no links.
    if (!up && !parts_[i].held) continue;
    links_.push_back(link_of(up ? part : i, up ? i : part, static_cast<int>(face / 2)));
  }
}

int SupportParts::section(const SupportLink& link, int at) const {
  CHECK_DEBUG(at > -brick_size && at < brick_size);
  const SupportPart& lower = parts_[link.lower];
  const SupportPart& upper = parts_[link.upper];
  const auto axis = static_cast<size_t>(link.axis);
  if (at < 0) return lower.sections[axis][static_cast<size_t>(brick_size - 1 + at)];
  if (at > 0) return upper.sections[axis][static_cast<size_t>(at - 1)];
  return (across(lower.bits, 2 * axis) & upper.bits).count();
}

int SupportParts::first_place(const SupportLink& link) const {
  return parts_[link.lower].middle[static_cast<size_t>(link.axis)] - (brick_size - 1);
}

int SupportParts::last_place(const SupportLink& link) const {
  return parts_[link.upper].middle[static_cast<size_t>(link.axis)];
}

std::pair<int, int> SupportParts::common_places(std::span<const SupportLink> links) const {
  int first = 1 - brick_size, last = brick_size - 1;
  for (const SupportLink& link : links) {
    first = std::max(first, first_place(link));
    last = std::min(last, last_place(link));
  }
  CHECK(first <= 0 && last >= 0);
  return {first, last};
}

SupportLink SupportParts::link_of(uint32_t lower, uint32_t upper, int axis) const {
  constexpr int full = brick_size * brick_size;
  SupportLink link{lower, upper, axis, 0, full};
  if (parts_[lower].voxels == full * brick_size && parts_[upper].voxels == full * brick_size) return link;
  link.section = section(link, 0);
  for (int at = first_place(link); at <= last_place(link); ++at) {
    const int there = section(link, at);
    const bool nearer = there == link.section && std::abs(at) < std::abs(link.at);
    if (there > link.section || (there == link.section && !nearer)) continue;
    link.section = there;
    link.at = at;
  }
  CHECK(link.section > 0);  // both parts connect from the face to their middles
  return link;
}

SectionVoxels SupportParts::section_voxels(const SupportLink& link, int at) const {
  CHECK_DEBUG(at > -brick_size && at < brick_size);
  const SupportPart& lower = parts_[link.lower];
  const SupportPart& upper = parts_[link.upper];
  if (at == 0) {
    // Found in the upper brick's first layer, one beyond.
    const BrickBits both = across(lower.bits, 2 * static_cast<size_t>(link.axis)) & upper.bits;
    VoxelCoord origin = first_voxel(upper.brick);
    (link.axis == 0 ? origin.x : link.axis == 1 ? origin.y : origin.z) -= 1;
    return {origin, both};
  }
  const SupportPart& part = at < 0 ? lower : upper;
  const int k = at < 0 ? brick_size - 1 + at : at - 1;
  return {first_voxel(part.brick), layer(followed(part.bits, link.axis), link.axis, k)};
}

VoxelBox SupportParts::section_box(std::span<const SupportLink> links, int at) const {
  VoxelBox all{{INT32_MAX, INT32_MAX, INT32_MAX}, {INT32_MIN, INT32_MIN, INT32_MIN}};
  for (const SupportLink& link : links) {
    const SectionVoxels voxels = section_voxels(link, at);
    if (!voxels.bits.any()) continue;
    const VoxelBox box = bounds_of(voxels.bits);
    all = hull_of(all, {box.lo + voxels.origin, box.hi + voxels.origin});
  }
  CHECK(!links.empty() && !all.empty());
  const int axis = links.front().axis;
  (axis == 0 ? all.hi.x : axis == 1 ? all.hi.y : all.hi.z) += 1;
  return all;
}

}  // namespace scree
