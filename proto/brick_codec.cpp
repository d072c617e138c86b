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

void append_codes(std::vector<uint8_t>& bytes, std::span<const Code> codes) {
  append_compressed(bytes, {reinterpret_cast<const uint8_t*>(codes.data()), codes.size()}, compression_level);
}

/// Writes the painted bricks' indices and materials.
void write_paint(ByteWriter& writer, std::span<const BrickView> bricks) {
  const auto is_painted = [](const BrickView& view) { return view.paint.has_value(); };
  writer.varint(static_cast<uint64_t>(std::ranges::count_if(bricks, is_painted)));
  size_t next = 0;
  for (size_t i = 0; i < bricks.size(); ++i) {
    if (!bricks[i].paint) continue;
    writer.varint(i - next);
    writer.u8(static_cast<uint8_t>(*bricks[i].paint));
    next = i + 1;
  }
}

void read_paint(ByteReader& reader, std::span<BrickPatch> bricks) {
  const uint64_t painted = reader.varint("number of painted bricks", bricks.size());
  size_t next = 0;
  for (uint64_t i = 0; i < painted && !reader.failed(); ++i) {
    const uint64_t skipped = reader.varint("bricks that are not painted");
    if (skipped >= bricks.size() - next) return reader.refuse("paint beyond the last brick");
    BrickPatch& patch = bricks[next + skipped];
    patch.paint = reader.kind<Material>("material");
    next += skipped + 1;
  }
}

/// Reads exactly codes.size() codes, with no bytes after them.
void decompress(ByteReader& reader, std::span<Code> codes) {
  const std::span<const uint8_t> packed = reader.rest();
  if (reader.failed()) return;
  if (ZSTD_getFrameContentSize(packed.data(), packed.size()) != codes.size()) {
    reader.refuse(fmt::format("compressed codes do not declare {} bytes", codes.size()));
    return;
  }
  const size_t frame = ZSTD_findFrameCompressedSize(packed.data(), packed.size());
  if (ZSTD_isError(frame) != 0U || frame != packed.size()) {
    reader.refuse("compressed codes are cut short or followed by more");
    return;
  }
  const size_t got = ZSTD_decompress(codes.data(), codes.size(), packed.data(), packed.size());
  if (ZSTD_isError(got) != 0U || got != codes.size()) reader.refuse("compressed codes are damaged");
  if (std::ranges::find(codes, Code{-128}) != codes.end()) reader.refuse("a code is -128, beyond ±127");
}

}  // namespace

std::vector<uint8_t> encode_bricks(std::span<const BrickView> bricks) {
  std::vector<uint8_t> bytes;
  if (bricks.empty()) return bytes;
  std::vector<BrickCoord> coords;
  std::vector<Code> codes;
  codes.reserve(bricks.size() * brick_voxels);
  for (const BrickView& view : bricks) {
    CHECK(view.brick != nullptr);
    coords.push_back(view.coord);
    codes.insert(codes.end(), view.brick->codes.begin(), view.brick->codes.end());
  }
  ByteWriter writer(bytes);
  writer.varint(bricks.size());
  write_coords<BrickTag>(writer, coords);
  write_paint(writer, bricks);
  append_codes(bytes, codes);
  return bytes;
}

std::vector<uint8_t> encode_bricks(std::span<const BrickPatch> bricks) {
  std::vector<BrickView> views;
  views.reserve(bricks.size());
  for (const BrickPatch& patch : bricks) views.push_back({patch.coord, &patch.brick, patch.paint});
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
  read_paint(reader, bricks);
  std::vector<Code> codes(count * brick_voxels);
  decompress(reader, codes);
  if (reader.failed()) return tl::unexpected(reader.error());
  for (size_t i = 0; i < count; ++i)
    std::memcpy(bricks[i].brick.codes.data(), codes.data() + i * brick_voxels, brick_voxels);
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
  writer.u8(static_cast<uint8_t>(volume.material));
  append_codes(bytes, volume.window.codes);
  return bytes;
}

Result<Volume> decode_volume(std::span<const uint8_t> bytes) {
  ByteReader reader(bytes, "volume of a piece");
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
  volume.material = reader.kind<Material>("material");
  if (reader.failed()) return tl::unexpected(reader.error());
  volume.window = Window(VoxelBox{lo, lo + size});
  decompress(reader, volume.window.codes);
  if (reader.failed()) return tl::unexpected(reader.error());
  return volume;
}

}  // namespace scree
