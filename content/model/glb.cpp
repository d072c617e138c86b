#include "content/model/glb.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/mat4x4.hpp>
#include <nlohmann/json.hpp>
#include <optional>
#include <string_view>
#include <utility>

namespace scree {

namespace {

using Json = nlohmann::json;

constexpr uint32_t magic = 0x46546C67, json_chunk = 0x4E4F534A, buffer_chunk = 0x004E4942;
constexpr uint32_t type_byte = 5121, type_short = 5123, type_int = 5125, type_float = 5126;
constexpr uint64_t triangles_mode = 4;
/// Numbers of a scene: beyond, nothing within limits::model_reach_max_m comes of them.
constexpr double number_max = 1e6;

struct Head {
  std::string_view json;
  std::span<const uint8_t> buffer;
};

uint32_t word_at(std::span<const uint8_t> bytes, size_t at) {
  uint32_t word = 0;
  std::memcpy(&word, &bytes[at], sizeof word);
  return word;
}

/// The first chunk, and the second if it is the buffer.
Result<Head> read_head(std::span<const uint8_t> bytes) {
  if (bytes.size() > limits::model_bytes_max)
    return fail(
        fmt::format("it has more than {} MiB (limits.model_bytes_max)", limits::model_bytes_max >> 20U));
  if (bytes.size() < 20 || word_at(bytes, 0) != magic) return fail("it is no binary glTF (.glb)");
  if (word_at(bytes, 4) != 2) return fail("it is of another version than glTF 2");
  if (word_at(bytes, 8) > bytes.size()) return fail("it is cut short");
  const uint32_t json_bytes = word_at(bytes, 12);
  if (word_at(bytes, 16) != json_chunk) return fail("its first part is no JSON");
  if (json_bytes > bytes.size() - 20) return fail("its JSON is cut short");
  if (json_bytes > limits::model_json_bytes_max)
    return fail(fmt::format("its JSON has more than {} KiB (limits.model_json_bytes_max)",
                            limits::model_json_bytes_max >> 10U));
  Head head{{reinterpret_cast<const char*>(&bytes[20]), json_bytes}, {}};
  const std::span<const uint8_t> rest = bytes.subspan(20 + json_bytes);
  if (rest.size() < 8 || word_at(rest, 4) != buffer_chunk) return head;
  if (word_at(rest, 0) > rest.size() - 8) return fail("its buffer is cut short");
  head.buffer = rest.subspan(8, word_at(rest, 0));
  return head;
}

/// Null: it has none such.
const Json* member(const Json& object, const char* name) {
  if (!object.is_object()) return nullptr;
  const auto found = object.find(name);
  return found == object.end() ? nullptr : &*found;
}

Result<uint64_t> whole(const Json& object, const char* name, std::optional<uint64_t> otherwise = {}) {
  const Json* const number = member(object, name);
  if (number == nullptr && otherwise) return *otherwise;
  if (number == nullptr || !number->is_number_unsigned() || number->get<uint64_t>() > limits::model_bytes_max)
    return fail(fmt::format("its JSON has no {} where one is needed, or one out of bounds", name));
  return number->get<uint64_t>();
}

/// So many numbers, or `otherwise` where there is no such member.
template <size_t count>
Result<std::array<float, count>> numbers(const Json& object, const char* name,
                                         const std::array<float, count>& otherwise) {
  const Json* const list = member(object, name);
  if (list == nullptr) return otherwise;
  std::array<float, count> read{};
  if (!list->is_array() || list->size() != count)
    return fail(fmt::format("its JSON has a {} that is no list of {} numbers", name, count));
  for (size_t i = 0; i < count; ++i) {
    const Json& number = (*list)[i];
    if (!number.is_number() || !(std::abs(number.get<double>()) <= number_max))
      return fail(fmt::format("its JSON has a {} with what is no number, or beyond {:g}", name, number_max));
    read[i] = number.get<float>();
  }
  return read;
}

/// Elements of one kind in the buffer.
struct Accessor {
  const uint8_t* first = nullptr;
  size_t count = 0;
  size_t stride = 0;
  size_t columns = 0;
  uint32_t type = 0;

