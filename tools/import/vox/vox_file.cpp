#include "tools/import/vox/vox_file.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

#include "shared/base/regular_file.h"
#include "tools/import/colour_rows.h"
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

/// By the map, by the palette's own names, or as new rows.
class ColourRows {
 public:
  ColourRows(const VoxImport& how, ImportPalette& palette)
      : how_(how), palette_(palette), had_(palette.palette().rows.size()) {}

  /// `voxels`: of that colour, at least one.
  void add(size_t number, const std::string& name, const std::array<uint8_t, 4>& srgb, uint64_t voxels) {
    for (const std::string& key : {std::to_string(number), name})
      if (const auto found = how_.map.find(key); found != how_.map.end()) {
        map_used.insert(key);
        return note(number, found->second);
      }
    if (const auto own = palette_.palette().named(name)) return note(number, *own);
    if (how_.material) return note(number, *how_.material);
    if (const auto row = palette_.meant(name)) meant_ += fmt::format("; '{}': did you mean {}?", name, *row);
    own_.push_back({name.empty() ? fmt::format("vox_{}", number) : name,
                    {linear_of_srgb(srgb[0]), linear_of_srgb(srgb[1]), linear_of_srgb(srgb[2])},
                    voxels});
    own_numbers_.push_back(number);
  }
  /// What each colour is of, after all were added.
  Result<std::array<VoxelMaterial, 256>> rows() {
    const auto own = TRY(rows_of_colours(own_, how_.colour_rows_max.value_or(own_.size()), palette_));
    for (size_t i = 0; i < own.size(); ++i) rows_[own_numbers_[i]] = own[i];
    return rows_;
  }
  std::string words() const {
    std::string words;
    if (!named_.empty())
      words +=
          fmt::format("; {} of its colours are materials of the palette: {}", named_.size(), list(named_));
    std::vector<Material> added;
    for (size_t i = had_; i < palette_.palette().rows.size(); ++i) added.push_back(static_cast<Material>(i));
    if (added.empty() && !own_.empty())
      words += fmt::format("; {} have no row: bulk, or the layers of the ground (--palette)", own_.size());
    if (added.empty()) return words;
    if (added.size() < own_.size())
      words += fmt::format("; {} became {} rows of the palette (--palette): {} (--material-map)", own_.size(),
                           added.size(), list(added));
    else
      words += fmt::format("; {} became rows of the palette: {} (--material-map)", added.size(), list(added));
    return words + meant_;
  }

  std::set<std::string> map_used;

 private:
  void note(size_t number, Material material) {
    named_.push_back(material);
    rows_[number] = said(material);
  }
  std::string list(const std::vector<Material>& materials) const {
    std::string text;
    for (size_t i = 0; i < std::min(materials.size(), names_said_max); ++i)
      text += (i > 0 ? ", " : "") + std::string(palette_.palette().name(materials[i]));
    return text + (materials.size() > names_said_max ? ", …" : "");
  }

  const VoxImport& how_;
  ImportPalette& palette_;
  const size_t had_;
  std::array<VoxelMaterial, 256> rows_{};
  std::vector<FileColour> own_;
  std::vector<size_t> own_numbers_;
  std::vector<Material> named_;
  std::string meant_;
};

Result<VoxSolid> vox_in(const std::string& path, const VoxImport& how, ImportPalette& palette) {
  const auto reader = TRY(ReaderProcess::start(
      "its reader", how.reader, [&](ReaderChannel& channel) { return send_vox(channel, path); },
      {.files = {path}}));
  const auto head = TRY(reader->get<VoxHead>());
  std::array<std::string, 256> names;
  for (std::string& name : names) name = TRY(reader->get_text());
  const auto sent = TRY(reader->get_list<SentBrick>(limits::vox_bricks_max));
  std::array<uint64_t, 256> used{};
  for (const SentBrick& brick : sent) {
    constexpr int far = static_cast<int>(4 * limits::vox_far_max);
    for (const int axis : {brick.at.x, brick.at.y, brick.at.z})
      if (axis < -far || axis > far) return fail("it has a brick that is none");
    for (const uint8_t colour : brick.colours) ++used[colour];
  }
  ColourRows colours(how, palette);
  for (size_t i = 1; i < used.size(); ++i)
    if (used[i] > 0) colours.add(i, names[i], head.colours[i], used[i]);
  const auto rows = TRY(colours.rows());
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
  solid.map_used = colours.map_used;
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
