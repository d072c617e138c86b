// A line of text as a person types it: UTF-8, bounded. No window.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

namespace scree {

class TextLine {
 public:
  /// Bytes at most: what would be over is not taken.
  explicit TextLine(size_t bytes_max) : bytes_max_(bytes_max) {}

  /// A character, by its code point; those that may not be shown are not taken.
  void add(uint32_t code_point);
  /// Takes the last character away, with what shapes it.
  void erase();
  const std::string& text() const { return text_; }

 private:
  size_t bytes_max_;
  std::string text_;
};

}  // namespace scree
