// Requests derived from a fuzzer's bytes: mostly of the sizes that people ask for, so that they are carried
// out, and now and then of any numbers. Lengths in metres.
#pragma once

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <string>
#include <vector>

#include "content/builtin_palette.h"
#include "server/world/settings.h"
#include "shared/base/limits.h"
#include "shared/operation/request.h"
#include "shared/region/limits.h"
#include "tests/fuzz/support/fuzz_input.h"
#include "tests/support/given_voxels.h"
#include "tests/support/materials.h"

namespace scree {

/// Edits lie so near each other that they meet, and mostly within one column of chunks of 32 m, or four of
/// 16 m: to generate chunks is most of what an input costs.
inline constexpr glm::vec3 fuzz_centre_m{16.0F, 0.0F, 16.0F};
inline constexpr float fuzz_reach_m = 11.0F;

inline glm::vec3 any_place(FuzzInput& input) {
  return fuzz_centre_m + input.place(fuzz_reach_m);
}

template <HasRows Kind>
Kind any_kind(FuzzInput& input) {
  return static_cast<Kind>(input.byte() % kind_count<Kind>);
}
/// Or sometimes one that is not known.
template <HasRows Kind>
Kind any_number_as(FuzzInput& input) {
  return input.below(32) == 31 ? static_cast<Kind>(input.byte()) : any_kind<Kind>(input);
}

inline Shape any_shape(FuzzInput& input) {
  Shape shape;
  shape.kind = any_number_as<ShapeKind>(input);
  shape.a = any_place(input);
  shape.b = shape.kind == ShapeKind::box ? input.place(4.0F) : shape.a + input.place(3.0F);
  shape.radius_m = input.coordinate(4.0F);
  if (input.below(16) == 15) return shape;
  shape.radius_m = std::abs(shape.radius_m);
  if (shape.kind == ShapeKind::box) shape.b = glm::abs(shape.b);
  return shape;
}

/// Few, or sometimes as many as any number says.
inline uint32_t any_seeds(FuzzInput& input) {
  return input.below(64) == 63 ? input.number<uint32_t>() : input.below(24);
}

inline std::vector<glm::vec3> any_points(FuzzInput& input, uint32_t count) {
  std::vector<glm::vec3> points;
  for (uint32_t i = 0; i < count; ++i) points.push_back(any_place(input));
  return points;
}

inline CarveRequest any_carve(FuzzInput& input) {
  CarveRequest carve;
  carve.shape = any_shape(input);
  carve.pattern = any_number_as<SeedPattern>(input);
  carve.seeds = any_seeds(input);
  carve.random_seed = input.byte();
  carve.impact_m = any_place(input);
  carve.blast_speed_m_s = std::abs(input.coordinate(12.0F));
  const bool given = carve.pattern == SeedPattern::authored;
  carve.authored_m = any_points(input, given ? std::min(carve.seeds, 16U) : input.below(32) / 31);
  return carve;
}

/// Encoders trust the kinds of what they encode.
inline Shape known(Shape shape) {
  if (!is_known(shape.kind)) shape.kind = ShapeKind::sphere;
  return shape;
}
inline CarveRequest known(CarveRequest carve) {
  carve.shape = known(carve.shape);
  if (!is_known(carve.pattern)) carve.pattern = SeedPattern::uniform;
  return carve;
}

/// A value of the row, or a number near its bounds, or any text.
inline std::string any_value(FuzzInput& input, const Setting& row) {
  if (input.below(8) == 7) return input.text(limits::setting_value_bytes_max);
  if (!row.choices.empty()) return std::string(row.choices[input.below(256) % row.choices.size()]);
  if (row.is_text())
    return text_of(Spawn{{input.coordinate(5000.0F), input.coordinate(600.0F), input.coordinate(5000.0F)},
                         input.coordinate(400.0F),
                         input.coordinate(100.0F)});
  const double near = input.flag() ? row.bounds.min : row.bounds.max;
  return std::to_string(near + input.coordinate(100.0F));
}

inline SettingValues any_settings(FuzzInput& input) {
  SettingValues values;
  for (uint32_t count = 1 + input.below(3); count > 0; --count) {
    const Setting& row = settings()[input.byte() % settings().size()];
    std::string name(row.name);
    if (input.below(16) == 15) name = input.text(limits::setting_name_bytes_max);
    values.push_back({std::move(name), any_value(input, row)});
  }
  return values;
}

/// A row of the built-in palette, or one beyond it.
inline Material any_material(FuzzInput& input) {
  return static_cast<Material>(input.below(static_cast<uint32_t>(builtin_palette().rows.size()) + 1));
}
/// The same, or any number.
inline Material any_number_of_material(FuzzInput& input) {
  return input.below(32) == 31 ? static_cast<Material>(input.byte()) : any_material(input);
}
inline std::optional<Material> any_fill(FuzzInput& input) {
  return input.flag() ? std::optional(any_number_of_material(input)) : std::nullopt;
}

/// A small volume of full voxels, or of any codes, and now and then bytes that are none.
inline AddPieceRequest any_added_piece(FuzzInput& input) {
  const auto side = [&] { return 1 + static_cast<int>(input.below(7)); };
  const VoxelCoord size{side(), side(), side()};
  const uint32_t how = input.below(4);
  Volume volume = given_voxels(size, [&](VoxelCoord) -> std::optional<Material> {
    const uint8_t byte = input.byte();
    if (how == 0 || byte % 4 != 0) return Material{static_cast<uint8_t>(how == 1 ? byte / 4 : 0)};
    return std::nullopt;
  });
  if (how == 2)
    for (Code& code : volume.window.codes) code = std::max<Code>(static_cast<Code>(input.byte()), -127);
  AddPieceRequest add = piece_of(volume, any_place(input));
  if (input.below(16) == 15) add.volume = nullptr;
  if (input.flag()) add.turn = {0.6F, 0.0F, 0.8F, 0.0F};
  if (input.flag()) add.velocity_m_s = input.place(20.0F);
  if (input.flag()) add.spin_rad_s = input.place(5.0F);
  add.kept = input.flag();
  return add;
}

/// A region about where things happen, sane or not; its name is one of a few.
inline Region any_region(FuzzInput& input) {
  Region region;
  region.name = std::string(1, static_cast<char>('a' + input.below(4)));
  if (input.below(16) == 15) region.name = input.text(limits::region_name_bytes_max + 4);
  region.form = input.below(16) == 15 ? static_cast<RegionForm>(input.byte())
                                      : static_cast<RegionForm>(input.below(kind_count<RegionForm>));
  region.centre_m = any_place(input);
  region.half_m = glm::abs(input.place(input.flag() ? 8.0F : 600.0F));
  region.forbids = static_cast<uint8_t>(input.below(20));
  region.editors = static_cast<RegionEditors>(input.below(kind_count<RegionEditors> + 1));
  region.role = static_cast<Role>(input.below(6));
  region.tells = input.flag();
  region.counts = input.flag();
  if (input.below(8) == 7) region.teams = {"red"};
  return region;
}

inline Request any_region_request(FuzzInput& input) {
  if (input.below(4) == 3)
    return RemoveRegionRequest{std::string(1, static_cast<char>('a' + input.below(4)))};
  return SetRegionRequest{any_region(input), input.flag() ? 0.0F : input.coordinate(10.0F)};
}

inline StandRequest any_stand(FuzzInput& input) {
  StandRequest stand;
  if (input.flag()) stand.place_m = input.place(20.0F);
  stand.away = input.below(4) == 3;
  return stand;
}

inline WalkRequest any_walk(FuzzInput& input) {
  WalkRequest walk;
  walk.input = {input.place(1.2F), input.flag(), input.flag()};
  if (input.below(8) == 7) walk.look = input.place(1.0F);
  return walk;
}

inline StoreName any_store(FuzzInput& input) {
  StoreName store{any_number_as<StoreKind>(input), input.below(3)};
  if (store.kind == StoreKind::named) store = named_store(input.text(limits::store_name_bytes_max));
  if (store.kind == StoreKind::own || store.kind == StoreKind::world) store.number = input.below(32) / 31;
  return store;
}

/// A transfer, or a dig or place of terrain or of a piece.
inline Request any_store_request(FuzzInput& input, PieceId piece) {
  switch (input.below(4)) {
    case 0: {
      TransferRequest transfer{any_store(input), any_store(input)};
      if (input.flag()) transfer.material = any_number_of_material(input);
      if (input.flag()) transfer.mass = input.flag() ? input.below(256) : input.number<int64_t>();
      return transfer;
    }
    case 1:
      return PlaceRequest{any_shape(input), any_number_of_material(input), input.flag(), any_store(input)};
    default:
      return DigRequest{any_shape(input), input.below(4) == 3 ? piece : 0, any_store(input)};
  }
}

inline Request any_request(FuzzInput& input) {
  switch (input.below(12)) {
    case 0:
      return FillRequest{any_shape(input), any_fill(input)};
    case 1:
      return PaintRequest{any_shape(input), any_number_of_material(input)};
    case 2:
      return SettingsRequest{any_settings(input)};
    case 3:
      return LeaveRequest{};
    case 4:
      return CutOutRequest{any_shape(input)};
    case 5:
      return ReleaseRequest{input.byte()};
    case 6: {
      CarveRequest carve = any_carve(input);
      carve.piece = input.byte();
      return carve;
    }
    case 7:
      return any_added_piece(input);
    case 8:
      return any_region_request(input);
    case 9:
      if (input.below(4) == 0) return any_stand(input);
      return any_walk(input);
    case 10:
      if (input.flag()) return any_store_request(input, input.byte());
      return any_carve(input);
    default:
      return any_carve(input);
  }
}

}  // namespace scree
