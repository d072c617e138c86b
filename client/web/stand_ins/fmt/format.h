// -*- C++ -*-
// Stands for fmt in the page's client: fmt::format() with places {} in order, for texts and numbers. The web
// build alone uses it, because fmt would add 28 KiB, packed, to the page. Any other format does not compile.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <type_traits>

namespace fmt {

/// A text with as many places {} as there are arguments, and no other brace.
template <typename... Arguments>
class Places {
 public:
  consteval Places(const char* text) : text_(text) {
    size_t places = 0;
    for (size_t at = 0; at < text_.size(); ++at) {
      if (text_[at] == '}') throw "a brace that is no place";
      if (text_[at] != '{') continue;
      if (at + 1 == text_.size() || text_[++at] != '}') throw "a place with a format";
      ++places;
    }
    if (places != sizeof...(Arguments)) throw "as many places as arguments";
  }
  std::string_view text() const { return text_; }

 private:
  std::string_view text_;
};

namespace places {

inline void append(std::string& to, std::string_view text) {
  to += text;
}
template <typename Number>
requires std::is_arithmetic_v<Number>
void append(std::string& to, Number number) {
  to += std::to_string(number);
}

/// Appends the text before the next place. Removes it and the place from `text`.
inline void append_before(std::string& to, std::string_view& text) {
  const size_t place = text.find('{');
  to += text.substr(0, place);
  text.remove_prefix(place + 2);
}

}  // namespace places

template <typename... Arguments>
std::string format(Places<std::type_identity_t<Arguments>...> format, const Arguments&... arguments) {
  std::string text;
  std::string_view rest = format.text();
  ((places::append_before(text, rest), places::append(text, arguments)), ...);
  text += rest;
  return text;
}

}  // namespace fmt
