#include "tools/import/vox/vox_file.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

#include "shared/base/regular_file.h"
#include "tools/import/vox/limits.h"
#include "tools/import/vox/vox_bricks.h"
#include "tools/import/vox/voxel_solid.h"

namespace scree {

namespace {

/// Materials that a sentence names.
constexpr size_t names_said_max = 8;

struct SentBrick {
  BrickCoord at;
  VoxBrick colours;
};

struct VoxHead {
  uint64_t voxels = 0;
  uint64_t copies = 0;
  uint64_t hidden = 0;
  std::array<std::array<uint8_t, 4>, 256> colours{};
};

/// The child's part.
Result<void> send_vox(ReaderChannel& channel, const std::string& path) {
  const std::string bytes = TRY(read_bytes_of(path, limits::vox_file_bytes_max));
  const VoxScene scene = TRY(parse_vox({reinterpret_cast<const uint8_t*>(bytes.data()), bytes.size()}));
  const VoxBricks placed = TRY(placed_voxels(scene));
  TRY(channel.put(VoxHead{placed.voxels, placed.copies, placed.hidden, scene.colours}));
  for (int i = 0; i < 256; ++i) {
    const auto name = scene.names.find(i);
    TRY(channel.put_text(name == scene.names.end() ? std::string() : name->second));
  }
  std::vector<SentBrick> bricks;
  for (const auto& [at, colours] : placed.bricks) bricks.push_back({at, colours});
  return channel.put_list(bricks);
}

/// The world's voxels whose middles lie in a voxel of the file, along one axis: from the first to before the
/// last.
struct Range {
  int from = 0;
  int to = 0;
};

/// Where the file's voxels lie in the world. A voxel of either has its sample in its middle.
class VoxPlace {
 public:
  explicit VoxPlace(const VoxImport& how)
      : ratio_(how.has_scale ? how.place.scale / static_cast<double>(how.voxel_size_m) : 1.0) {
    for (size_t i = 0; i < 3; ++i) shift_[i] = how.place.at_m[i] / static_cast<double>(how.voxel_size_m);
  }
  double ratio() const { return ratio_; }
  Range range(size_t axis, int own) const {
    const auto edge = [&](int at) {
      return static_cast<int>(std::clamp(std::ceil(at * ratio_ + shift_[axis] - 0.5), -1e8, 1e8));
    };
    return {edge(own), edge(own + 1)};
  }

 private:
  double ratio_;
  std::array<double, 3> shift_{};
};

/// The voxels of a box become that colour. False: there are more bricks than may be.
bool fill_box(ColouredBricks& bricks, const VoxelBox& box, uint8_t colour) {
  bool fits = true;
  for_each_brick(box, [&](BrickCoord coord) {
    fits = fits && (bricks.size() < limits::vox_bricks_max || bricks.contains(coord));
    if (!fits) return;
    auto& brick = bricks[coord];
    const VoxelCoord first = first_voxel(coord);
    const VoxelBox part = common(box, {first, first + VoxelCoord{brick_size, brick_size, brick_size}});
    for (int x = part.lo.x; x < part.hi.x; ++x)
      for (int y = part.lo.y; y < part.hi.y; ++y)
        for (int z = part.lo.z; z < part.hi.z; ++z)
          brick[static_cast<size_t>(Brick::index(x & 7, y & 7, z & 7))] = colour;
  });
  return fits;
}

Result<ColouredBricks> in_world(const std::vector<SentBrick>& sent, const VoxPlace& place) {
  ColouredBricks bricks;
  for (const SentBrick& brick : sent)
    for (int i = 0; i < brick_voxels; ++i) {
      const uint8_t colour = brick.colours[static_cast<size_t>(i)];
      if (colour == 0) continue;
      const VoxelCoord own = first_voxel(brick.at) + VoxelCoord{i >> 6, (i >> 3) & 7, i & 7};
      const Range xs = place.range(0, own.x), ys = place.range(1, own.y), zs = place.range(2, own.z);
      const VoxelBox box{{xs.from, ys.from, zs.from}, {xs.to, ys.to, zs.to}};
      if (!box.empty() && !fill_box(bricks, box, colour))
        return fail(
            fmt::format("in the world, its voxels lie in more than {} bricks of 8 a side "
                        "(limits.vox_bricks_max); a smaller --scale makes fewer",
                        limits::vox_bricks_max));
    }
  return bricks;
}

struct UsedColours {
  std::array<VoxelMaterial, 256> rows{};
  std::string words;
};

/// By the map, by the palette's own names, or as a new row.
class ColourRows {
 public:
  ColourRows(const VoxImport& how, ImportPalette& palette) : how_(how), palette_(palette) {}

