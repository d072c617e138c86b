// Operations and volumes derived from a fuzzer's bytes, with ids and places so near each other that they
// meet.
#pragma once

#include "shared/operation/operation.h"
#include "tests/fuzz/support/any_request.h"

namespace scree {

inline PieceId any_piece(FuzzInput& input) {
  return input.below(64) == 63 ? input.number<uint32_t>() : input.below(24);
}

inline QuantisedPose any_pose(FuzzInput& input) {
  const auto axis = [&] { return static_cast<int32_t>(input.number<int16_t>()); };
  const int32_t x = axis();
  const int32_t y = axis();
  const int32_t z = axis();
  return {x, y, z, input.number<uint32_t>()};
}

inline VoxelCoord any_voxel(FuzzInput& input) {
  const auto axis = [&] {
    return input.below(32) == 31 ? input.number<int32_t>() / 64 : input.number<int8_t>() / 4;
  };
  const int32_t x = axis();
  const int32_t y = axis();
  return {x, y, axis()};
}

inline Window any_window(FuzzInput& input, int side_max) {
  const auto side = [&] { return static_cast<int32_t>(1 + input.below(static_cast<uint32_t>(side_max))); };
  const VoxelCoord lo{input.number<int8_t>() / 4, input.number<int8_t>() / 4, input.number<int8_t>() / 4};
  const VoxelBox box{lo, {lo.x + side(), lo.y + side(), lo.z + side()}};
  Window window(box, static_cast<Code>(input.number<int8_t>()));
  for (const uint8_t byte : input.packet()) {
    const size_t at = (static_cast<size_t>(byte) * 7) % window.codes.size();
    window.codes[at] = static_cast<Code>(input.number<int8_t>());
  }
  return window;
}

/// What a brick's voxels say: of one, or each its own.
inline BrickMaterials any_materials(FuzzInput& input) {
  if (input.flag()) return BrickMaterials(said(any_material(input)));
  VoxelMaterials voxels;
  for (VoxelMaterial& voxel : voxels) voxel = static_cast<VoxelMaterial>(input.below(3));
  return BrickMaterials(voxels);
}

inline std::optional<Material> any_fill_of_palette(FuzzInput& input) {
  return input.flag() ? std::optional(any_material(input)) : std::nullopt;
}

inline Volume any_volume(FuzzInput& input) {
  Volume volume;
  volume.window = any_window(input, 12);
  volume.mass = input.number<uint16_t>();
  volume.centre_voxels = input.place(8.0F);
  volume.materials.box = volume.window.box;
  volume.materials.all = any_material(input);
  if (volume.mass < 2 || !input.flag()) return volume;
  volume.materials.each.resize(volume.window.codes.size());
  for (Material& each : volume.materials.each) each = static_cast<Material>(input.below(3));
  volume.masses = {{material::rock, 1}, {material::ice, volume.mass - 1}};
  return volume;
}

inline CarveOperation any_carve_operation(FuzzInput& input) {
  const CarveRequest asked = known(any_carve(input));
  CarveOperation carve{
      asked.shape,      asked.pattern,          asked.seeds, asked.random_seed, asked.impact_m,
      any_piece(input), any_kind<Cutter>(input)};
  carve.authored_m = asked.authored_m;
  return carve;
}

inline StampOperation any_stamp(FuzzInput& input) {
  StampOperation stamp{any_piece(input), any_pose(input), input.number<int16_t>() / 4,
                       any_kind<StampMethod>(input)};
  for (uint32_t others = input.below(8) / 5 * input.below(4); others > 0; --others)
    stamp.others.push_back({any_piece(input), any_pose(input)});
  stamp.brings = static_cast<Brings>(input.below(3));
  return stamp;
}

inline Operation any_operation(FuzzInput& input) {
  switch (input.below(9)) {
    case 0:
      return FillOperation{known(any_shape(input)), any_fill_of_palette(input)};
    case 1:
      return any_stamp(input);
    case 2:
      return DiscardOperation{any_piece(input)};
    case 3: {
      ShatterOperation shatter{
          any_piece(input), any_kind<SeedPattern>(input), any_seeds(input), input.byte(), input.place(8.0F),
          any_piece(input), any_kind<Cutter>(input)};
      if (input.flag()) shatter.cut = PieceCut{known(any_shape(input)), any_pose(input)};
      return shatter;
    }
    case 4: {
      const VoxelCoord lo = any_voxel(input);
      const VoxelCoord size = any_voxel(input);
      const VoxelBox box{lo, {lo.x + size.x % 64, lo.y + size.y % 64, lo.z + size.z % 64}};
      return IslandOperation{box, input.flag() ? lo : any_voxel(input), any_piece(input)};
    }
    case 5:
      return PaintOperation{known(any_shape(input)), any_material(input), input.flag()};
    case 7:
      switch (input.below(4)) {
        case 3: {
          auto bricks = std::make_shared<std::vector<BrickPatch>>();
          const BrickCoord first = brick_of(any_voxel(input));
          for (uint32_t i = input.below(4); i > 0; --i)
            bricks->push_back({{first.x, first.y, first.z + static_cast<int32_t>(bricks->size())},
                               input.flag() ? air_brick() : solid_brick(),
                               {}});
          RestoreOperation restore{.bricks = std::move(bricks)};
          if (input.flag()) restore.pieces.push_back(any_piece(input));
          return restore;
        }
        case 0:
          return DigOperation{known(any_shape(input)), input.flag() ? any_piece(input) : 0};
        case 1:
          return PlaceOperation{known(any_shape(input)), any_material(input)};
        default:
          return any_carve_operation(input);
      }
    case 8: {
      const VoxelCoord lo = any_voxel(input);
      const auto cell = static_cast<uint8_t>(input.below(9));
      const auto side = [&] { return static_cast<int>(cell * input.below(8) + input.below(8) / 7); };
      const int x = side(), z = side();
      return SlideOperation{{lo, lo + VoxelCoord{x, static_cast<int>(input.below(130)), z}},
                            any_material(input),
                            static_cast<uint8_t>(input.below(129)),
                            cell};
    }
    default:
      return any_carve_operation(input);
  }
}

}  // namespace scree
