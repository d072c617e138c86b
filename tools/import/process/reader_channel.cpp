#include "tools/import/process/reader_channel.h"

#include "shared/base/text.h"

namespace scree {

Result<void> ReaderChannel::put_bytes(std::span<const std::byte> bytes) {
  while (!bytes.empty()) {
    const size_t room = limits::reader_frame_bytes_max - out_.size();
    const auto part = bytes.first(std::min(room, bytes.size()));
    const size_t had = out_.size();
    out_.resize(had + part.size());
    std::memcpy(out_.data() + had, part.data(), part.size());
    bytes = bytes.subspan(part.size());
    if (out_.size() == limits::reader_frame_bytes_max) TRY(flush());
  }
  return {};
}

Result<void> ReaderChannel::flush() {
  if (out_.empty()) return {};
  TRY(send(out_));
  out_.clear();
  return {};
}

Result<void> ReaderChannel::get_bytes(std::span<std::byte> bytes) {
  while (!bytes.empty()) {
    if (in_used_ == in_.size()) {
      in_ = TRY(receive());
      in_used_ = 0;
    }
    const size_t count = std::min(bytes.size(), in_.size() - in_used_);
    if (count > 0) std::memcpy(bytes.data(), in_.data() + in_used_, count);
    in_used_ += count;
    bytes = bytes.subspan(count);
  }
  return {};
}

Result<void> ReaderChannel::put_text(std::string_view text) {
  const std::string_view part = text.substr(0, limits::reader_words_bytes_max);
  TRY(put(static_cast<uint64_t>(part.size())));
  return put_all(std::span<const char>(part));
}

Result<std::string> ReaderChannel::get_text() {
  const auto letters = TRY(get_list<char>(limits::reader_words_bytes_max));
  return showable({letters.data(), letters.size()}, limits::reader_words_bytes_max);
}

}  // namespace scree
