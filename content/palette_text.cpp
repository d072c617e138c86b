#include "content/palette_text.h"

#include <algorithm>
#include <array>
#include <map>
#include <optional>

namespace scree {
namespace {
/// The parser of toml++ breaks preconditions of its own on malformed text such as "[[[" or "[&" (its issues
/// 294 and 301). It asserts them in debug builds, and elsewhere the compiler may assume them. Here they are
/// errors.
struct BrokenPrecondition {};
[[noreturn]] void break_precondition() {
  throw BrokenPrecondition{};
}
}  // namespace
}  // namespace scree
#pragma push_macro("NDEBUG")
#undef NDEBUG
#define TOML_ASSERT(holds) ((holds) ? static_cast<void>(0) : ::scree::break_precondition())
// A palette needs three levels. Each is frames of the stack, and a file may be hostile.
#define TOML_MAX_NESTED_VALUES 8
#include <toml++/toml.h>
#pragma pop_macro("NDEBUG")

#include "content/limits.h"
#include "content/toml_lines.h"
#include "shared/base/near_name.h"
#include "shared/base/text.h"
#include "shared/material/material_members.h"
#include "shared/material/rubble.h"

namespace scree {

namespace {

constexpr size_t shown_bytes_max = 64;

struct ImageMember {
  std::string_view name;
  std::optional<Digest> MaterialLook::*member;
};
constexpr std::array image_members{ImageMember{"look.albedo", &MaterialLook::albedo},
                                   ImageMember{"look.normal", &MaterialLook::normal}};

struct GroundLayer {
  std::string_view name;
  Material GroundRows::*member;
};
constexpr std::array ground_layers{GroundLayer{"bulk", &GroundRows::bulk},
                                   GroundLayer{"soil", &GroundRows::soil},
                                   GroundLayer{"cap", &GroundRows::cap}};

/// A word of the file as an error may repeat it.
std::string in_quotes(std::string_view text) {
  return "'" + showable(text, shown_bytes_max) + "'";
}

std::string near_of(std::string_view name, const std::vector<std::string>& known) {
  return did_you_mean(name, known, std::clamp<size_t>(name.size() / 3, 1, 4));
}

const char* words_on(toml::node_type type) {
  switch (type) {
    case toml::node_type::table:
      return "a table";
    case toml::node_type::array:
      return "a list";
    case toml::node_type::string:
      return "a text";
    case toml::node_type::integer:
    case toml::node_type::floating_point:
      return "a number";
    case toml::node_type::boolean:
      return "true or false";
    case toml::node_type::date:
    case toml::node_type::time:
    case toml::node_type::date_time:
      return "a date or a time";
    default:
      return "nothing";
  }
}

std::optional<double> number_in(const toml::node& node) {
  if (const auto* whole = node.as_integer()) return static_cast<double>(whole->get());
  if (const auto* fraction = node.as_floating_point()) return fraction->get();
  return std::nullopt;
}

/// Names of all members of a row, and of the groups that they lie in.
std::vector<std::string> make_row_names() {
  std::vector<std::string> names = number_names();
  std::ranges::copy(choice_names(), std::back_inserter(names));
  for (const ImageMember& image : image_members) names.emplace_back(image.name);
  for (const char* name : {"name", "rubble_of", "fill", "loose"}) names.emplace_back(name);
  for (size_t i = 0; i < names.size(); ++i)
    for (size_t dot = names[i].find('.'); dot != std::string::npos; dot = names[i].find('.', dot + 1))
      if (std::string group = names[i].substr(0, dot); std::ranges::find(names, group) == names.end())
        names.push_back(std::move(group));
  return names;
}
const std::vector<std::string>& row_names() {
  static const std::vector<std::string> names = make_row_names();
  return names;
}

bool is_group(std::string_view name) {
  const std::string begin = std::string(name) + ".";
  return std::ranges::any_of(row_names(), [&](const std::string& known) { return known.starts_with(begin); });
}

bool is_known(std::string_view name) {
  return std::ranges::find(row_names(), name) != row_names().end();
}

bool breaks_parser(std::string_view text) {
  try {
    const toml::table parsed = toml::parse(text);
  } catch (const toml::parse_error&) {
  } catch (const BrokenPrecondition&) {
    return true;
  }
  return false;
}

/// The line at which the parser breaks a precondition, of a text on which it does: the parser reads it from
/// the beginning on.
size_t line_of_break(std::string_view text) {
  std::vector<size_t> ends;
  for (size_t at = 0; at < text.size(); ++at)
    if (text[at] == '\n') ends.push_back(at + 1);
  const auto first =
      std::ranges::partition_point(ends, [&](size_t end) { return !breaks_parser(text.substr(0, end)); });
  return static_cast<size_t>(first - ends.begin()) + 1;
}

/// Reads one file. Errors leave it as TRY hands them on.
class PaletteReader {
 public:
  PaletteReader(std::string name, const ReadImage& read_image)
      : name_(std::move(name)), read_image_(read_image) {}

