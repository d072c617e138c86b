#include "server/rules/values.h"

#include <array>
#include <charconv>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>
#include <string>

#include "shared/base/check.h"
#include "shared/base/listed.h"
#include "shared/operation/ledger.h"

namespace scree {

namespace {

/// A field of a table, or an item where there is no field of that name.
Result<double> read_part(const ScriptValue& table, std::string_view field, int64_t item) {
  const ScriptValue named = TRY(table.field(field));
  return named.is_nil() ? TRY(table.item(item)).number() : named.number();
}

std::optional<uint64_t> number_of_hex(std::string_view text) {
  uint64_t number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number, 16);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return number;
}

std::string hex_of_number(uint64_t number) {
  std::array<char, 16> digits{};
  const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), number, 16).ptr;
  const std::string text(digits.data(), end);
  return std::string(16 - text.size(), '0') + text;
}

const Palette& palette_of(const RulesMoment& moment) {
  CHECK(moment.world != nullptr, "materials are asked for in a handler");
  return *moment.world->config().palette;
}

Result<float> float_of(double number, const ScriptValue& value) {
  const auto result = static_cast<float>(number);
  if (!std::isfinite(result)) return value.refuse("the number is too large");
  return result;
}

}  // namespace

Result<float> read_float(const ScriptValue& value) {
  return float_of(TRY(value.number()), value);
}

Result<uint32_t> read_whole(const ScriptValue& value) {
  const int64_t number = TRY(value.integer());
  if (number < 0 || number > std::numeric_limits<uint32_t>::max())
    return value.refuse(std::to_string(number) + " is not 0 to 4294967295");
  return static_cast<uint32_t>(number);
}

Result<glm::vec3> read_vec(const ScriptValue& value) {
  if (!value.is_table()) return fail(value.name() + " is " + value.type_text() + ", not a vec");
  const ReadScope scope(value);
  glm::vec3 result(0.0F);
  constexpr std::array<std::string_view, 3> axes{"x", "y", "z"};
  for (int i = 0; i < 3; ++i) {
    const Result<double> part = read_part(value, axes[static_cast<size_t>(i)], i + 1);
    if (!part) return fail(value.name() + " is no vec, such as vec(1, 2, 3): " + part.error().message);
    result[i] = TRY(float_of(*part, value));
  }
  return result;
}

void write_vec(ScriptWriter& to, glm::vec3 value) {
  to.vector(value.x, value.y, value.z);
}

Result<glm::vec3> read_unit(const ScriptValue& value) {
  const glm::dvec3 way(TRY(read_vec(value)));
  const double length = glm::length(way);
  if (!(length > 1e-6)) return value.refuse("a direction has a length above 0");
  return glm::vec3(way / length);
}

Result<glm::quat> read_turn(const ScriptValue& value) {
  if (!value.is_table()) return fail(value.name() + " is " + value.type_text() + ", not a turn");
  const ReadScope scope(value);
  const ScriptValue degrees = TRY(value.field("degrees"));
  if (!degrees.is_nil()) {
    const double half = TRY(degrees.number()) * std::numbers::pi / 360.0;
    const ScriptValue about = TRY(value.field("axis"));
    const glm::vec3 axis = about.is_nil() ? glm::vec3(0.0F, 1.0F, 0.0F) : TRY(read_unit(about));
    const auto sine = static_cast<float>(std::sin(half));
    return glm::quat(static_cast<float>(std::cos(half)), axis.x * sine, axis.y * sine, axis.z * sine);
  }
  std::array<float, 4> parts{};
  constexpr std::array<std::string_view, 4> names{"x", "y", "z", "w"};
  for (size_t i = 0; i < 4; ++i) {
    const ScriptValue part = TRY(value.field(names[i]));
    if (part.is_nil())
      return value.refuse("a turn is {axis = vec, degrees = number} or has the fields x, y, z and w");
    parts[i] = TRY(read_float(part));
  }
  const glm::dquat turn(parts[3], parts[0], parts[1], parts[2]);
  const double length = glm::length(turn);
  if (!(length > 1e-6)) return value.refuse("a turn has a length above 0");
  // Those of length 1 stay as they are, bit by bit.
  if (std::abs(length - 1.0) < 1e-4) return glm::quat(parts[3], parts[0], parts[1], parts[2]);
  return glm::quat(turn / length);
}

void write_turn(ScriptWriter& to, const glm::quat& value) {
  to.open_table();
  const auto field = [&](std::string_view name, float part) {
    to.name(name);
    to.number(part);
  };
  field("x", value.x);
  field("y", value.y);
  field("z", value.z);
  field("w", value.w);
  to.close_table();
}

Result<Material> read_material(const ScriptValue& value, const RulesMoment& moment) {
  const Palette& palette = palette_of(moment);
  if (value.is_text()) {
    const std::string_view name = TRY(value.text());
    if (const auto material = palette.named(name)) return *material;
    return value.refuse("there is no material '" + std::string(name.substr(0, 64)) +
                        "': " + listed(palette.names()));
  }
  if (!value.is_number())
    return fail(value.name() + " is " + value.type_text() + ", not the name of a material");
  const int64_t row = TRY(value.integer());
  if (row < 0 || row >= static_cast<int64_t>(palette.rows.size()))
    return value.refuse("material " + std::to_string(row) + " is not 0 to " +
                        std::to_string(palette.rows.size() - 1));
  return static_cast<Material>(row);
}

