#include "proto/operation_codec.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <utility>

#include "proto/byte_stream.h"
#include "proto/packed_shape.h"
#include "proto/restore_layout.h"
#include "shared/base/check.h"
#include "shared/base/limits.h"
#include "shared/base/overloaded.h"
#include "shared/operation/limits.h"
#include "shared/recombine/stamp_method.h"

namespace scree {

namespace {

constexpr const char* subject = "operation";

/// The number of an operation's kind: its place in the variant, and beyond that the forms that operations of
/// voxels with materials have, so that those of older recordings keep theirs.
constexpr unsigned kind_bits = 3;
constexpr uint64_t kind_mask = (1U << kind_bits) - 1;
constexpr size_t kinds = std::variant_size_v<Operation>;
constexpr uint64_t head_max = (uint64_t{0xFFFFFFFFU} << kind_bits) | kind_mask;
/// The kind of a fill of a material, of paint by voxels, of slides, of shatters by a shape, of digs and of
/// places and of restores; a byte after the head says which.
constexpr uint64_t kind_with_material = 7;
enum WithMaterial : uint8_t {
  fill_of_material = 0,
  paint_of_voxels = 1,
  slide_of_material = 2,
  shatter_by_shape = 3,
  dig_of_shape = 4,
  place_of_material = 5,
  restore_of_bricks = 6
};
static_assert(kinds == kind_with_material + 4);

/// Bits of a stamp's shift with its sign folded. The higher bits hold the method, so that the usual method
/// takes no byte of its own.
constexpr unsigned shift_bits = 14;
/// A stamp has one of its method's two numbers, for one piece or for several together; as many more for each
/// thing that it can bring.
struct WireMethod {
  StampMethod method;
  bool together;
  Brings brings;

  bool operator==(const WireMethod&) const = default;
};
constexpr auto wire_methods = [] {
  constexpr size_t numbers = kind_count<StampMethod> + kinds_that<StampMethod, lays>.size();
  std::array<WireMethod, 3 * numbers> methods{};
  size_t places = 0;  // a bit for each number that a row has
  const auto enter = [&](size_t number, WireMethod method) {
    methods.at(number) = method;
    places |= size_t{1} << number;
  };
  for (const StampMethod method : all_kinds<StampMethod>) {
    for (const Brings brings : {Brings::nothing, Brings::materials, Brings::rubble}) {
      const size_t first = static_cast<size_t>(brings) * numbers;
      enter(traits_of(method).wire + first, {method, false, brings});
      if (lays(method)) enter(traits_of(method).wire_together.value() + first, {method, true, brings});
    }
  }
  if (places + 1 != size_t{1} << methods.size())
    throw "two methods of merging have one number";  // no compilation
  return methods;
}();
static_assert(fold_sign(-stamp_shift_max) >> shift_bits == 0 &&
              fold_sign(stamp_shift_max) >> shift_bits == 0);

/// The pattern in the low half of a byte, the cutter in the high half.
static_assert(kind_count<SeedPattern> <= 16 && kind_count<Cutter> <= 16);
uint8_t packed(SeedPattern pattern, Cutter cutter) {
  return static_cast<uint8_t>(static_cast<unsigned>(pattern) | static_cast<unsigned>(cutter) << 4U);
}

/// The id that stands in front of an operation; 0 for one that has none.
PieceId head_id(const Operation& operation) {
  return std::visit(Overloaded{
                        [](const CarveOperation& op) { return op.first_piece; },
                        [](const FillOperation&) { return PieceId{0}; },
                        [](const StampOperation& op) { return op.piece; },
                        [](const DiscardOperation& op) { return op.piece; },
                        [](const ShatterOperation& op) { return op.first_piece; },
                        [](const IslandOperation& op) { return op.piece; },
                        [](const PaintOperation&) { return PieceId{0}; },
                        [](const SlideOperation&) { return PieceId{0}; },
                        [](const DigOperation& op) { return op.piece; },
                        [](const PlaceOperation&) { return PieceId{0}; },
                        [](const RestoreOperation&) { return PieceId{0}; },
                    },
                    operation);
}

/// What follows the head.
struct Writing {
  ByteWriter& writer;