  Result<Palette> run(std::string_view text) {
    if (text.size() > limits::palette_file_bytes_max)
      return refuse(0, "it has " + std::to_string((text.size() + 1023) >> 10U) + " KiB, over the limit of " +
                           std::to_string(limits::palette_file_bytes_max >> 10U) + " KiB");
    const auto ascii = ascii_toml(text);
    if (!ascii) return refuse(ascii.error().line, ascii.error().words);
    try {
      const toml::table document = toml::parse(*ascii, name_);
      return read(document);
    } catch (const toml::parse_error& error) {
      return refuse(error.source(), showable(error.description(), 300));
    } catch (const BrokenPrecondition&) {
      return refuse(line_of_break(*ascii), "it is no TOML");
    }
  }

 private:
  tl::unexpected<Error> refuse(const toml::source_region& at, const std::string& words) const {
    return refuse(at.begin.line, words);
  }
  /// Line 0: the file as a whole.
  tl::unexpected<Error> refuse(size_t line, const std::string& words) const {
    std::string place = name_;
    if (line > 0) place.append(":").append(std::to_string(line));
    return fail(place + ": " + (subject_.empty() ? "" : subject_ + ": ") + words);
  }
  Result<void> at(const toml::node& node, const Result<void>& result) const {
    if (!result) return refuse(node.source(), result.error().message);
    return {};
  }
  tl::unexpected<Error> refuse_type(const toml::node& node, std::string_view member,
                                    const char* wanted) const {
    return refuse(node.source(),
                  std::string(member) + " must be " + wanted + ", and is " + words_on(node.type()));
  }
  tl::unexpected<Error> refuse_name(const toml::key& key, std::string_view name,
                                    const std::vector<std::string>& known) const {
    return refuse(key.source(), "there is no " + in_quotes(name) + near_of(name, known));
  }

  Result<Palette> read(const toml::table& document);
  Result<void> read_materials(const toml::table& document);
  Result<MaterialRow> read_row(const toml::table& table);
  Result<void> read_members(MaterialRow& row, const toml::table& table, const std::string& prefix);
  Result<void> read_member(MaterialRow& row, const std::string& name, const toml::node& node);
  Result<void> read_rubble(MaterialRow& row, const std::string& name, const toml::node& node);
  Result<void> read_image(MaterialRow& row, const ImageMember& image, const toml::node& node);
  Result<void> read_ground(const toml::table& document);
  Result<void> read_layer(const GroundLayer& layer, const toml::table& table);
  Result<void> read_depth(const toml::key& key, const toml::node& node);

