#include "tools/place/placed_piece.h"

#include <algorithm>
#include <fmt/format.h>
#include <limits>

#include "shared/base/check.h"
#include "shared/operation/added_piece_limits.h"

namespace scree {

namespace {

/// Around the rock, so that its surface lies in the box.
constexpr int air_layer = 1;

/// The whole of all solids with a layer of air, in voxels.
Result<VoxelBox> box_of_all(const SolidsRead& read) {
  std::optional<VoxelBox> box;
  for (const auto& solid : read.solids)
    if (!solid->box().empty()) box = box ? hull_of(*box, solid->box()) : solid->box();
  if (!box) return fail("there is no rock in it");
  const VoxelBox with_air = box->grown(air_layer);
  const VoxelCoord size = with_air.size();
  const std::string words =
      fmt::format("with a layer of air it takes {} x {} x {} voxels of the world", size.x, size.y, size.z);
  const char* const help = "--scale makes it smaller, and scree import makes ground of what is large";
  if (std::max({size.x, size.y, size.z}) > limits::added_piece_side_max)
    return fail(fmt::format("{}, and a piece is at most {} long (limits.added_piece_side_max): {}", words,
                            limits::added_piece_side_max, help));
  if (Window::count(with_air) > limits::added_piece_voxels_max)
    return fail(fmt::format("{}, and a piece has at most {} (limits.added_piece_voxels_max): {}", words,
                            limits::added_piece_voxels_max, help));
  return with_air;
}

/// The least of all solids' levels in a box, and the solid that has it.
struct Levels {
  std::vector<float> each;
  std::vector<size_t> owner;
};

Levels levels_of(const SolidsRead& read, const VoxelBox& box) {
  Levels levels{std::vector<float>(Window::count(box), std::numeric_limits<float>::max()),
                std::vector<size_t>(Window::count(box), 0)};
  std::vector<float> own(levels.each.size());
  for (size_t n = 0; n < read.solids.size(); ++n) {
    read.solids[n]->read_levels(box, own);
    for (size_t i = 0; i < own.size(); ++i) {
      if (own[i] >= levels.each[i]) continue;
      levels.each[i] = own[i];
      levels.owner[i] = n;
    }
  }
  return levels;
}

/// Whether a voxel has a neighbour on the other side of the surface.
bool is_at_surface(const Window& window, VoxelCoord v) {
  const bool solid = window.at(v.x, v.y, v.z) < 0;
  const auto differs = [&](VoxelCoord there) {
    return window.box.holds(there) ? (window.at(there.x, there.y, there.z) < 0) != solid : solid;
  };
  for (const int step : {-1, 1})
    if (differs({v.x + step, v.y, v.z}) || differs({v.x, v.y + step, v.z}) || differs({v.x, v.y, v.z + step}))
      return true;
  return false;
}

template <typename F>
void for_each_of(const VoxelBox& box, F&& f) {
  size_t at = 0;
  for (int x = box.lo.x; x < box.hi.x; ++x)
    for (int y = box.lo.y; y < box.hi.y; ++y)
      for (int z = box.lo.z; z < box.hi.z; ++z) f(VoxelCoord{x, y, z}, at++);
}

Window surface_alone(const Window& window) {
  Window plain = window;
  for_each_of(window.box, [&](VoxelCoord v, size_t at) {
    if (!is_at_surface(window, v)) plain.codes[at] = window.codes[at] < 0 ? code_solid : code_air;
  });
  return plain;
}

/// What the rows of the import are in the world, and words on those that it does not have.
class WorldRows {
 public:
  WorldRows(const SolidsRead& read, const Palette& world, Material otherwise)
      : read_(read), world_(world), otherwise_(otherwise) {
    for (size_t row = 0; row < rows_.size(); ++row) rows_[row] = static_cast<Material>(row);
    for (size_t row = world.rows.size(); row < read.palette->rows.size(); ++row)
      rows_[row] = nearest_by_colour(read.palette->rows[row].look.colour, world);
  }

  Material of(VoxelCoord voxel, size_t owner) {
    const VoxelMaterial said = read_.solids[owner]
                                   ->materials(brick_of(voxel))
                                   .at(Brick::index(voxel.x & 7, voxel.y & 7, voxel.z & 7));
    if (said == ground_own) {
      ++silent_;
      return otherwise_;
    }
    const size_t row = row_number(material_of(said));
    ++used_[row];
    return rows_[row];
  }

  std::vector<std::string> words() const {
    std::vector<std::string> said;
    if (silent_ > 0)
      said.push_back(fmt::format("{} of its voxels name no material: taken as {} (--material)", silent_,
                                 world_.name(otherwise_)));
    for (size_t row = world_.rows.size(); row < read_.palette->rows.size(); ++row)
      if (used_[row] > 0)
        said.push_back(fmt::format("{} is no material of this world: taken as {}, by its colour (--material)",
                                   read_.palette->rows[row].name, world_.name(rows_[row])));
    return said;
  }

 private:
  const SolidsRead& read_;
  const Palette& world_;
  const Material otherwise_;
  std::array<Material, 256> rows_{};
  std::array<size_t, 256> used_{};
  size_t silent_ = 0;
};

}  // namespace

Material nearest_by_colour(const std::array<float, 3>& linear, const Palette& palette) {
  Material nearest{};
  int least = std::numeric_limits<int>::max();
  for (size_t row = 0; row < palette.rows.size(); ++row) {
    if (palette.rows[row].rubble) continue;
    int off = 0;
    for (size_t channel = 0; channel < linear.size(); ++channel) {
      const int step =
          int{srgb_of_linear(linear[channel])} - int{srgb_of_linear(palette.rows[row].look.colour[channel])};
      off += step * step;
    }
    if (off >= least) continue;
    least = off;
    nearest = static_cast<Material>(row);
  }
  return nearest;
}

Result<PlacedPiece> placed_piece(const SolidsRead& read, const Palette& world, Material otherwise) {
  const auto box = TRY(box_of_all(read));
  const Levels levels = levels_of(read, box);
  Window window(box);
  std::ranges::transform(levels.each, window.codes.begin(), [](float level) { return encode(level); });
  window = surface_alone(window);
  PlacedPiece placed;
  WorldRows rows(read, world, otherwise);
  std::vector<Material> each(window.codes.size());
  for_each_of(box, [&](VoxelCoord v, size_t at) {
    if (window.codes[at] >= 0) return;
    each[at] = rows.of(v, levels.owner[at]);
    ++placed.voxels;
  });
  if (placed.voxels == 0) return fail("there is no rock in it, or it is thinner than a voxel (--scale)");
  placed.said = rows.words();
  const VoxelCoord size = box.size();
  const VoxelCoord foot{size.x / 2, air_layer, size.z / 2};
  const VoxelBox there{VoxelCoord{} - foot, size - foot};
  placed.foot_voxels = {0.5F * static_cast<float>(size.x - 1) - static_cast<float>(foot.x), -0.5F,
                        0.5F * static_cast<float>(size.z - 1) - static_cast<float>(foot.z)};
  window.box = there;
  placed.volume.materials = {there, Material{}, std::move(each)};
  placed.volume.masses = masses_of(window, placed.volume.materials);
  placed.volume.mass = mass_of(window);
  placed.volume.window = std::move(window);
  if (placed.volume.masses.size() == 1) {
    placed.volume.materials = {there, placed.volume.masses.front().material, {}};
    placed.volume.masses.clear();
  }
  return placed;
}

}  // namespace scree