  void operator()(const CarveOperation& carve) const {
    write_shape(writer, carve.shape);
    writer.u8(packed(carve.pattern, carve.cutter));
    writer.varint(carve.seeds);
    writer.u32(carve.random_seed);
    writer.vec3(carve.impact_m);
    for (const glm::vec3& point_m : carve.authored_m) writer.vec3(point_m);
  }
  void operator()(const FillOperation& fill) const {
    if (fill.material) writer.u8(fill_of_material);
    write_shape(writer, fill.shape);
    if (fill.material) writer.u8(static_cast<uint8_t>(*fill.material));
  }
  void operator()(const StampOperation& stamp) const {
    writer.position(stamp.pose);
    writer.u32(stamp.pose.rotation);
    const uint64_t shift = fold_sign(stamp.shift);
    CHECK(shift >> shift_bits == 0);
    // The number after the last, which nobody reads, where there is no such method.
    const auto method =
        std::ranges::find(wire_methods, WireMethod{stamp.method, !stamp.others.empty(), stamp.brings});
    writer.varint((static_cast<uint64_t>(method - wire_methods.begin()) << shift_bits) | shift);
    if (stamp.others.empty()) return;
    CHECK(stamp.others.size() < limits::stamp_group_max);
    writer.varint(stamp.others.size());
    for (const StampedPiece& other : stamp.others) {
      writer.varint(other.piece);
      writer.position(other.pose);
      writer.u32(other.pose.rotation);
    }
  }
  void operator()(const DiscardOperation&) const {}
  void operator()(const ShatterOperation& shatter) const {
    if (shatter.cut) {
      writer.u8(shatter_by_shape);
      write_shape(writer, shatter.cut->shape);
      writer.position(shatter.cut->pose);
      writer.u32(shatter.cut->pose.rotation);
    }
    writer.varint(shatter.piece);
    writer.u8(packed(shatter.pattern, shatter.cutter));
    writer.varint(shatter.seeds);
    writer.u32(shatter.random_seed);
    writer.vec3(shatter.impact_voxels);
  }
  void operator()(const PaintOperation& paint) const {
    if (!paint.whole_bricks) writer.u8(paint_of_voxels);
    write_shape(writer, paint.shape);
    writer.u8(static_cast<uint8_t>(paint.material));
  }
  void operator()(const SlideOperation& slide) const {
    writer.u8(slide_of_material);
    const VoxelCoord size = slide.box.size();
    for (const int32_t low : {slide.box.lo.x, slide.box.lo.y, slide.box.lo.z}) writer.zigzag(low);
    for (const int32_t side : {size.x, size.y, size.z}) writer.varint(static_cast<uint64_t>(side));
    for (const uint8_t one : {static_cast<uint8_t>(slide.material), slide.tangent, slide.cell})
      writer.u8(one);
  }
  void operator()(const DigOperation& dig) const {
    writer.u8(dig_of_shape);
    write_shape(writer, dig.shape);
  }
  void operator()(const PlaceOperation& place) const {
    writer.u8(place_of_material);
    write_shape(writer, place.shape);
    writer.u8(static_cast<uint8_t>(place.material));
  }
  void operator()(const RestoreOperation& restore) const {
    writer.u8(restore_of_bricks);
    write_restore(writer, restore);
  }
  void operator()(const IslandOperation& island) const {
    const VoxelCoord size = island.box.size(), start = island.start - island.box.lo;
    for (const int32_t low : {island.box.lo.x, island.box.lo.y, island.box.lo.z}) writer.zigzag(low);
    for (const int32_t side : {size.x, size.y, size.z}) writer.varint(static_cast<uint64_t>(side));
    for (const int32_t at : {start.x, start.y, start.z}) writer.varint(static_cast<uint64_t>(at));
  }
};

/// Reads the fields that carve and shatter share. The pattern in `out` is a valid one, even on failure.
template <typename Breaking>
void read_seeds(ByteReader& reader, PieceId first_piece, Result<void> (*validate_pattern)(SeedPattern),
                Breaking& out) {
  const uint8_t byte = reader.u8("pattern and cutter", 0xFF);
  const auto pattern = static_cast<SeedPattern>(byte & 0xFU);
  if (const Result<void> valid = validate_pattern(pattern); valid)
    out.pattern = pattern;
  else
    reader.refuse(valid.error().message);
  out.cutter = static_cast<Cutter>(byte >> 4U);
  if (const Result<void> valid = validate_kind(out.cutter, "cutter"); !valid)
    reader.refuse(valid.error().message);
  out.seeds = static_cast<uint32_t>(reader.varint("number of seeds", limits::seeds_max));
  if (out.seeds == 0) reader.refuse("a break without seeds");
  if (first_piece > 0xFFFFFFFFU - out.seeds) reader.refuse("piece ids run over 2^32");
  out.random_seed = reader.u32("random seed");
  out.first_piece = first_piece;
}

void read(ByteReader& reader, PieceId id, CarveOperation& carve) {
  carve.shape = read_shape(reader);
  read_seeds(reader, id, validate_carve_pattern, carve);
  carve.impact_m = reader.vec3("impact");
  if (is_drawn(carve.pattern)) return;
  if (carve.seeds > limits::authored_seeds_max) reader.refuse("more authored seeds than authored_seeds_max");
  for (uint32_t i = 0; i < carve.seeds && !reader.failed(); ++i)
    carve.authored_m.push_back(reader.vec3("authored seed"));
}

void read(ByteReader& reader, PieceId id, FillOperation& fill) {
  if (id != 0) reader.refuse("a fill with a piece id");
  fill.shape = read_shape(reader);
}

void read(ByteReader& reader, PieceId id, StampOperation& stamp) {
  stamp.piece = id;
  const auto read_pose = [&] {
    QuantisedPose pose = reader.position("position of a stamp");
    pose.rotation = reader.u32("rotation of a stamp");
    return pose;
  };
  stamp.pose = read_pose();
  const uint64_t method_and_shift =
      reader.varint("method and shift of a stamp", (wire_methods.size() << shift_bits) - 1);
  // A varint over its bound is refused; whatever it gives then has a method.
  const WireMethod& method = wire_methods.at((method_and_shift >> shift_bits) % wire_methods.size());
  stamp.shift = static_cast<int32_t>(unfold_sign(method_and_shift & ((1U << shift_bits) - 1)));
  if (stamp.shift < -stamp_shift_max)
    reader.refuse(fmt::format("shift of a stamp is beyond ±{}", stamp_shift_max));
  stamp.method = method.method;
  stamp.brings = method.brings;
  if (!method.together) return;
  const uint64_t others = reader.varint("number of pieces stamped together", limits::stamp_group_max - 1);
  if (others == 0) reader.refuse("a stamp together with none");
  for (uint64_t i = 0; i < others && !reader.failed(); ++i) {
    const auto piece = static_cast<PieceId>(reader.varint("id of a piece", 0xFFFFFFFFU));
    stamp.others.push_back({piece, read_pose()});
  }
}

void read(ByteReader&, PieceId id, DiscardOperation& discard) {
  discard.piece = id;
}

void read(ByteReader& reader, PieceId id, ShatterOperation& shatter) {
  shatter.piece = static_cast<PieceId>(reader.varint("id of a piece", 0xFFFFFFFFU));
  read_seeds(reader, id, validate_shatter_pattern, shatter);
  shatter.impact_voxels = reader.vec3("impact");
}

void read(ByteReader& reader, PieceId id, IslandOperation& island) {
  const auto voxels = [&](const char* what) {
    constexpr uint64_t side_max = limits::island_side_max_bricks * brick_size;
    const auto axis = [&] { return static_cast<int32_t>(reader.varint(what, side_max)); };
    const int32_t x = axis();
    const int32_t y = axis();
    return VoxelCoord{x, y, axis()};
  };
  island.piece = id;
  island.box.lo = read_coord(reader, VoxelCoord{}, limits::voxel_coordinate_max, "place of an island");
  island.box.hi = island.box.lo + voxels("side of an island");
  island.start = island.box.lo + voxels("start of an island");
}

Material read_material(ByteReader& reader) {
  return static_cast<Material>(reader.u8("material", materials_max - 1));
}

void read(ByteReader& reader, PieceId id, PaintOperation& paint) {
  if (id != 0) reader.refuse("paint with a piece id");
  paint.shape = read_shape(reader);
  paint.material = read_material(reader);
  paint.whole_bricks = true;
}

void read(ByteReader& reader, PieceId, SlideOperation& slide) {
  const auto side = [&](int most) {
    return static_cast<int32_t>(reader.varint("side of a slide", static_cast<uint64_t>(most)));
  };
  slide.box.lo = read_coord(reader, VoxelCoord{}, limits::voxel_coordinate_max, "place of a slide");
  const int32_t x = side(limits::slide_side_max_voxels), y = side(limits::slide_height_max_voxels);
  slide.box.hi = slide.box.lo + VoxelCoord{x, y, side(limits::slide_side_max_voxels)};
  slide.material = read_material(reader);
  slide.tangent = reader.u8("tangent of a slide", limits::slide_tangent_max);
  slide.cell = reader.u8("cell of a slide", limits::slide_cell_max_voxels);
}

Operation read_with_material(ByteReader& reader, PieceId id) {
  const uint8_t which = reader.u8("kind of an operation with a material", restore_of_bricks);
  if (which == shatter_by_shape) {
    ShatterOperation shatter;
    PieceCut cut{read_shape(reader), {}};
    cut.pose = reader.position("position of a cut");
    cut.pose.rotation = reader.u32("rotation of a cut");
    read(reader, id, shatter);
    if (id > 0xFFFFFFFFU - limits::seeds_max - limits::cut_rests_max)
      reader.refuse("piece ids run over 2^32");
    shatter.cut = cut;
    return shatter;
  }
  if (which == dig_of_shape) return DigOperation{read_shape(reader), id};
  if (id != 0) reader.refuse("a fill, paint, slide, place or restore with a piece id");
  if (which == restore_of_bricks) return read_restore(reader);
  if (which == slide_of_material) {
    SlideOperation slide;
    read(reader, id, slide);
    return slide;
  }
  const Shape shape = read_shape(reader);
  const Material material = read_material(reader);
  if (which == fill_of_material) return FillOperation{shape, material};
  if (which == place_of_material) return PlaceOperation{shape, material};
  return PaintOperation{shape, material};
}

template <typename Kind>
Operation read_as(ByteReader& reader, PieceId id) {
  Kind operation;
  read(reader, id, operation);
  return operation;
}

using Reading = Operation (*)(ByteReader& reader, PieceId id);

template <size_t... kind>
constexpr std::array<Reading, kind_with_material> readings_of(std::index_sequence<kind...>) {
  return {read_as<std::variant_alternative_t<kind, Operation>>...};
}
constexpr std::array<Reading, kind_with_material> readings =
    readings_of(std::make_index_sequence<kind_with_material>{});

bool has_form_with_material(const Operation& operation) {
  const auto* fill = std::get_if<FillOperation>(&operation);
  const auto* paint = std::get_if<PaintOperation>(&operation);
  const auto* shatter = std::get_if<ShatterOperation>(&operation);
  return (shatter != nullptr && shatter->cut) || operation.index() >= kind_with_material ||
         (fill != nullptr && fill->material) || (paint != nullptr && !paint->whole_bricks);
}

Operation read_operation(ByteReader& reader) {
  const uint64_t head = reader.varint("id and kind", head_max);
  const uint64_t kind = head & kind_mask;
  const auto id = static_cast<PieceId>(head >> kind_bits);
  return kind == kind_with_material ? read_with_material(reader, id) : readings.at(kind)(reader, id);
}

}  // namespace

void append_operation(std::vector<uint8_t>& bytes, const Operation& operation) {
  ByteWriter writer(bytes);
  const uint64_t kind = has_form_with_material(operation) ? kind_with_material : operation.index();
  writer.varint((uint64_t{head_id(operation)} << kind_bits) | kind);
  std::visit(Writing{writer}, operation);
}

std::vector<uint8_t> encode_operation(const Operation& operation) {
  std::vector<uint8_t> bytes;
  append_operation(bytes, operation);
  return bytes;
}

std::vector<uint8_t> encode_operations(std::span<const Operation> operations) {
  std::vector<uint8_t> bytes;
  for (const Operation& operation : operations) append_operation(bytes, operation);
  return bytes;
}

Result<Operation> decode_operation(std::span<const uint8_t> bytes) {
  ByteReader reader(bytes, subject);
  Operation operation = read_operation(reader);
  reader.finish();
  if (reader.failed()) return tl::unexpected(reader.error());
  return operation;
}

Result<std::vector<Operation>> decode_operations(std::span<const uint8_t> bytes) {
  ByteReader reader(bytes, subject);
  std::vector<Operation> operations;
  while (!reader.at_end()) {
    if (operations.size() == limits::operations_per_frame_max) {
      reader.refuse(fmt::format("more than {} in one frame", limits::operations_per_frame_max));
      break;
    }
    operations.push_back(read_operation(reader));
  }
  if (reader.failed()) return tl::unexpected(reader.error());
  return operations;
}

size_t operation_bytes(const Operation& operation) {
  return encode_operation(operation).size();
}

}  // namespace scree
