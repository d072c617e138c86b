#include "tools/import/vox/vox_scene.h"

#include <algorithm>
#include <bit>
#include <charconv>
#include <fmt/format.h>
#include <optional>
#include <string_view>

#include "proto/byte_stream.h"
#include "shared/base/text.h"
#include "tools/import/vox/limits.h"

namespace scree {

namespace {

/// Bytes of a text of the file in a message.
constexpr size_t shown_bytes_max = 80;

using Attributes = std::map<std::string, std::string>;

constexpr uint32_t id_of(const char (&id)[5]) {
  return static_cast<uint32_t>(static_cast<uint8_t>(id[0])) |
         static_cast<uint32_t>(static_cast<uint8_t>(id[1])) << 8U |
         static_cast<uint32_t>(static_cast<uint8_t>(id[2])) << 16U |
         static_cast<uint32_t>(static_cast<uint8_t>(id[3])) << 24U;
}

/// MagicaVoxel's colours where a file has none: a cube of 6 by 6 by 6 without black, then ramps of red,
/// green, blue and grey.
std::array<std::array<uint8_t, 4>, 256> default_colours() {
  std::array<std::array<uint8_t, 4>, 256> colours{};
  for (int i = 1; i < 216; ++i) {
    const int k = i - 1;
    const auto part = [](int step) { return static_cast<uint8_t>(255 - 51 * step); };
    colours[static_cast<size_t>(i)] = {part(k / 36), part(k / 6 % 6), part(k % 6), 255};
  }
  constexpr std::array<uint8_t, 10> ramp{0xEE, 0xDD, 0xBB, 0xAA, 0x88, 0x77, 0x55, 0x44, 0x22, 0x11};
  for (size_t i = 0; i < 40; ++i) {
    std::array<uint8_t, 4>& colour = colours[216 + i];
    colour = {0, 0, 0, 255};
    for (size_t axis = 0; axis < 3; ++axis)
      if (i / 10 == axis || i / 10 == 3) colour[axis] = ramp[i % 10];
  }
  return colours;
}

std::optional<int64_t> number_in(std::string_view text) {
  int64_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

/// Bits 0 and 1: the column of the one that is not zero in the first row; 2 and 3: in the second; 4 to 6:
/// the signs of the three rows.
Result<VoxTurn> read_turn(std::string_view text) {
  const int64_t bits = number_in(text).value_or(-1);
  const int first = static_cast<int>(bits & 3), second = static_cast<int>((bits >> 2) & 3);
  if (bits < 0 || bits > 127 || first > 2 || second > 2 || first == second)
    return fail("which is not a turn");
  VoxTurn turn;
  turn.axis = {first, second, 3 - first - second};
  for (size_t i = 0; i < 3; ++i) turn.negative[i] = ((bits >> (4 + i)) & 1) != 0;
  return turn;
}

Result<std::array<int64_t, 3>> read_move(std::string_view text) {
  std::array<int64_t, 3> move{};
  for (size_t axis = 0; axis < 3; ++axis) {
    const size_t end = axis < 2 ? text.find(' ') : text.size();
    const auto part = end == std::string_view::npos ? std::nullopt : number_in(text.substr(0, end));
    if (!part) return fail("which is not a place: three whole numbers");
    if (*part < -limits::vox_far_max || *part > limits::vox_far_max)
      return fail("which is a place beyond every world (limits.vox_far_max)");
    move[axis] = *part;
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return move;
}

/// Takes one attribute of a node, if it is there.
template <typename T>
Result<void> take(const Attributes& attributes, const char* name, int32_t node, T& to,
                  Result<T> (*read)(std::string_view text)) {
  const auto found = attributes.find(name);
  if (found == attributes.end()) return {};
  auto value = read(found->second);
  if (!value)
    return fail(fmt::format("node {}: its attribute {} is '{}', {}", node, name,
                            showable(found->second, shown_bytes_max), value.error().message));
  to = *value;
  return {};
}

class VoxParser {
 public:
  explicit VoxParser(VoxScene& scene) : scene_(scene) {}

  Result<void> run(std::span<const uint8_t> bytes) {
    ByteReader reader(bytes, "the file");
    if (reader.u32("kind") != id_of("VOX ")) return fail("it is not a MagicaVoxel file, or cut short");
    const uint32_t version = reader.u32("version");
    if (!reader.failed() && version != 150 && version != 200)
      return fail(fmt::format("it is of version {}: import reads versions 150 and 200", version));
    const uint32_t main = reader.u32("first chunk"), content = reader.u32("bytes of the first chunk"),
                   inner = reader.u32("bytes in the first chunk");
    if (reader.failed()) return tl::unexpected(reader.error());
    if (main != id_of("MAIN")) return fail("it does not begin with its main chunk: it is damaged");
    reader.read_bytes(content, "main chunk");
    const auto chunks = reader.read_bytes(inner, "chunks");
    if (reader.failed()) return tl::unexpected(reader.error());
    scene_.colours = default_colours();
    TRY(read_chunks(chunks));
    if (scene_.models.empty()) return fail("it holds no model");
    if (has_size_) return fail("a model has a size and no voxels: it is damaged");
    return {};
  }

 private:
  Result<void> read_chunks(std::span<const uint8_t> bytes) {
    ByteReader reader(bytes, "the chunks");
    while (!reader.at_end()) {
      const uint32_t id = reader.u32("name of a chunk"), content = reader.u32("bytes of a chunk"),
                     inner = reader.u32("bytes in a chunk");
      const auto own = reader.read_bytes(content, "content of a chunk");
      reader.read_bytes(inner, "chunks in a chunk");
      if (reader.failed()) break;
      ByteReader chunk(own, "a chunk");
      TRY(read_chunk(id, chunk));
      if (chunk.failed()) return tl::unexpected(chunk.error());
    }
    return reader.failed() ? Result<void>(tl::unexpected(reader.error())) : Result<void>();
  }

  /// Those that say how it is drawn are skipped.
  Result<void> read_chunk(uint32_t id, ByteReader& chunk) {
    if (id == id_of("SIZE")) return read_size(chunk);
    if (id == id_of("XYZI")) return read_voxels(chunk);
    if (id == id_of("RGBA")) return read_colours(chunk);
    if (id == id_of("nTRN")) return read_node(chunk, VoxNode::Kind::transform);
    if (id == id_of("nGRP")) return read_node(chunk, VoxNode::Kind::group);
    if (id == id_of("nSHP")) return read_node(chunk, VoxNode::Kind::shape);
    if (id == id_of("LAYR")) return read_layer(chunk);
    if (id == id_of("NOTE")) return read_notes(chunk);
    if (id == id_of("MATL")) return read_material(chunk);
    return {};
  }

  Result<void> read_size(ByteReader& chunk) {
    if (has_size_) return fail("a model has two sizes: it is damaged");
    for (int& side : size_) {
      const uint32_t own = chunk.u32("size of a model");
      if (chunk.failed()) return {};
      if (own < 1 || own > limits::vox_side_max)
        return fail(fmt::format("a model is {} voxels wide: a model has 1 to {} (limits.vox_side_max)", own,
                                limits::vox_side_max));
      side = static_cast<int>(own);
    }
    has_size_ = true;
    return {};
  }

  Result<void> read_voxels(ByteReader& chunk) {
    if (!has_size_) return fail("a model has voxels and no size: it is damaged");
    if (scene_.models.size() >= limits::vox_models_max)
      return fail(
          fmt::format("it holds more than {} models (limits.vox_models_max)", limits::vox_models_max));
    const uint32_t count = chunk.u32("voxels of a model");
    const auto bytes = chunk.read_bytes(size_t{4} * count, "voxels of a model");
    if (chunk.failed()) return {};
    VoxModel model{size_, {}};
    model.voxels.reserve(count);
    for (size_t i = 0; i < count; ++i) {
      const std::array<uint8_t, 4> voxel{bytes[4 * i], bytes[4 * i + 1], bytes[4 * i + 2], bytes[4 * i + 3]};
      for (size_t axis = 0; axis < 3; ++axis)
        if (voxel[axis] >= size_[axis]) return fail("a voxel lies outside of its model: it is damaged");
      if (voxel[3] == 0) return fail("a voxel has colour 0, which is none: it is damaged");
      model.voxels.push_back(voxel);
    }
    scene_.models.push_back(std::move(model));
    has_size_ = false;
    return {};
  }

  Result<void> read_colours(ByteReader& chunk) {
    const auto bytes = chunk.read_bytes(1024, "colours");
    for (size_t i = 0; i + 1 < 256 && !bytes.empty(); ++i)
      std::copy_n(bytes.begin() + static_cast<std::ptrdiff_t>(4 * i), 4, scene_.colours[i + 1].begin());
    return {};
  }

  static std::string read_text(ByteReader& chunk) {
    const uint32_t size = chunk.u32("bytes of a text");
    if (size > limits::vox_text_bytes_max) chunk.refuse("a text is too long (limits.vox_text_bytes_max)");
    const auto bytes = chunk.read_bytes(chunk.failed() ? 0 : size, "a text");
    return {bytes.begin(), bytes.end()};
  }

  static Attributes read_attributes(ByteReader& chunk) {
    Attributes attributes;
    const uint32_t count = chunk.u32("attributes");
    if (count > limits::vox_pairs_max) chunk.refuse("too many attributes (limits.vox_pairs_max)");
    for (uint32_t i = 0; i < count && !chunk.failed(); ++i) {
      std::string name = read_text(chunk);
      attributes[std::move(name)] = read_text(chunk);
    }
    return attributes;
  }

  static bool is_hidden(const Attributes& attributes) {
    const auto found = attributes.find("_hidden");
    return found != attributes.end() && found->second == "1";
  }

  Result<void> read_node(ByteReader& chunk, VoxNode::Kind kind) {
    const auto id = std::bit_cast<int32_t>(chunk.u32("number of a node"));
    const Attributes attributes = read_attributes(chunk);
    VoxNode node{.kind = kind, .hidden = is_hidden(attributes)};
    if (kind == VoxNode::Kind::transform)
      TRY(read_transform(chunk, id, node));
    else
      read_children(chunk, node);
    if (chunk.failed()) return {};
    if (scene_.nodes.size() >= limits::vox_nodes_max)
      return fail(fmt::format("it has more than {} nodes (limits.vox_nodes_max)", limits::vox_nodes_max));
    if (!scene_.nodes.emplace(id, std::move(node)).second)
      return fail("two nodes have one number: it is damaged");
    return {};
  }

  static void read_children(ByteReader& chunk, VoxNode& node) {
    const uint32_t count = chunk.u32("children of a node");
    for (uint32_t i = 0; i < count && !chunk.failed(); ++i) {
      node.children.push_back(std::bit_cast<int32_t>(chunk.u32("child of a node")));
      if (node.kind == VoxNode::Kind::shape) read_attributes(chunk);
    }
  }

  /// The first of several frames counts.
  static Result<void> read_transform(ByteReader& chunk, int32_t id, VoxNode& node) {
    node.children.push_back(std::bit_cast<int32_t>(chunk.u32("child of a node")));
    chunk.u32("reserved number");
    node.layer = std::bit_cast<int32_t>(chunk.u32("layer"));
    const uint32_t frames = chunk.u32("frames");
    for (uint32_t i = 0; i < frames && !chunk.failed(); ++i) {
      const Attributes frame = read_attributes(chunk);
      if (i > 0 || chunk.failed()) continue;
      TRY(take(frame, "_r", id, node.turn, read_turn));
      TRY(take(frame, "_t", id, node.move, read_move));
    }
    return {};
  }

  Result<void> read_layer(ByteReader& chunk) {
    const auto id = std::bit_cast<int32_t>(chunk.u32("number of a layer"));
    if (is_hidden(read_attributes(chunk))) scene_.hidden_layers.insert(id);
    return {};
  }

  /// Up to 32 names are of rows of 8 colours, as MagicaVoxel shows them; more are of one colour each.
  Result<void> read_notes(ByteReader& chunk) {
    const uint32_t count = chunk.u32("names of colours");
    if (count > 256) chunk.refuse("more names of colours than colours");
    const int each = count <= 32 ? 8 : 1;
    for (int i = 0; i < static_cast<int>(count) && !chunk.failed(); ++i) {
      const std::string name = read_text(chunk);
      for (int k = 0; k < each && !name.empty(); ++k)
        if (const int colour = each * i + k + 1; colour < 256) scene_.names.emplace(colour, name);
    }
    return {};
  }

  /// Exports have the name of a material there; MagicaVoxel has none.
  Result<void> read_material(ByteReader& chunk) {
    const uint32_t id = chunk.u32("number of a material");
    const Attributes attributes = read_attributes(chunk);
    const auto name = attributes.find("_name");
    if (name != attributes.end() && id > 0 && id < 256)
      scene_.names.insert_or_assign(static_cast<int>(id), name->second);
    return {};
  }

  VoxScene& scene_;
  std::array<int, 3> size_{};
  bool has_size_ = false;
};

}  // namespace

Result<VoxScene> parse_vox(std::span<const uint8_t> bytes) {
  VoxScene scene;
  TRY(VoxParser(scene).run(bytes));
  return scene;
}

}  // namespace scree
