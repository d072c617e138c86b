// Materials, shapes, seed patterns and kinds of terrain on the wire: every kind that has a row goes through
// every codec, the number after the last is refused by each, and scree.proto names the same kinds.
#include <cctype>
#include <fstream>
#include <gtest/gtest.h>
#include <map>
#include <sstream>

#include "proto/operation_codec.h"
#include "server/formats/recording_codec.h"
#include "tests/support/holds.h"
#include "tests/support/materials.h"
#include "tests/support/wire_samples.h"

namespace scree {
namespace {

/// The number after the last that has a row.
template <typename Kind>
constexpr auto unknown = static_cast<Kind>(kind_count<Kind>);

/// A valid shape of any kind.
Shape shape_of(ShapeKind kind) {
  return {kind, {1.0F, 2.0F, 3.0F}, row_of(kind).has_b ? glm::vec3(0.5F, 1.0F, 1.5F) : glm::vec3(0.0F), 1.0F};
}

CarveMessage carve_message(ShapeKind shape, SeedPattern pattern) {
  CarveMessage carve;
  carve.shape = shape_of(shape);
  carve.pattern = pattern;
  carve.seeds = 2;
  if (is_given(pattern)) carve.authored_m.assign(2, glm::vec3(1.0F));
  return carve;
}

CarveOperation carve_operation(ShapeKind shape, SeedPattern pattern) {
  CarveOperation carve{shape_of(shape), pattern, 2, 7, {1.0F, 4.0F, 3.0F}, 0};
  if (!is_drawn(pattern)) carve.authored_m.assign(2, glm::vec3(1.0F));
  return carve;
}

ShatterOperation shatter_operation(SeedPattern pattern) {
  return {1, pattern, 5, 0x1234U, {-3.5F, 0.25F, 8.0F}, 2};
}

/// Empty when the message is decoded, to the same; else the reason, or the unknown value of a request.
std::string refusal(const ClientMessage& message) {
  const std::vector<uint8_t> bytes = encode(message);
  const Result<ClientMessage> decoded = decode_client(samples::body_of(bytes));
  if (!decoded) return decoded.error().message;
  if (const auto* unknown = std::get_if<UnknownMessage>(&*decoded)) return unknown->value;
  EXPECT_EQ(encode(*decoded), bytes);
  return "";
}

std::string refusal(const Operation& operation) {
  const Result<Operation> decoded = decode_operation(encode_operation(operation));
  if (!decoded) return decoded.error().message;
  EXPECT_TRUE(*decoded == operation);
  return "";
}

std::string refusal_of_brick(Material material) {
  const Result<std::vector<BrickPatch>> decoded = decode_bricks(
      encode_bricks(std::vector<BrickPatch>{{{1, 2, 3}, samples::noisy_brick(1), all_of(material)}}));
  if (!decoded) return decoded.error().message;
  EXPECT_EQ(decoded->front().materials, all_of(material));
  return "";
}

std::string refusal_of_volume(Material material) {
  Volume volume = samples::volume();
  volume.materials.all = material;
  const Result<Volume> decoded = decode_volume(encode_volume(volume));
  if (!decoded) return decoded.error().message;
  EXPECT_EQ(main_material(*decoded), material);
  return "";
}

std::string refusal_of_welcome(TerrainKind kind) {
  WelcomeMessage welcome;
  welcome.terrain.kind = kind;
  const Result<ServerMessage> decoded = decode_server(samples::body_of(encode(ServerMessage(welcome))));
  if (!decoded) return decoded.error().message;
  EXPECT_EQ(std::get<WelcomeMessage>(*decoded).terrain.kind, kind);
  return "";
}

std::string refusal_of_header(TerrainKind kind) {
  RecordedHeader header;
  header.terrain.kind = kind;
  const Result<RecordedHeader> decoded = decode_recorded_header(encode(header));
  if (!decoded) return decoded.error().message;
  EXPECT_EQ(decoded->terrain.kind, kind);
  return "";
}

TEST(Kinds, every_row_of_a_palette_goes_through_every_codec_and_one_beyond_through_none) {
  const Shape place = shape_of(ShapeKind::sphere);
  for (size_t row = 0; row < materials_max; ++row) {
    const auto material = static_cast<Material>(row);
    EXPECT_EQ(refusal(PaintMessage{{place, material}, 1}), "") << row;
    EXPECT_EQ(refusal(FillMessage{{place, material}, 1}), "") << row;
    for (const bool whole : {false, true})
      EXPECT_EQ(refusal(Operation(PaintOperation{place, material, whole})), "") << row;
    EXPECT_EQ(refusal(Operation(FillOperation{place, material})), "") << row;
    EXPECT_EQ(refusal_of_brick(material), "") << row;
    EXPECT_EQ(refusal_of_volume(material), "") << row;
  }
  constexpr auto none = static_cast<Material>(materials_max);
  EXPECT_TRUE(holds(refusal(PaintMessage{{place, none}, 1}), "material 255"));
  EXPECT_TRUE(holds(refusal(FillMessage{{place, none}, 1}), "material 255"));
  EXPECT_TRUE(holds(refusal(Operation(PaintOperation{place, none})), "material"));
  EXPECT_TRUE(holds(refusal(Operation(FillOperation{place, none})), "material"));
}

TEST(Kinds, every_shape_goes_through_every_codec_and_an_unknown_one_through_none) {
  for (const ShapeKind kind : all_kinds<ShapeKind>) {
    EXPECT_EQ(refusal(carve_message(kind, SeedPattern::radial)), "") << name_of(kind);
    EXPECT_EQ(refusal(FillMessage{{shape_of(kind)}, 1}), "") << name_of(kind);
    EXPECT_EQ(refusal(PaintMessage{{shape_of(kind), material::ice}, 1}), "") << name_of(kind);
    EXPECT_EQ(refusal(Operation(carve_operation(kind, SeedPattern::radial))), "") << name_of(kind);
    EXPECT_EQ(refusal(Operation(FillOperation{shape_of(kind)})), "") << name_of(kind);
    EXPECT_EQ(refusal(Operation(PaintOperation{shape_of(kind), material::ice})), "") << name_of(kind);
  }
  constexpr auto none = unknown<ShapeKind>;
  EXPECT_TRUE(holds(refusal(carve_message(none, SeedPattern::radial)), "kind of shape"));
  EXPECT_TRUE(holds(refusal(FillMessage{{shape_of(none)}, 1}), "kind of shape"));
  EXPECT_TRUE(holds(refusal(PaintMessage{{shape_of(none), material::ice}, 1}), "kind of shape"));
  EXPECT_TRUE(holds(refusal(Operation(carve_operation(none, SeedPattern::radial))), "kind of shape"));
  EXPECT_TRUE(holds(refusal(Operation(FillOperation{shape_of(none)})), "kind of shape"));
  EXPECT_TRUE(holds(refusal(Operation(PaintOperation{shape_of(none), material::ice})), "kind of shape"));
}

TEST(Kinds, every_pattern_goes_through_every_codec_and_an_unknown_one_through_none) {
  for (const SeedPattern pattern : all_kinds<SeedPattern>) {
    EXPECT_EQ(refusal(carve_message(ShapeKind::sphere, pattern)), "") << name_of(pattern);
    EXPECT_EQ(refusal(Operation(carve_operation(ShapeKind::sphere, pattern))), "") << name_of(pattern);
  }
  constexpr auto none = unknown<SeedPattern>;
  EXPECT_TRUE(holds(refusal(carve_message(ShapeKind::sphere, none)), "pattern"));
  EXPECT_TRUE(holds(refusal(Operation(carve_operation(ShapeKind::sphere, none))), "pattern"));
}

TEST(Kinds, a_client_refuses_the_patterns_of_a_shatter_that_its_server_refuses) {
  const PieceTable pieces{{1, std::make_shared<const Volume>(samples::volume())}};
  size_t taken = 0;
  for (int number = 0; number < 16; ++number) {
    const Operation shatter(shatter_operation(static_cast<SeedPattern>(number)));
    const Result<void> valid = validate(shatter, pieces, 0.25F);
    EXPECT_EQ(refusal(shatter), valid ? "" : "operation: " + valid.error().message) << number;
    taken += valid ? 1 : 0;
  }
  EXPECT_EQ(taken, drawn_patterns.size());
}

TEST(Kinds, every_terrain_goes_through_every_codec_and_an_unknown_one_through_none) {
  for (const TerrainKind kind : all_kinds<TerrainKind>) {
    EXPECT_EQ(refusal_of_welcome(kind), "") << name_of(kind);
    EXPECT_EQ(refusal_of_header(kind), "") << name_of(kind);
  }
  EXPECT_TRUE(holds(refusal_of_welcome(unknown<TerrainKind>), "terrain"));
  EXPECT_TRUE(holds(refusal_of_header(unknown<TerrainKind>), "terrain_kind"));
}

/// The names of an enum's values in a file of the specification, in small letters, by number.
std::map<int, std::string> values_of(const std::string& name, const std::string& file_name = "scree.proto") {
  std::ifstream file(std::string(SCREE_SOURCE_DIR) + "/proto/" + file_name);
  std::map<int, std::string> values;
  bool inside = false;
  for (std::string line; std::getline(file, line);) {
    std::istringstream statements(line.substr(0, line.find("//")));
    for (std::string statement; std::getline(statements, statement, ';');) {
      std::istringstream words(statement);
      std::string first, second;
      int number = 0;
      words >> first >> second;
      if (inside && first == "}") return values;
      if (inside && second == "=" && words >> number) {
        for (char& c : first) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
        values[number] = first;
      }
      inside = inside || (first == "enum" && second == name);
    }
  }
  return values;
}

template <typename Kind>
std::map<int, std::string> rows() {
  std::map<int, std::string> rows;
  for (const Kind kind : all_kinds<Kind>) rows[static_cast<int>(kind)] = name_of(kind);
  return rows;
}

TEST(Kinds, are_those_of_the_specification) {
  EXPECT_EQ(values_of("Role", "access.proto"), rows<Role>());
  EXPECT_EQ(values_of("ShapeKind", "shape.proto"), rows<ShapeKind>());
  EXPECT_EQ(values_of("SeedPattern", "shape.proto"), rows<SeedPattern>());
  EXPECT_EQ(values_of("TerrainKind"), rows<TerrainKind>());
}

}  // namespace
}  // namespace scree
