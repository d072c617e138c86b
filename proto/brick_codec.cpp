// Bricks and volumes: coordinates packed, codes compressed with zstd.
#include <algorithm>
#include <cstring>
#include <fmt/format.h>
#include <unordered_set>
#include <zstd.h>

#include "proto/byte_stream.h"
#include "proto/compressed.h"
#include "proto/operation_codec.h"
#include "shared/base/check.h"
#include "shared/base/limits.h"

namespace scree {

namespace {

// zstd's default; 8-bit bricks come to half their size, and higher levels gain a few per cent for ten times
// the work.
constexpr int compression_level = 3;

constexpr int32_t brick_coordinate_max = limits::voxel_coordinate_max / brick_size;

std::span<const uint8_t> bytes_of(std::span<const Code> codes) {
  return {reinterpret_cast<const uint8_t*>(codes.data()), codes.size()};
}

/// In place of a material's number: each voxel has its own, among the compressed bytes.
constexpr uint8_t each_its_own = 255;
static_assert(each_its_own >= materials_max);

/// Writes the indices of bricks that say something of their materials, and the material or each_its_own.
void write_materials(ByteWriter& writer, std::span<const BrickView> bricks) {
  const auto says = [](const BrickView& view) { return !view.materials.is_ground(); };
  writer.varint(static_cast<uint64_t>(std::ranges::count_if(bricks, says)));
  size_t next = 0;
  for (size_t i = 0; i < bricks.size(); ++i) {
    const BrickMaterials& materials = bricks[i].materials;
    if (materials.is_ground()) continue;
    writer.varint(i - next);
    const bool one = materials.is_uniform();
    writer.u8(one ? static_cast<uint8_t>(material_of(materials.uniform())) : each_its_own);
    next = i + 1;
  }
}

/// Reads what write_materials() wrote; returns the indices of bricks whose voxels have each their own.
std::vector<size_t> read_materials(ByteReader& reader, std::span<BrickPatch> bricks) {
  std::vector<size_t> mixed;
  const uint64_t saying = reader.varint("number of bricks with materials", bricks.size());
  size_t next = 0;
  for (uint64_t i = 0; i < saying && !reader.failed(); ++i) {
    const uint64_t skipped = reader.varint("bricks without materials");
    if (skipped >= bricks.size() - next) {
      reader.refuse("materials beyond the last brick");
      break;
    }
    const uint8_t material = reader.u8("material", each_its_own);
    next += skipped + 1;
    if (material == each_its_own)
      mixed.push_back(next - 1);
    else
      bricks[next - 1].materials = BrickMaterials(said(static_cast<Material>(material)));
  }
  return mixed;
}

/// Reads exactly so many bytes, with none after them: `codes` codes first.
std::vector<uint8_t> decompress(ByteReader& reader, size_t size, size_t codes) {
  std::vector<uint8_t> content;
  const std::span<const uint8_t> packed = reader.rest();
  if (reader.failed()) return content;
  if (ZSTD_getFrameContentSize(packed.data(), packed.size()) != size) {
    reader.refuse(fmt::format("compressed codes do not declare {} bytes", size));
    return content;
  }
  const size_t frame = ZSTD_findFrameCompressedSize(packed.data(), packed.size());
  if (ZSTD_isError(frame) != 0U || frame != packed.size()) {
    reader.refuse("compressed codes are cut short or followed by more");
    return content;
  }
  content.resize(size);
  const size_t got = ZSTD_decompress(content.data(), content.size(), packed.data(), packed.size());
  if (ZSTD_isError(got) != 0U || got != content.size()) reader.refuse("compressed codes are damaged");
  const std::span<const uint8_t> first(content.data(), codes);
  if (std::ranges::find(first, uint8_t{0x80}) != first.end()) reader.refuse("a code is -128, beyond ±127");
  return content;
}

void write_masses(ByteWriter& writer, const MaterialMasses& masses) {
  writer.varint(masses.size());
  for (const MaterialMass& one : masses) {
    writer.u8(static_cast<uint8_t>(one.material));
    writer.varint(static_cast<uint64_t>(one.mass));
  }
}

/// In order of rows, each positive, and together the volume's mass: at least two, as a piece that is all of
/// one material names it instead. Its voxels do not bound them: what a cut took beside a piece's window
/// counts for some piece, too (shared/fracture/material_shares.h).
MaterialMasses read_masses(ByteReader& reader, MassUnits sum) {
  MaterialMasses masses;
  const uint64_t count = reader.varint("number of a piece's materials", materials_max);
  MassUnits left = sum;
  for (uint64_t i = 0; i < count && !reader.failed(); ++i) {
    const auto material = static_cast<Material>(reader.u8("material of a piece", materials_max - 1));
    const auto mass = static_cast<MassUnits>(
        reader.varint("mass of a piece's material", static_cast<uint64_t>(std::max<MassUnits>(left, 0))));
    if (mass == 0) reader.refuse("a piece has a material without mass");
    if (!masses.empty() && material <= masses.back().material)
      reader.refuse("a piece's materials are not in order");
    masses.push_back({material, mass});
    left -= mass;
  }
  if (left != 0 || masses.empty()) reader.refuse("a piece's materials do not add up to its mass");
  if (masses.size() == 1) reader.refuse("a piece lists one material, which it is to name instead");
  return masses;
}

/// What each voxel of a piece is of: after the codes.
Result<void> read_each(std::span<const uint8_t> content, size_t voxels, Volume& volume) {
  std::vector<Material>& each = volume.materials.each;
  each.resize(voxels);
  std::memcpy(each.data(), content.data() + voxels, voxels);
  if (std::ranges::any_of(each, [](Material m) { return row_number(m) >= materials_max; }))
    return fail("volume of a piece: a voxel has material 255, beyond a palette's last");
  if (std::ranges::any_of(each, [&](Material m) { return m != each.front(); })) return {};
  volume.materials.all = each.front();
  each.clear();
  return {};
}

constexpr const char* subject_volume = "volume of a piece";

VoxelBox read_volume_box(ByteReader& reader) {
  const VoxelCoord lo = read_coord(reader, VoxelCoord{}, limits::voxel_coordinate_max, "corner");
  const auto side = [&] {
    const auto length = static_cast<int32_t>(reader.varint("side", limits::window_side_max));
    if (length == 0) reader.refuse("a side of no voxels");
    return length;
  };
  VoxelCoord size;
  size.x = side();
  size.y = side();
  size.z = side();
  return {lo, lo + size};
}

}  // namespace

std::vector<uint8_t> encode_bricks(std::span<const BrickView> bricks) {
  std::vector<uint8_t> bytes;
  if (bricks.empty()) return bytes;
  std::vector<BrickCoord> coords;
  std::vector<uint8_t> content;
  content.reserve(bricks.size() * brick_voxels);
  for (const BrickView& view : bricks) {
    CHECK(view.brick != nullptr);
    coords.push_back(view.coord);
    const std::span<const uint8_t> codes = bytes_of(view.brick->codes);
    content.insert(content.end(), codes.begin(), codes.end());
  }
  for (const BrickView& view : bricks) {
    if (view.materials.is_uniform()) continue;
    const VoxelMaterials voxels = view.materials.unpacked();
    content.insert(content.end(), voxels.begin(), voxels.end());
  }
  ByteWriter writer(bytes);
  writer.varint(bricks.size());
  write_coords<BrickTag>(writer, coords);
  write_materials(writer, bricks);
  append_compressed(bytes, content, compression_level);
  return bytes;
}

std::vector<uint8_t> encode_bricks(std::span<const BrickPatch> bricks) {
  std::vector<BrickView> views;
  views.reserve(bricks.size());
  for (const BrickPatch& patch : bricks) views.push_back({patch.coord, &patch.brick, patch.materials});
  return encode_bricks(views);
}

Result<std::vector<BrickPatch>> decode_bricks(std::span<const uint8_t> bytes, size_t count_max) {
  std::vector<BrickPatch> bricks;
  if (bytes.empty()) return bricks;
  ByteReader reader(bytes, "bricks");
  const size_t count = reader.varint("number of bricks", count_max);
  if (!reader.failed() && count == 0) reader.refuse("a list of no bricks is not empty");
  // A coordinate takes at least three bytes: a count that the bytes cannot hold is refused before the
  // allocation.
  if (count * 3 > bytes.size()) reader.refuse("ends within coordinates");
  if (reader.failed()) return tl::unexpected(reader.error());
  bricks.resize(count);
  std::unordered_set<BrickCoord, CoordHash> seen;
  BrickCoord before;
  for (BrickPatch& patch : bricks) {
    before = patch.coord = read_coord(reader, before, brick_coordinate_max, "brick coordinate");
    if (!reader.failed() && !seen.insert(patch.coord).second) reader.refuse("a brick comes twice");
  }
  const std::vector<size_t> mixed = read_materials(reader, bricks);
  const std::vector<uint8_t> content =
      decompress(reader, (count + mixed.size()) * brick_voxels, count * brick_voxels);
  if (reader.failed()) return tl::unexpected(reader.error());
  for (size_t i = 0; i < count; ++i)
    std::memcpy(bricks[i].brick.codes.data(), content.data() + i * brick_voxels, brick_voxels);
  for (size_t i = 0; i < mixed.size(); ++i) {
    VoxelMaterials voxels;
    std::memcpy(voxels.data(), content.data() + (count + i) * brick_voxels, brick_voxels);
    bricks[mixed[i]].materials = BrickMaterials(voxels);
    if (bricks[mixed[i]].materials.is_uniform())
      return fail("bricks: voxels with materials of their own are all of one");
  }
  return bricks;
}

std::vector<uint8_t> encode_volume(const Volume& volume) {
  std::vector<uint8_t> bytes;
  ByteWriter writer(bytes);
  CHECK(volume.mass >= 0 && volume.window.codes.size() == Window::count(volume.window.box));
  const VoxelBox& box = volume.window.box;
  const VoxelCoord size = box.size();
  for (const int32_t number : {box.lo.x, box.lo.y, box.lo.z}) writer.zigzag(number);
  for (const int32_t side : {size.x, size.y, size.z}) writer.varint(static_cast<uint64_t>(side));
  writer.varint(static_cast<uint64_t>(volume.mass));
  writer.vec3(volume.centre_voxels);
  const bool one = volume.materials.is_uniform() && volume.masses.empty();
  writer.u8(one ? static_cast<uint8_t>(volume.materials.all) : each_its_own);
  std::vector<uint8_t> content(bytes_of(volume.window.codes).begin(), bytes_of(volume.window.codes).end());
  if (!one) {
    write_masses(writer, masses_of(volume));
    for (size_t i = 0; i < volume.window.codes.size(); ++i)
      content.push_back(static_cast<uint8_t>(volume.materials.at(i)));
  }
  append_compressed(bytes, content, compression_level);
  return bytes;
}

Result<Volume> decode_volume(std::span<const uint8_t> bytes) {
  ByteReader reader(bytes, subject_volume);
  const VoxelBox box = read_volume_box(reader);
  const VoxelCoord lo = box.lo, size = box.size();
  constexpr auto side_max = static_cast<uint64_t>(limits::window_side_max);
  Volume volume;
  volume.mass =
      static_cast<MassUnits>(reader.varint("mass", side_max * side_max * side_max * units_per_voxel));
  volume.centre_voxels = reader.vec3("centre of mass");
  const auto inside = [](float centre, int32_t first, int32_t count) {
    return centre >= static_cast<float>(first) && centre <= static_cast<float>(first + count);
  };
  const glm::vec3 centre = volume.centre_voxels;
  if (!inside(centre.x, lo.x, size.x) || !inside(centre.y, lo.y, size.y) || !inside(centre.z, lo.z, size.z))
    reader.refuse("centre of mass is outside the window");
  const uint8_t material = reader.u8("material", each_its_own);
  const bool one = material != each_its_own;
  if (one)
    volume.materials.all = static_cast<Material>(material);
  else
    volume.masses = read_masses(reader, volume.mass);
  if (reader.failed()) return tl::unexpected(reader.error());
  volume.window = Window(box);
  volume.materials.box = volume.window.box;
  const size_t voxels = volume.window.codes.size();
  const std::vector<uint8_t> content = decompress(reader, one ? voxels : 2 * voxels, voxels);
  if (reader.failed()) return tl::unexpected(reader.error());
  std::memcpy(volume.window.codes.data(), content.data(), voxels);
  if (one) return volume;
  TRY(read_each(content, voxels, volume));
  return volume;
}

Result<VoxelBox> decode_volume_box(std::span<const uint8_t> bytes) {
  ByteReader reader(bytes, subject_volume);
  const VoxelBox box = read_volume_box(reader);
  if (reader.failed()) return tl::unexpected(reader.error());
  return box;
}

}  // namespace scree
