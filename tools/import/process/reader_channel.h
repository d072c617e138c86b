// Values between an import and the process that reads a foreign file for it, as they lie in memory: both are
// the same program. What arrives is bounded; its meaning is for the receiver to check. One thread.
#pragma once

#include <algorithm>
#include <cstring>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "shared/base/result.h"
#include "tools/import/process/limits.h"

namespace scree {

class ReaderChannel {
 public:
  virtual ~ReaderChannel() = default;

  /// Values wait in memory until there are many, or until flush().
  template <typename T>
  Result<void> put(const T& value) {
    return put_all(std::span<const T>(&value, 1));
  }
  template <typename T>
  Result<void> put_all(std::span<const T> values) {
    static_assert(std::is_trivially_copyable_v<T>);
    return put_bytes(std::as_bytes(values));
  }
  /// Their number, then they.
  template <typename T>
  Result<void> put_list(const std::vector<T>& values) {
    TRY(put(static_cast<uint64_t>(values.size())));
    return put_all(std::span<const T>(values));
  }
  /// Cut to limits::reader_words_bytes_max.
  Result<void> put_text(std::string_view text);
  Result<void> flush();

  template <typename T>
  Result<T> get() {
    static_assert(std::is_trivially_copyable_v<T>);
    T value{};
    TRY(get_bytes(std::as_writable_bytes(std::span<T>(&value, 1))));
    return value;
  }
  template <typename T>
  Result<void> get_all(std::span<T> values) {
    static_assert(std::is_trivially_copyable_v<T>);
    return get_bytes(std::as_writable_bytes(values));
  }
  /// A list of put_list(). Memory is made as the values come, not as their number promises.
  template <typename T>
  Result<std::vector<T>> get_list(uint64_t count_max) {
    const auto count = TRY(get<uint64_t>());
    if (count > count_max) return fail("its reader sends more values than there can be");
    std::vector<T> values;
    constexpr uint64_t at_once = std::max<uint64_t>(1, limits::reader_frame_bytes_max / sizeof(T));
    while (values.size() < count) {
      const size_t had = values.size();
      values.resize(had + static_cast<size_t>(std::min(at_once, count - had)));
      TRY(get_all(std::span<T>(values).subspan(had)));
    }
    return values;
  }
  /// Fit to be shown (shared/base/text.h): names in a foreign file may hold what steers a terminal.
  Result<std::string> get_text();

 protected:
  /// At most limits::reader_frame_bytes_max bytes.
  virtual Result<void> send(std::span<const uint8_t> bytes) = 0;
  virtual Result<std::vector<uint8_t>> receive() = 0;

 private:
  Result<void> put_bytes(std::span<const std::byte> bytes);
  Result<void> get_bytes(std::span<std::byte> bytes);

  std::vector<uint8_t> out_;
  std::vector<uint8_t> in_;
  size_t in_used_ = 0;
};

}  // namespace scree
