#include "tools/import/gdal/ascii_grid.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cpl_vsi.h>
#include <fmt/format.h>
#include <memory>
#include <string_view>
#include <vector>

#include "tools/import/gdal/gdal_library.h"

namespace scree {

namespace {

struct Closer {
  void operator()(VSILFILE* file) const { VSIFCloseL(file); }
};

/// The words of a file, one after the other.
class Words {
 public:
  explicit Words(const std::string& address) : file_(VSIFOpenL(address.c_str(), "rb")), block_(block_bytes) {}

  bool is_open() const { return file_ != nullptr; }
  /// False at the end. No word is longer than `longest`: the rest of it is another one.
  bool next(std::string& word) {
    word.clear();
    for (int byte = read(); byte >= 0; byte = read()) {
      const bool parts = byte == ' ' || (byte >= '\t' && byte <= '\r') || byte == 0;
      if (!parts) word.push_back(static_cast<char>(byte));
      if (parts ? !word.empty() : word.size() >= longest) return true;
    }
    return !word.empty();
  }

 private:
  static constexpr size_t block_bytes = size_t{1} << 20U, longest = 64;

  int read() {
    if (at_ == have_) {
      have_ = VSIFReadL(block_.data(), 1, block_.size(), file_.get());
      at_ = 0;
    }
    return at_ < have_ ? static_cast<unsigned char>(block_[at_++]) : -1;
  }

  std::unique_ptr<VSILFILE, Closer> file_;
  std::vector<char> block_;
  size_t at_ = 0, have_ = 0;
};

/// Also by a comma in place of the point, and as Windows writes what is no number ("1.#QNAN").
bool is_number(std::string word) {
  std::ranges::replace(word, ',', '.');
  const char* const begin = word.data() + (word.starts_with('+') ? 1 : 0);
  const char* const end = word.data() + word.size();
  double value = 0.0;
  const auto [rest, error] = std::from_chars(begin, end, value);
  if (error == std::errc::invalid_argument) return false;
  constexpr std::array<std::string_view, 3> odd{"#QNAN", "#IND", "#INF"};
  const std::string_view left(rest, static_cast<size_t>(end - rest));
  return left.empty() ||
         std::ranges::any_of(odd, [&](std::string_view name) { return left.starts_with(name); });
}

bool is_keyword(const std::string& word) {
  const char first = word.front();
  return ((first >= 'a' && first <= 'z') || (first >= 'A' && first <= 'Z')) && !is_number(word);
}

}  // namespace

Result<void> check_ascii_grid(const std::string& address, uint64_t columns, uint64_t rows) {
  Words words(address);
  if (!words.is_open()) return fail("it cannot be read again");
  std::string word;
  bool more = words.next(word);
  constexpr int keywords_max = 16;
  for (int i = 0; i < keywords_max && more && is_keyword(word); ++i)
    more = words.next(word) && words.next(word);
  uint64_t count = 0;
  for (; more; more = words.next(word), ++count)
    if (!is_number(word))
      return fail(fmt::format("'{}' is no height: row {}, column {}", shown(word.c_str()),
                              count / columns + 1, count % columns + 1));
  if (count == columns * rows) return {};
  return fail(fmt::format("it has {} heights, and its header says {} × {}", count, columns, rows));
}

}  // namespace scree
