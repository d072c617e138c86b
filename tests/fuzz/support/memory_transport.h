// A stream without a socket: a test plays its other end. Nothing happens before pump(), so that no call comes
// back into its caller. Not thread-safe.
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "shared/base/check.h"
#include "transport/transport.h"

namespace scree {

class MemoryTransport final : public Transport {
 public:
  explicit MemoryTransport(std::string address) : address_(std::move(address)) {}

  void read_some(std::span<uint8_t> into, Done done) override {
    CHECK(!reading_);
    into_ = into;
    reading_ = std::move(done);
  }
  void write_some(Buffers buffers, Done done) override {
    CHECK(!writing_ && !finished_);
    outgoing_.clear();
    for (const auto& buffer : buffers) outgoing_.insert(outgoing_.end(), buffer.begin(), buffer.end());
    CHECK(!outgoing_.empty());
    writing_ = std::move(done);
  }
  void finish_sending() override { finished_ = true; }
  void close() override {
    closed_ = true;
    reading_ = nullptr;
    writing_ = nullptr;
  }
  void abort() override { close(); }
  bool established() const override { return true; }
  bool encrypted() const override { return false; }
  const std::string& address() const override { return address_; }
  uint16_t port() const override { return 1; }

  // ---- the other end
  void send(std::span<const uint8_t> bytes) { incoming_.insert(incoming_.end(), bytes.begin(), bytes.end()); }
  /// No more comes; `orderly`: as of a client that leaves, else of a link that is lost.
  void end(bool orderly) { end_ = StreamEnd{orderly, orderly ? "" : "lost"}; }
  void read_on(bool reads) { reads_ = reads; }
  bool closed() const { return closed_; }
  /// What arrived since the last call.
  std::vector<uint8_t> drain_arrived() { return std::exchange(arrived_, {}); }

  /// Hands over what waits, both ways, at most `bytes` at once; true while something was.
  bool pump(size_t bytes = SIZE_MAX) {
    bool moved = false;
    if (writing_ && reads_) {
      const size_t count = std::min(bytes, outgoing_.size());
      arrived_.insert(arrived_.end(), outgoing_.begin(), outgoing_.begin() + static_cast<ptrdiff_t>(count));
      std::exchange(writing_, nullptr)(count);
      moved = true;
    }
    if (reading_ && !incoming_.empty()) {
      const size_t count = std::min({bytes, into_.size(), incoming_.size()});
      std::copy_n(incoming_.begin(), count, into_.begin());
      incoming_.erase(incoming_.begin(), incoming_.begin() + static_cast<ptrdiff_t>(count));
      std::exchange(reading_, nullptr)(count);
      moved = true;
    } else if (reading_ && end_) {
      std::exchange(reading_, nullptr)(tl::unexpected(*end_));
      moved = true;
    }
    return moved;
  }

 private:
  std::string address_;
  std::span<uint8_t> into_;
  Done reading_;
  Done writing_;
  std::vector<uint8_t> outgoing_;  ///< of the write under way
  std::vector<uint8_t> incoming_;
  std::vector<uint8_t> arrived_;
  std::optional<StreamEnd> end_;
  bool reads_ = true;
  bool finished_ = false;
  bool closed_ = false;
};

}  // namespace scree