  /// Bytes and shorts as parts of their largest.
  float value(size_t element, size_t column) const {
    const uint8_t* const at = first + element * stride;
    if (type == type_byte) return static_cast<float>(at[column]) / 255.0F;
    if (type == type_short) {
      uint16_t number = 0;
      std::memcpy(&number, at + 2 * column, sizeof number);
      return static_cast<float>(number) / 65535.0F;
    }
    float number = 0.0F;
    std::memcpy(&number, at + 4 * column, sizeof number);
    return number;
  }
  glm::vec3 vector(size_t element) const { return {value(element, 0), value(element, 1), value(element, 2)}; }
  uint32_t index(size_t element) const {
    const uint8_t* const at = first + element * stride;
    if (type == type_byte) return *at;
    uint16_t narrow = 0;
    uint32_t wide = 0;
    std::memcpy(&narrow, at, sizeof narrow);
    if (type == type_short) return narrow;
    std::memcpy(&wide, at, sizeof wide);
    return wide;
  }
};

size_t bytes_of(uint32_t type) {
  return type == type_byte ? 1 : type == type_short ? 2 : 4;
}

size_t columns_of(const Json& accessor) {
  const Json* const type = member(accessor, "type");
  if (type == nullptr || !type->is_string()) return 0;
  const auto& name = type->get_ref<const std::string&>();
  return name == "SCALAR" ? 1 : name == "VEC3" ? 3 : name == "VEC4" ? 4 : 0;
}

/// Colours are linear, and kept as their square roots. What is no number is 0.
uint8_t colour_byte(float linear) {
  return linear > 0.0F ? static_cast<uint8_t>(std::sqrt(std::min(linear, 1.0F)) * 255.0F + 0.5F) : 0;
}

/// 0 where it has no direction.
std::array<int8_t, 4> normal_bytes(glm::vec3 normal) {
  const float length = std::sqrt(glm::dot(normal, normal));
  std::array<int8_t, 4> bytes{};
  if (!(length > 1e-12F && length < 1e12F)) return bytes;
  for (int i = 0; i < 3; ++i)
    bytes[static_cast<size_t>(i)] = static_cast<int8_t>(std::lround(normal[i] / length * 127.0F));
  return bytes;
}

class GlbReader {
 public:
  GlbReader(Json json, std::span<const uint8_t> buffer) : json_(std::move(json)), buffer_(buffer) {}

  Result<ModelMesh> read();

 private:
  struct Visit {
    uint64_t node;
    glm::mat4 above;
  };
  Result<void> check_demands() const;
  Result<const Json*> element(const char* list, uint64_t number) const;
  Result<std::vector<Visit>> roots() const;
  Result<glm::mat4> transform_of(const Json& node) const;
  Result<Accessor> accessor(const Json& of, const char* name) const;
  Result<std::array<float, 4>> colour_of(const Json& primitive) const;
  Result<void> add_mesh(uint64_t mesh, const glm::mat4& transform);
  Result<void> add_primitive(const Json& primitive, const glm::mat4& transform);
  Result<void> add_vertices(const Json& attributes, const std::array<float, 4>& colour,
                            const glm::mat4& transform);
  Result<void> add_corners(const Json& primitive, uint32_t first, bool mirrored);