void write_material(ScriptWriter& to, Material material, const RulesMoment& moment) {
  const Palette& palette = palette_of(moment);
  if (palette.has(material))
    to.text(palette.name(material));
  else  // in a request that the world is going to refuse
    to.integer(static_cast<int64_t>(row_number(material)));
}

Result<StoreName> read_store(const ScriptValue& value, const RulesMoment& moment) {
  if (value.is_text()) {
    const std::string_view name = TRY(value.text());
    const auto kind = kind_named<StoreKind>(name);
    if (kind == StoreKind::world || kind == StoreKind::own) return StoreName{*kind};
    const StoreName store = named_store(std::string(name));
    if (const Result<void> valid = validate(store); !valid) return value.refuse(valid.error().message);
    return store;
  }
  if (value.is_table()) {
    const ReadScope scope(value);
    const ScriptValue token = TRY(value.field("token"));
    const ScriptValue session = TRY(value.field("session"));
    if (token.is_text())
      if (const auto number = number_of_hex(TRY(token.text())); number && *number != 0)
        return StoreName{StoreKind::token, *number};
    if (session.is_integer() && TRY(session.integer()) > 0)
      return StoreName{StoreKind::session, static_cast<uint64_t>(TRY(session.integer()))};
  } else if (const Result<uint64_t> number = value.handle(person_type); number) {
    const auto person = moment.persons->find(*number);
    const bool here = person != moment.persons->end();
    return store_of_person(here ? person->second.who.token_id : 0, *number);
  }
  return value.refuse("a store is \"world\", a person or a name");
}

void write_store(ScriptWriter& to, const StoreName& store, const RulesMoment& moment) {
  const auto in_table = [&](const auto& write_number) {
    to.open_table();
    to.name(name_of(store.kind));
    write_number();
    to.close_table();
  };
  switch (store.kind) {
    case StoreKind::own:
    case StoreKind::world:
      to.text(name_of(store.kind));
      return;
    case StoreKind::token:
      for (const auto& [session, person] : *moment.persons)
        if (person.who.token_id == store.number) return write_person(to, session);
      in_table([&] { to.text(hex_of_number(store.number)); });
      return;
    case StoreKind::session:
      if (moment.persons->contains(store.number)) return write_person(to, store.number);
      in_table([&] { to.integer(static_cast<int64_t>(store.number)); });
      return;
    case StoreKind::named:
      to.text(store.name);
      return;
  }
  to.nil();
}

namespace {

Result<PieceId> read_id(const ScriptValue& value, std::string_view type) {
  const uint64_t number = value.is_number() ? TRY(read_whole(value)) : TRY(value.handle(type));
  if (number == 0 || number > std::numeric_limits<PieceId>::max())
    return value.refuse(std::to_string(number) + " is the number of no " + std::string(type));
  return static_cast<PieceId>(number);
}

}  // namespace

Result<PieceId> read_body(const ScriptValue& value) {
  return read_id(value, body_type);
}

Result<PieceId> read_joint(const ScriptValue& value) {
  return read_id(value, joint_type);
}

Result<uint64_t> read_person(const ScriptValue& value) {
  return value.handle(person_type);
}

void write_party(ScriptWriter& to, uint64_t party, const RulesMoment& moment) {
  if (const uint64_t person = moment.person_of(party); person != 0)
    write_person(to, person);
  else
    to.nil();
}

Result<Digest> read_digest(const ScriptValue& value) {
  const std::string_view text = TRY(value.text());
  Digest digest{};
  bool fits = text.size() == 2 * digest.size();
  for (size_t i = 0; fits && i < digest.size(); ++i) {
    const auto byte = number_of_hex(text.substr(2 * i, 2));
    fits = byte.has_value();
    digest[i] = static_cast<uint8_t>(byte.value_or(0));
  }
  if (!fits) return value.refuse("64 hexadecimal digits are needed");
  return digest;
}

double cubic_metres(MassUnits mass, const RulesMoment& moment) {
  CHECK(moment.world != nullptr);
  const double voxel_m = moment.world->config().terrain.voxel_size_m;
  return static_cast<double>(mass) / units_per_voxel * voxel_m * voxel_m * voxel_m;
}

Result<MassUnits> read_mass(const ScriptValue& value, const RulesMoment& moment) {
  CHECK(moment.world != nullptr);
  const double volume_m3 = TRY(value.number());
  const double voxel_m = moment.world->config().terrain.voxel_size_m;
  const double units = volume_m3 / (voxel_m * voxel_m * voxel_m) * units_per_voxel;
  if (!(units >= 0.0) || units > static_cast<double>(limits::ledger_mass_max))
    return value.refuse("no store has a volume of that size");
  return static_cast<MassUnits>(std::llround(units));
}

}  // namespace scree
