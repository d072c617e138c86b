// Rows of fields (fields.h) from pointers to members: the type says how a member is read and written.
//   field<&AddPropRequest::prop, &Prop::mass_kg>("mass", "kg; …")
#pragma once

#include <array>
#include <limits>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "server/rules/fields.h"
#include "server/rules/values.h"
#include "shared/base/kind_table.h"

namespace scree {

/// Items of a list in a request at most. Above: refused.
inline constexpr int64_t list_field_max = 4096;

// How a value is read and written, and its type in the notation of LuaLS. read() changes `to` where it can.

struct FloatCodec {
  static constexpr std::string_view type = "number";
  static Result<void> read(float& to, const ScriptValue& value, const RulesMoment&) {
    to = TRY(read_float(value));
    return {};
  }
  static void write(float from, ScriptWriter& to, const RulesMoment&) { to.number(from); }
};

struct WholeCodec {
  static constexpr std::string_view type = "integer";
  static Result<void> read(uint32_t& to, const ScriptValue& value, const RulesMoment&) {
    to = TRY(read_whole(value));
    return {};
  }
  static void write(uint32_t from, ScriptWriter& to, const RulesMoment&) { to.integer(from); }
};

/// All 64 bits, as Lua's integers have them.
struct BitsCodec {
  static constexpr std::string_view type = "integer";
  static Result<void> read(uint64_t& to, const ScriptValue& value, const RulesMoment&) {
    to = static_cast<uint64_t>(TRY(value.integer()));
    return {};
  }
  static void write(uint64_t from, ScriptWriter& to, const RulesMoment&) {
    to.integer(static_cast<int64_t>(from));
  }
};

struct FlagCodec {
  static constexpr std::string_view type = "boolean";
  static Result<void> read(bool& to, const ScriptValue& value, const RulesMoment&) {
    to = TRY(value.boolean());
    return {};
  }
  static void write(bool from, ScriptWriter& to, const RulesMoment&) { to.boolean(from); }
};

struct TextCodec {
  static constexpr std::string_view type = "string";
  static Result<void> read(std::string& to, const ScriptValue& value, const RulesMoment&) {
    to = std::string(TRY(value.text()));
    return {};
  }
  static void write(const std::string& from, ScriptWriter& to, const RulesMoment&) { to.text(from); }
};

struct BytesCodec {
  static constexpr std::string_view type = "string";
  static Result<void> read(std::vector<uint8_t>& to, const ScriptValue& value, const RulesMoment&) {
    const std::string_view bytes = TRY(value.text());
    to.assign(bytes.begin(), bytes.end());
    return {};
  }
  static void write(const std::vector<uint8_t>& from, ScriptWriter& to, const RulesMoment&) {
    to.text({reinterpret_cast<const char*>(from.data()), from.size()});
  }
};

struct DigestCodec {
  static constexpr std::string_view type = "string";
  static Result<void> read(Digest& to, const ScriptValue& value, const RulesMoment&) {
    to = TRY(read_digest(value));
    return {};
  }
  static void write(const Digest& from, ScriptWriter& to, const RulesMoment&) { to.text(hex_of(from)); }
};

struct VecCodec {
  static constexpr std::string_view type = "vec";
  static Result<void> read(glm::vec3& to, const ScriptValue& value, const RulesMoment&) {
    to = TRY(read_vec(value));
    return {};
  }
  static void write(const glm::vec3& from, ScriptWriter& to, const RulesMoment&) { write_vec(to, from); }
};

struct TurnCodec {
  static constexpr std::string_view type = "turn";
  static Result<void> read(glm::quat& to, const ScriptValue& value, const RulesMoment&) {
    to = TRY(read_turn(value));
    return {};
  }
  static void write(const glm::quat& from, ScriptWriter& to, const RulesMoment&) { write_turn(to, from); }
};

struct MaterialCodec {
  static constexpr std::string_view type = "material";
  static Result<void> read(Material& to, const ScriptValue& value, const RulesMoment& moment) {
    to = TRY(read_material(value, moment));
    return {};
  }
  static void write(Material from, ScriptWriter& to, const RulesMoment& moment) {
    write_material(to, from, moment);
  }
};

struct StoreCodec {
  static constexpr std::string_view type = "store";
  static Result<void> read(StoreName& to, const ScriptValue& value, const RulesMoment& moment) {
    to = TRY(read_store(value, moment));
    return {};
  }
  static void write(const StoreName& from, ScriptWriter& to, const RulesMoment& moment) {
    write_store(to, from, moment);
  }
};

/// A piece or a prop, by its handle.
struct BodyCodec {
  static constexpr std::string_view type = "body";
  static Result<void> read(PieceId& to, const ScriptValue& value, const RulesMoment&) {
    to = TRY(read_body(value));
    return {};
  }
  static void write(PieceId from, ScriptWriter& to, const RulesMoment&) { write_body(to, from); }
};

struct JointCodec {
  static constexpr std::string_view type = "joint";
  static Result<void> read(PieceId& to, const ScriptValue& value, const RulesMoment&) {
    to = TRY(read_joint(value));
    return {};
  }
  static void write(PieceId from, ScriptWriter& to, const RulesMoment&) { write_joint(to, from); }
};

/// Mass as the volume of its rock.
struct VolumeCodec {
  static constexpr std::string_view type = "number";
  static Result<void> read(MassUnits& to, const ScriptValue& value, const RulesMoment& moment) {
    to = TRY(read_mass(value, moment));
    return {};
  }
  static void write(MassUnits from, ScriptWriter& to, const RulesMoment& moment) {
    to.number(cubic_metres(from, moment));
  }
};

/// A kind of a table of kinds, by its name.
template <HasRows Kind>
struct KindCodec {
  static constexpr std::string_view type = "string";
  static Result<void> read(Kind& to, const ScriptValue& value, const RulesMoment&) {
    const std::string_view name = TRY(value.text());
    const auto kind = kind_named<Kind>(name);
    if (!kind)
      return value.refuse("'" + std::string(name.substr(0, 64)) + "' is not " + listed(kind_names<Kind>));
    to = *kind;
    return {};
  }
  static void write(Kind from, ScriptWriter& to, const RulesMoment&) {
    if (is_known(from))
      to.text(name_of(from));
    else
      to.integer(static_cast<int64_t>(from));
  }
};

/// A list of values.
template <typename Item>
struct ListCodec {
  static constexpr std::string_view type =
      Item::type == "vec" ? "vec[]" : (Item::type == "string" ? "string[]" : "table[]");
  template <typename Value>
  static Result<void> read(std::vector<Value>& to, const ScriptValue& value, const RulesMoment& moment) {
    const int64_t length = TRY(value.length());
    if (length > list_field_max)
      return value.refuse("a list has at most " + std::to_string(list_field_max) + " items");
    to.clear();
    for (int64_t i = 1; i <= length; ++i) {
      const ReadScope scope(value);
      TRY(Item::read(to.emplace_back(), TRY(value.item(i)), moment));
    }
    return {};
  }
  template <typename Value>
  static void write(const std::vector<Value>& from, ScriptWriter& to, const RulesMoment& moment) {
    to.open_table();
    for (const Value& item : from) Item::write(item, to, moment);
    to.close_table();
  }
};

/// A table in a table.
template <const FieldTable& fields>
struct TableCodec {
  static constexpr std::string_view type = fields.name;
  template <typename Value>
  static Result<void> read(Value& to, const ScriptValue& value, const RulesMoment& moment) {
    return read_fields(&to, value, fields, moment);
  }
  template <typename Value>
  static void write(const Value& from, ScriptWriter& to, const RulesMoment& moment) {
    to.open_table();
    write_fields(&from, to, fields, moment);
    to.close_table();
  }
};

template <typename Value>
struct UsualCodec;
template <>
struct UsualCodec<float> : FloatCodec {};
template <>
struct UsualCodec<uint32_t> : WholeCodec {};
template <>
struct UsualCodec<uint64_t> : BitsCodec {};
template <>
struct UsualCodec<bool> : FlagCodec {};
template <>
struct UsualCodec<std::string> : TextCodec {};
template <>
struct UsualCodec<std::vector<uint8_t>> : BytesCodec {};
template <>
struct UsualCodec<Digest> : DigestCodec {};
template <>
struct UsualCodec<glm::vec3> : VecCodec {};
template <>
struct UsualCodec<glm::quat> : TurnCodec {};
template <>
struct UsualCodec<Material> : MaterialCodec {};
template <>
struct UsualCodec<StoreName> : StoreCodec {};
template <HasRows Kind>
struct UsualCodec<Kind> : KindCodec<Kind> {};
template <typename Item>
struct UsualCodec<std::vector<Item>> : ListCodec<UsualCodec<Item>> {};

template <typename Class, typename Value>
Class class_of_member(Value Class::*);
template <auto... Path>
struct PathRoot;
template <auto First, auto... Rest>
struct PathRoot<First, Rest...> {
  using Type = decltype(class_of_member(First));
};
template <auto... Path>
using RootOf = typename PathRoot<Path...>::Type;

template <typename Value>
Value& member_at(Value& value) {
  return value;
}
template <typename Value, typename First, typename... Rest>
auto& member_at(Value& value, First first, Rest... rest) {
  return member_at(value.*first, rest...);
}

/// The member that a path of pointers leads to.
template <auto... Path>
const auto& member_of(const void* root) {
  return member_at(*static_cast<const RootOf<Path...>*>(root), Path...);
}
template <auto... Path>
auto& member_of(void* root) {
  return member_at(*static_cast<RootOf<Path...>*>(root), Path...);
}

template <auto... Path>
using MemberOf = std::remove_cvref_t<decltype(member_of<Path...>(std::declval<const void*>()))>;

template <typename Value>
struct WithoutOptional {
  using Type = Value;
  static constexpr bool is_optional = false;
};
template <typename Value>
struct WithoutOptional<std::optional<Value>> {
  using Type = Value;
  static constexpr bool is_optional = true;
};

/// A row for the member at the path, by a codec of its own.
template <typename Codec, auto... Path>
constexpr FieldRow field_by(std::string_view name, std::string_view what) {
  using Member = MemberOf<Path...>;
  FieldRow row{.name = name, .type = Codec::type, .what = what};
  row.read = [](void* to, const ScriptValue& value, const RulesMoment& moment) -> Result<void> {
    auto& member = member_of<Path...>(to);
    if constexpr (WithoutOptional<Member>::is_optional)
      return Codec::read(member.emplace(), value, moment);
    else
      return Codec::read(member, value, moment);
  };
  row.write = [](const void* from, ScriptWriter& to, const RulesMoment& moment) {
    const auto& member = member_of<Path...>(from);
    if constexpr (WithoutOptional<Member>::is_optional)
      Codec::write(*member, to, moment);
    else
      Codec::write(member, to, moment);
  };
  if constexpr (WithoutOptional<Member>::is_optional)
    row.is_there = [](const void* of) { return member_of<Path...>(of).has_value(); };
  return row;
}

template <auto... Path>
constexpr FieldRow field(std::string_view name, std::string_view what) {
  return field_by<UsualCodec<typename WithoutOptional<MemberOf<Path...>>::Type>, Path...>(name, what);
}

/// A row that bodies have: 0 is none, and not written.
template <auto... Path>
constexpr FieldRow body_field(std::string_view name, std::string_view what) {
  FieldRow row = field_by<BodyCodec, Path...>(name, what);
  row.is_there = [](const void* of) { return member_of<Path...>(of) != 0; };
  return row;
}

constexpr FieldRow needed(FieldRow row) {
  row.needed = true;
  return row;
}
constexpr FieldRow if_applies(bool (*applies)(const void* of), FieldRow row) {
  row.applies = applies;
  return row;
}

template <size_t... Sizes>
constexpr auto joined(const std::array<FieldRow, Sizes>&... parts) {
  std::array<FieldRow, (Sizes + ...)> rows{};
  size_t at = 0;
  const auto add = [&](const auto& part) {
    for (const FieldRow& row : part) rows[at++] = row;
  };
  (add(parts), ...);
  return rows;
}

}  // namespace scree