  std::string name_;
  const ReadImage& read_image_;
  std::string subject_;          ///< the row that is being read, in words
  std::optional<uint8_t> fill_;  ///< of the row that is being read
  Palette palette_;
};

Result<Palette> PaletteReader::read(const toml::table& document) {
  for (const auto& [key, node] : document)
    if (key != "material" && key != "ground") return refuse_name(key, key, {"material", "ground"});
  TRY(read_materials(document));
  TRY(read_ground(document));
  add_rubble(palette_);
  if (const auto valid = validate(palette_); !valid) return refuse(0, valid.error().message);
  return std::move(palette_);
}

Result<void> PaletteReader::read_materials(const toml::table& document) {
  const toml::node* node = document.get("material");
  const toml::node* const in_ground = document["ground"]["material"].node();
  if (node == nullptr && in_ground != nullptr)
    return refuse(in_ground->source(),
                  "this 'material' stands under [ground] and belongs to it: put it before [ground]");
  if (node == nullptr)
    return refuse(0, "it has no material: a palette has 1 to 255, each a table [[material]]");
  const toml::array* list = node->as_array();
  if (list == nullptr || !list->is_homogeneous(toml::node_type::table))
    return refuse(node->source(), "each material is a table [[material]]");
  if (list->size() > materials_max)
    return refuse(
        (*list)[materials_max].source(),
        std::to_string(list->size()) + " materials are over the limit of " + std::to_string(materials_max));
  std::map<std::string, size_t> lines;
  for (const toml::node& one : *list) {
    subject_ = "material " + std::to_string(palette_.rows.size());
    MaterialRow row = TRY(read_row(*one.as_table()));
    const auto [other, fresh] = lines.emplace(row.name, one.source().begin.line);
    if (!fresh)
      return refuse(one.source(),
                    "another material, in line " + std::to_string(other->second) + ", has this name");
    palette_.rows.push_back(std::move(row));
  }
  subject_.clear();
  return {};
}

Result<MaterialRow> PaletteReader::read_row(const toml::table& table) {
  const toml::node* name = table.get("name");
  if (name == nullptr) return refuse(table.source(), "it has no name");
  if (!name->is_string()) return refuse_type(*name, "name", "a text");
  MaterialRow row;
  row.name = name->as_string()->get();
  TRY(at(*name, check_material_name(row.name)));
  subject_ = row.name;
  fill_.reset();
  TRY(read_members(row, table, ""));
  if (fill_ && !row.rubble) return refuse(table.source(), "fill is of rubble alone: rubble_of is missing");
  if (fill_) row.rubble->fill = *fill_;
  return row;
}

Result<void> PaletteReader::read_members(MaterialRow& row, const toml::table& table,
                                         const std::string& prefix) {
  for (const auto& [key, node] : table) {
    const std::string name = prefix + std::string(key.str());
    if (!is_known(name)) return refuse_name(key, name, row_names());
    if (!is_group(name))
      TRY(read_member(row, name, node));
    else if (node.is_table())
      TRY(read_members(row, *node.as_table(), name + "."));
    else
      return refuse_type(node, name, "a table");
  }
  return {};
}

Result<void> PaletteReader::read_member(MaterialRow& row, const std::string& name, const toml::node& node) {
  if (name == "name") return {};  // read before, for it stands in errors
  if (name == "rubble_of" || name == "fill" || name == "loose") return read_rubble(row, name, node);
  for (const ImageMember& image : image_members)
    if (image.name == name) return read_image(row, image, node);
  if (number_of(row, name)) {
    const std::optional<double> value = number_in(node);
    return value ? at(node, set_number(row, name, *value)) : refuse_type(node, name, "a number");
  }
  if (!node.is_string()) return refuse_type(node, name, "a text");
  return at(node, set_choice(row, name, showable(node.as_string()->get(), shown_bytes_max)));
}

/// `fill` alone says nothing: `rubble_of` stands beside it, before or after.
Result<void> PaletteReader::read_rubble(MaterialRow& row, const std::string& name, const toml::node& node) {
  if (name == "loose") {
    if (!node.is_boolean()) return refuse_type(node, name, "true or false");
    row.loose = node.as_boolean()->get();
    return {};
  }
  if (name == "fill") {
    const std::optional<double> value = number_in(node);
    if (!value) return refuse_type(node, name, "a number");
    if (!(*value >= 0.25 && *value <= 0.99))
      return refuse(node.source(), "fill must lie between 0.25 and 0.99");
    fill_ = static_cast<uint8_t>(*value * fill_solid + 0.5);
    return {};
  }
  if (!node.is_string()) return refuse_type(node, name, "a text");
  const std::string stones = node.as_string()->get();
  const std::optional<Material> of = palette_.named(stones);
  if (!of) {
    const auto rows = palette_.names();
    return refuse(node.source(), "rubble_of " + in_quotes(stones) + " is no material above it" +
                                     near_of(stones, {rows.begin(), rows.end()}));
  }
  row.rubble = RubbleOf{.of = *of};
  return {};
}

Result<void> PaletteReader::read_image(MaterialRow& row, const ImageMember& image, const toml::node& node) {
  const std::string member(image.name);
  if (!node.is_string()) return refuse_type(node, member, "a text");
  if (!read_image_) return refuse(node.source(), member + " is of a palette's file, which has a folder");
  const Result<Digest> digest = read_image_(node.as_string()->get());
  if (!digest) return refuse(node.source(), member + ": " + digest.error().message);
  row.look.*image.member = *digest;
  return {};
}

Result<void> PaletteReader::read_ground(const toml::table& document) {
  const toml::node* node = document.get("ground");
  if (node == nullptr)
    return refuse(0, "it has no table [ground], which names the materials of bulk, soil and cap");
  if (!node->is_table()) return refuse_type(*node, "ground", "a table");
  subject_ = "ground";
  for (const GroundLayer& layer : ground_layers) TRY(read_layer(layer, *node->as_table()));
  for (const auto& [key, value] : *node->as_table()) {
    if (std::ranges::find(ground_layers, key.str(), &GroundLayer::name) == ground_layers.end())
      TRY(read_depth(key, value));
  }
  subject_.clear();
  return {};
}

Result<void> PaletteReader::read_layer(const GroundLayer& layer, const toml::table& table) {
  const toml::node* node = table.get(layer.name);
  if (node == nullptr)
    return refuse(table.source(), "it does not say the material of " + std::string(layer.name));
  if (!node->is_string()) return refuse_type(*node, layer.name, "a text");
  const std::string name = node->as_string()->get();
  const std::optional<Material> material = palette_.named(name);
  if (!material) {
    const auto rows = palette_.names();
    return refuse(node->source(), std::string(layer.name) + " " + in_quotes(name) + " is no material" +
                                      near_of(name, {rows.begin(), rows.end()}));
  }
  palette_.ground.*layer.member = *material;
  return {};
}

Result<void> PaletteReader::read_depth(const toml::key& key, const toml::node& node) {
  std::vector<std::string> known;
  for (const GroundNumber& member : ground_numbers()) {
    known.emplace_back(member.name);
    if (member.name != key.str()) continue;
    const std::optional<double> value = number_in(node);
    if (!value) return refuse_type(node, member.name, "a number");
    TRY(at(node, check_number(member, *value)));
    member.put(palette_.ground, static_cast<float>(*value));
    return {};
  }
  for (const GroundLayer& layer : ground_layers) known.emplace_back(layer.name);
  return refuse_name(key, key.str(), known);
}

}  // namespace

Result<Palette> read_palette(std::string_view text, const std::string& name, const ReadImage& read_image) {
  return PaletteReader(name, read_image).run(text);
}

}  // namespace scree
