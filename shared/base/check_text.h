// How a failed check shows the values that it compared: in bounded text, without allocation.
//
// Known are numbers, enumerators (as numbers), text, pointers, optionals, vectors, boxes, and ranges of
// these. Any other type needs `std::string check_text(const Type&)` in its namespace.
#pragma once

#include <cstddef>
#include <string_view>
#include <type_traits>

namespace scree {

/// Text that ends where its room does.
class CheckText {
 public:
  void add(std::string_view text);
  void add_number(long long value);
  void add_number(unsigned long long value);
  void add_number(double value);
  void add_address(const void* value);
  const char* text() const { return text_; }

 private:
  static constexpr size_t bytes_max = 240;
  char text_[bytes_max + 1] = {};
  size_t bytes_ = 0;
};

namespace checks {

/// Items of a range that are shown.
inline constexpr size_t items_max = 8;

template <typename Value>
void add_value(CheckText& to, const Value& value);

template <typename Range>
void add_range(CheckText& to, const Range& range) {
  size_t count = 0;
  to.add("[");
  for (const auto& item : range) {
    if (count > 0) to.add(", ");
    if (count++ == items_max) {
      to.add("...");
      break;
    }
    add_value(to, item);
  }
  to.add("]");
}

template <typename Vector>
void add_vector(CheckText& to, const Vector& value) {
  to.add("(");
  add_value(to, value.x);
  to.add(", ");
  add_value(to, value.y);
  if constexpr (requires { value.z; }) {
    to.add(", ");
    add_value(to, value.z);
  }
  if constexpr (requires { value.w; }) {
    to.add(", ");
    add_value(to, value.w);
  }
  to.add(")");
}

template <typename Number>
void add_scalar(CheckText& to, Number value) {
  if constexpr (std::is_same_v<Number, bool>)
    to.add(value ? "true" : "false");
  else if constexpr (std::is_enum_v<Number>)
    add_scalar(to, static_cast<std::underlying_type_t<Number>>(value));
  else if constexpr (std::is_floating_point_v<Number>)
    to.add_number(static_cast<double>(value));
  else if constexpr (std::is_unsigned_v<Number>)
    to.add_number(static_cast<unsigned long long>(value));
  else
    to.add_number(static_cast<long long>(value));
}

template <typename Value>
void add_value(CheckText& to, const Value& value) {
  if constexpr (requires { check_text(value); }) {
    to.add(check_text(value));
  } else if constexpr (std::is_arithmetic_v<Value> || std::is_enum_v<Value>) {
    add_scalar(to, value);
  } else if constexpr (std::is_null_pointer_v<Value>) {
    to.add_address(nullptr);
  } else if constexpr (std::is_convertible_v<const Value&, std::string_view>) {
    to.add("\"");
    to.add(value);
    to.add("\"");
  } else if constexpr (std::is_convertible_v<const Value&, const void*>) {
    to.add_address(value);
  } else if constexpr (requires { to.add_address(value.get()); }) {
    to.add_address(value.get());
  } else if constexpr (requires {
                         value.has_value();
                         *value;
                       }) {
    if (value.has_value())
      add_value(to, *value);
    else
      to.add("none");
  } else if constexpr (requires {
                         value.x;
                         value.y;
                       }) {
    add_vector(to, value);
  } else if constexpr (requires {
                         value.lo;
                         value.hi;
                       }) {
    add_value(to, value.lo);
    to.add(" to ");
    add_value(to, value.hi);
  } else {
    static_assert(
        requires {
          value.begin();
          value.end();
        },
        "give the type a check_text(value)");
    add_range(to, value);
  }
}

}  // namespace checks
}  // namespace scree