  Result<VoxelMaterial> row(int number, const std::string& name, const std::array<uint8_t, 4>& srgb) {
    for (const std::string& key : {std::to_string(number), name})
      if (const auto found = how_.map.find(key); found != how_.map.end()) return note(found->second, named_);
    if (const auto own = palette_.palette().named(name)) return note(*own, named_);
    if (how_.material) return note(*how_.material, named_);
    const Material added = TRY(palette_.add(
        row_of_colour(name.empty() ? fmt::format("vox_{}", number) : name,
                      {linear_of_srgb(srgb[0]), linear_of_srgb(srgb[1]), linear_of_srgb(srgb[2])})));
    return note(added, added_);
  }
  std::string words() const {
    std::string words;
    if (!named_.empty())
      words +=
          fmt::format("; {} of its colours are materials of the palette: {}", named_.size(), list(named_));
    if (!added_.empty())
      words +=
          fmt::format("; {} became rows of the palette: {} (--material-map)", added_.size(), list(added_));
    return words;
  }

 private:
  static VoxelMaterial note(Material material, std::vector<Material>& to) {
    to.push_back(material);
    return said(material);
  }
  std::string list(const std::vector<Material>& materials) const {
    std::string text;
    for (size_t i = 0; i < std::min(materials.size(), names_said_max); ++i)
      text += (i > 0 ? ", " : "") + std::string(palette_.palette().name(materials[i]));
    return text + (materials.size() > names_said_max ? ", …" : "");
  }

  const VoxImport& how_;
  ImportPalette& palette_;
  std::vector<Material> named_, added_;
};

Result<VoxSolid> vox_in(const std::string& path, const VoxImport& how, ImportPalette& palette) {
  const auto reader = TRY(ReaderProcess::start(
      "its reader", how.reader, [&](ReaderChannel& channel) { return send_vox(channel, path); },
      {.files = {path}}));
  const auto head = TRY(reader->get<VoxHead>());
  std::array<std::string, 256> names;
  for (std::string& name : names) name = TRY(reader->get_text());
  const auto sent = TRY(reader->get_list<SentBrick>(limits::vox_bricks_max));
  std::array<bool, 256> used{};
  for (const SentBrick& brick : sent) {
    constexpr int far = static_cast<int>(4 * limits::vox_far_max);
    for (const int axis : {brick.at.x, brick.at.y, brick.at.z})
      if (axis < -far || axis > far) return fail("it has a brick that is none");
    for (const uint8_t colour : brick.colours) used[colour] = true;
  }
  ColourRows colours(how, palette);
  std::array<VoxelMaterial, 256> rows{};
  for (int i = 1; i < 256; ++i)
    if (const auto at = static_cast<size_t>(i); used[at])
      rows[at] = TRY(colours.row(i, names[at], head.colours[at]));
  const VoxPlace place(how);
  if (!(place.ratio() <= limits::vox_ratio_max))
    return fail(
        fmt::format("a voxel of it is as wide as {:.4g} of the world's, more than {} (--scale, --voxel-size)",
                    place.ratio(), limits::vox_ratio_max));
  ColouredBricks bricks = TRY(in_world(sent, place));
  if (bricks.empty() && head.voxels > 0) return fail("its voxels are so small that none is left (--scale)");
  VoxSolid solid{.voxels = head.voxels, .copies = head.copies, .hidden = head.hidden};
  const double side_m = place.ratio() * static_cast<double>(how.voxel_size_m);
  solid.own_volume_m3 = static_cast<double>(head.voxels) * side_m * side_m * side_m;
  solid.materials = colours.words();
  solid.solid = TRY(solid_of_voxels(std::move(bricks), rows, how.voxel_size_m));
  return solid;
}

}  // namespace

Result<VoxSolid> read_vox(const std::string& path, const VoxImport& how, ImportPalette& palette) {
  try {
    TRY(check_is_small_file(path, limits::vox_file_bytes_max));
    auto read = vox_in(path, how, palette);
    if (!read) return fail(path + ": " + read.error().message);
    return read;
  } catch (const std::bad_alloc&) {
    return fail(path + ": it does not fit into memory (--memory-max)");
  }
}

}  // namespace scree