  Json json_;
  std::span<const uint8_t> buffer_;
  std::vector<ModelVertex> vertices_;
  std::vector<uint32_t> corners_;
};

/// What a file says that a reader must know.
Result<void> GlbReader::check_demands() const {
  const Json* const demands = member(json_, "extensionsRequired");
  if (demands == nullptr) return {};
  if (!demands->is_array()) return fail("its JSON has an extensionsRequired that is no list");
  for (const Json& demand : *demands)
    if (!demand.is_string() || !demand.get_ref<const std::string&>().starts_with("KHR_materials_"))
      return fail("it needs an extension of glTF that is not read here: write it without compression");
  return {};
}

Result<const Json*> GlbReader::element(const char* list, uint64_t number) const {
  const Json* const all = member(json_, list);
  if (all == nullptr || !all->is_array() || number >= all->size() || !(*all)[number].is_object())
    return fail(fmt::format("its JSON has no {}[{}]", list, number));
  return &(*all)[number];
}

/// The nodes of the scene, as numbers.
Result<std::vector<GlbReader::Visit>> GlbReader::roots() const {
  const Json* const scene = TRY(element("scenes", TRY(whole(json_, "scene", 0))));
  const Json* const nodes = member(*scene, "nodes");
  if (nodes == nullptr || !nodes->is_array()) return fail("its scene has no nodes");
  std::vector<Visit> visits;
  for (const Json& node : *nodes) {
    if (!node.is_number_unsigned()) return fail("its scene has a node that is no number");
    visits.push_back({node.get<uint64_t>(), glm::mat4(1.0F)});
  }
  return visits;
}

Result<glm::mat4> GlbReader::transform_of(const Json& node) const {
  glm::mat4 matrix(1.0F);
  if (member(node, "matrix") != nullptr) {
    const auto read = TRY(numbers<16>(node, "matrix", {}));
    for (int i = 0; i < 16; ++i) matrix[i / 4][i % 4] = read[static_cast<size_t>(i)];
    return matrix;
  }
  const auto place = TRY(numbers<3>(node, "translation", {0.0F, 0.0F, 0.0F}));
  const auto turn = TRY(numbers<4>(node, "rotation", {0.0F, 0.0F, 0.0F, 1.0F}));
  const auto scale = TRY(numbers<3>(node, "scale", {1.0F, 1.0F, 1.0F}));
  const glm::mat3 turned(glm::quat(turn[3], turn[0], turn[1], turn[2]));
  for (int i = 0; i < 3; ++i) matrix[i] = glm::vec4(turned[i] * scale[static_cast<size_t>(i)], 0.0F);
  matrix[3] = {place[0], place[1], place[2], 1.0F};
  return matrix;
}

/// The accessor that a member names, with all of its elements within the buffer.
Result<Accessor> GlbReader::accessor(const Json& of, const char* name) const {
  const Json& from = *TRY(element("accessors", TRY(whole(of, name))));
  if (member(from, "sparse") != nullptr) return fail("it has a sparse accessor, which is not read here");
  const Json& view = *TRY(element("bufferViews", TRY(whole(from, "bufferView"))));
  if (TRY(whole(view, "buffer")) != 0) return fail("it has another buffer than its own");
  Accessor read;
  read.type = static_cast<uint32_t>(TRY(whole(from, "componentType")));
  if (read.type != type_byte && read.type != type_short && read.type != type_int && read.type != type_float)
    return fail(fmt::format("it has an accessor of type {}, which is not read here", read.type));
  read.columns = columns_of(from);
  read.count = TRY(whole(from, "count"));
  const uint64_t begin = TRY(whole(view, "byteOffset", 0)), bytes = TRY(whole(view, "byteLength"));
  const uint64_t offset = TRY(whole(from, "byteOffset", 0)), size = read.columns * bytes_of(read.type);
  read.stride = TRY(whole(view, "byteStride", size));
  if (size == 0 || read.count == 0 || read.stride < size || begin + bytes > buffer_.size() ||
      offset + read.stride * (read.count - 1) + size > bytes)
    return fail("it has an accessor that is of no vectors, or beyond its buffer");
  read.first = buffer_.data() + begin + offset;
  return read;
}

Result<std::array<float, 4>> GlbReader::colour_of(const Json& primitive) const {
  const std::array<float, 4> white{1.0F, 1.0F, 1.0F, 1.0F};
  if (member(primitive, "material") == nullptr) return white;
  const Json& material = *TRY(element("materials", TRY(whole(primitive, "material"))));
  const Json* const looks = member(material, "pbrMetallicRoughness");
  return looks == nullptr ? white : numbers<4>(*looks, "baseColorFactor", white);
}

Result<void> GlbReader::add_vertices(const Json& attributes, const std::array<float, 4>& colour,
                                     const glm::mat4& transform) {
  const Accessor places = TRY(accessor(attributes, "POSITION"));
  if (places.columns != 3 || places.type != type_float)
    return fail("it has positions that are no vectors of floats");
  if (places.count > limits::model_vertices_max - vertices_.size())
    return fail(
        fmt::format("it has more than {} vertices (limits.model_vertices_max)", limits::model_vertices_max));
  std::optional<Accessor> normals, colours;
  if (member(attributes, "NORMAL") != nullptr) normals = TRY(accessor(attributes, "NORMAL"));
  if (normals && (normals->columns != 3 || normals->type != type_float || normals->count != places.count))
    return fail("it has normals that are no vectors of floats, one for each position");
  if (member(attributes, "COLOR_0") != nullptr) colours = TRY(accessor(attributes, "COLOR_0"));
  if (colours && (colours->columns < 3 || colours->type == type_int || colours->count != places.count))
    return fail("it has colours that are no vectors, one for each position");
  const glm::vec3 x(transform[0]), y(transform[1]), z(transform[2]);
  // Normals go by the matrix of cofactors.
  const glm::mat3 upright(glm::cross(y, z), glm::cross(z, x), glm::cross(x, y));
  const float side = glm::dot(x, upright[0]) < 0.0F ? -1.0F : 1.0F;
  for (size_t i = 0; i < places.count; ++i) {
    ModelVertex& vertex = vertices_.emplace_back();
    vertex.place_m = glm::vec3(transform * glm::vec4(places.vector(i), 1.0F));
    if (normals) vertex.normal = normal_bytes(side * (upright * normals->vector(i)));
    for (size_t c = 0; c < 3; ++c)
      vertex.colour[c] = colour_byte(colour[c] * (colours ? colours->value(i, c) : 1.0F));
  }
  return {};
}

/// Without indices, vertices stand in their order.
Result<void> GlbReader::add_corners(const Json& primitive, uint32_t first, bool mirrored) {
  const auto count = static_cast<uint32_t>(vertices_.size() - first);
  std::optional<Accessor> indices;
  if (member(primitive, "indices") != nullptr) indices = TRY(accessor(primitive, "indices"));
  if (indices && (indices->columns != 1 || indices->type == type_float))
    return fail("it has indices that are no whole numbers");
  const size_t corners = indices ? indices->count : count;
  if (corners % 3 != 0) return fail("it has a list of triangles that is no multiple of three");
  if (corners > 3 * limits::model_triangles_max - corners_.size())
    return fail(fmt::format("it has more than {} triangles (limits.model_triangles_max)",
                            limits::model_triangles_max));
  for (size_t i = 0; i < corners; ++i) {
    const uint32_t index = indices ? indices->index(i) : static_cast<uint32_t>(i);
    if (index >= count) return fail("it has an index without its vertex");
    corners_.push_back(first + index);
  }
  if (mirrored)
    for (size_t i = corners_.size() - corners; i < corners_.size(); i += 3)
      std::swap(corners_[i], corners_[i + 1]);
  return {};
}

Result<void> GlbReader::add_primitive(const Json& primitive, const glm::mat4& transform) {
  if (TRY(whole(primitive, "mode", triangles_mode)) != triangles_mode)
    return fail("it has points, lines, strips or fans; triangles alone are read here (mode 4)");
  const Json* const attributes = member(primitive, "attributes");
  if (attributes == nullptr) return fail("it has a primitive without attributes");
  const auto first = static_cast<uint32_t>(vertices_.size());
  TRY(add_vertices(*attributes, TRY(colour_of(primitive)), transform));
  const glm::mat3 axes(transform);
  return add_corners(primitive, first, glm::dot(axes[0], glm::cross(axes[1], axes[2])) < 0.0F);
}

Result<void> GlbReader::add_mesh(uint64_t mesh, const glm::mat4& transform) {
  const Json* const primitives = member(*TRY(element("meshes", mesh)), "primitives");
  if (primitives == nullptr || !primitives->is_array()) return fail("it has a mesh without primitives");
  for (const Json& primitive : *primitives) TRY(add_primitive(primitive, transform));
  return {};
}

/// Nodes are a tree: each is met once.
Result<ModelMesh> GlbReader::read() {
  TRY(check_demands());
  if (const auto own = element("buffers", 0); own && member(**own, "uri") != nullptr)
    return fail("its buffer lies in another file, which is never read");
  std::vector<Visit> visits = TRY(roots());
  std::vector<bool> met(limits::model_nodes_max);
  while (!visits.empty()) {
    const Visit visit = visits.back();
    visits.pop_back();
    if (visit.node >= limits::model_nodes_max)
      return fail(fmt::format("it has more than {} nodes (limits.model_nodes_max)", limits::model_nodes_max));
    const Json& node = *TRY(element("nodes", visit.node));
    if (met[visit.node]) return fail("it has a node that is met twice: its nodes are no tree");
    met[visit.node] = true;
    const glm::mat4 transform = visit.above * TRY(transform_of(node));
    if (member(node, "mesh") != nullptr) TRY(add_mesh(TRY(whole(node, "mesh")), transform));
    const Json* const children = member(node, "children");
    if (children == nullptr) continue;
    if (!children->is_array()) return fail("it has a node whose children are no list");
    for (const Json& child : *children) {
      if (!child.is_number_unsigned()) return fail("it has a node with a child that is no number");
      visits.push_back({child.get<uint64_t>(), transform});
    }
  }
  return checked_model(std::move(vertices_), std::move(corners_));
}

}  // namespace

Result<ModelMesh> read_glb(std::span<const uint8_t> bytes) {
  const Head head = TRY(read_head(bytes));
  Json json = Json::parse(head.json, nullptr, false);
  if (json.is_discarded() || !json.is_object()) return fail("its JSON is damaged");
  return GlbReader(std::move(json), head.buffer).read();
}

}  // namespace scree
