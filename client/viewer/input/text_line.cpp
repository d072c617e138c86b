#include "client/viewer/input/text_line.h"

#include "shared/base/text.h"

namespace scree {
namespace {

/// Empty for what is no character.
std::string utf8(uint32_t code) {
  const auto byte = [](uint32_t value) { return static_cast<char>(static_cast<unsigned char>(value)); };
  const auto later = [&](uint32_t shift) { return byte(0x80U | ((code >> shift) & 0x3FU)); };
  if (code < 0x80U) return {byte(code)};
  if (code < 0x800U) return {byte(0xC0U | (code >> 6U)), later(0)};
  if (code < 0x10000U) return {byte(0xE0U | (code >> 12U)), later(6), later(0)};
  if (code < 0x110000U) return {byte(0xF0U | (code >> 18U)), later(12), later(6), later(0)};
  return {};
}

}  // namespace

void TextLine::add(uint32_t code_point) {
  const std::string character = utf8(code_point);
  if (character.empty() || text_.size() + character.size() > bytes_max_) return;
  if (!fault_of_text(text_ + character)) text_ += character;
}

void TextLine::erase() {
  const auto is_later_byte = [](char byte) { return (static_cast<unsigned char>(byte) & 0xC0U) == 0x80U; };
  do {
    while (!text_.empty() && is_later_byte(text_.back())) text_.pop_back();
    if (!text_.empty()) text_.pop_back();
  } while (fault_of_text(text_));
}

}  // namespace scree
