// Both ends of a TLS connection, the server's behind the choice by the first bytes, over links that carry as
// much at once as the input says, damage bytes and break; or a client that speaks plainly.
//
// Holds: what arrives is what was written, from its beginning on; on a link that is whole all of it arrives.
#include <algorithm>
#include <array>
#include <memory>

#include "shared/base/check.h"
#include "tests/fuzz/support/fuzz_input.h"
#include "tests/fuzz/support/memory_transport.h"
#include "tests/fuzz/support/scratch_file.h"
#include "tests/fuzz/support/target.h"
#include "tests/support/certificates.h"
#include "transport/sniffing_transport.h"
#include "transport/tls_transport.h"

namespace scree {
namespace {

constexpr int steps_max = 400;

struct Contexts {
  std::shared_ptr<const TlsServerContext> server;
  std::shared_ptr<const TlsClientContext> client;
};

const Contexts& contexts() {
  static const Contexts made = [] {
    const ScratchFile certificate("certificate"), key("key");
    TestCertificate("DNS:localhost").write(certificate.path(), key.path());
    const auto server = TlsServerContext::load(certificate.path(), key.path());
    CHECK(server.has_value());
    const auto client = TlsClientContext::make({.ca_path = "", .fingerprint = (*server)->fingerprint()});
    CHECK(client.has_value());
    return Contexts{*server, *client};
  }();
  return made;
}

/// The bytes that an end writes, by their place.
uint8_t written(size_t place) {
  return static_cast<uint8_t>(place * 31 + 7);
}

/// One end's user: reads always, and writes as it is told.
class User {
 public:
  explicit User(std::shared_ptr<Transport> stream) : stream_(std::move(stream)) {}

  void read() {
    if (reading_ || over_) return;
    reading_ = true;
    stream_->read_some(buffer_, [this](const Moved& moved) {
      reading_ = false;
      over_ = !moved;
      if (moved) check_received(*moved);
    });
  }
  void write(size_t bytes) {
    if (writing_ || over_ || bytes == 0) return;
    outgoing_.resize(bytes);
    for (size_t i = 0; i < bytes; ++i) outgoing_[i] = written(sent_ + i);
    writing_ = true;
    const std::span<const uint8_t> all(outgoing_);
    stream_->write_some({&all, 1}, [this](const Moved& moved) {
      writing_ = false;
      over_ = over_ || !moved;
      if (moved) sent_ += *moved;
    });
  }
  void close() { stream_->close(); }
  bool over() const { return over_; }
  bool idle() const { return !writing_; }
  size_t sent() const { return sent_; }
  size_t received() const { return received_; }

 private:
  void check_received(size_t bytes) {
    CHECK(bytes > 0 && bytes <= buffer_.size());
    for (size_t i = 0; i < bytes; ++i) CHECK(buffer_[i] == written(received_ + i));
    received_ += bytes;
  }

  std::shared_ptr<Transport> stream_;
  std::array<uint8_t, 4096> buffer_{};
  std::vector<uint8_t> outgoing_;
  bool reading_ = false, writing_ = false, over_ = false;
  size_t sent_ = 0, received_ = 0;
};

class Ends {
 public:
  explicit Ends(bool plain)
      : server_(std::make_shared<SniffingTransport>(server_link_, contexts().server, nullptr)),
        client_(
            plain ? std::static_pointer_cast<Transport>(client_link_)
                  : std::make_shared<TlsTransport>(client_link_, TlsEngine(contexts().client, "localhost"))),
        plain_(plain) {}
  ~Ends() {
    server_.close();
    client_.close();
  }
  Ends(const Ends&) = delete;
  Ends& operator=(const Ends&) = delete;

  void step(FuzzInput& input) {
    const uint32_t kind = input.below(16);
    if (kind == 0) client_.write(input.number<uint16_t>() % 9000);
    // An end that is written to first is written to plainly.
    if (kind == 1 && client_.received() + server_.received() > 0)
      server_.write(input.number<uint16_t>() % 9000);
    if (kind == 2 && !plain_) damage_ = input.byte();
    if (kind == 3 && input.below(4) == 3) break_link(input);
    carry(kind < 8 ? SIZE_MAX : 1 + input.byte());
  }
  void finish() {
    for (int i = 0; i < steps_max && carry(SIZE_MAX); ++i) continue;
    if (!whole_) return;
    CHECK(server_.idle() && client_.idle() && !server_.over() && !client_.over());
    // What a stream is, is known by its first bytes; until then it waits.
    const bool told = !plain_ || client_.sent() >= tls_greeting_bytes;
    CHECK_EQ(server_.received(), told ? client_.sent() : 0);
    CHECK_EQ(client_.received(), server_.sent());
  }

 private:
  void break_link(FuzzInput& input) {
    whole_ = false;
    (input.flag() ? server_link_ : client_link_)->end(input.flag());
  }
  /// True while something moved.
  bool carry(size_t bytes) {
    const size_t received = server_.received() + client_.received();
    server_.read();
    client_.read();
    bool moved = server_.received() + client_.received() != received;  // it had arrived already
    moved = server_link_->pump(bytes) || moved;
    moved = client_link_->pump(bytes) || moved;
    hand_over(*server_link_, *client_link_, to_client_);
    hand_over(*client_link_, *server_link_, to_server_);
    return moved;
  }
  /// Damage leaves the first bytes alone, by which the server tells what a stream is: without them it takes
  /// the rest for a plain one's.
  void hand_over(MemoryTransport& from, MemoryTransport& to, size_t& carried) {
    std::vector<uint8_t> bytes = from.drain_arrived();
    const size_t place = bytes.empty() ? 0 : damage_ % bytes.size();
    if (!bytes.empty() && damage_ != 0 && carried + place >= tls_greeting_bytes) {
      bytes[place] ^= damage_;
      damage_ = 0;
      whole_ = false;
    }
    carried += bytes.size();
    to.send(bytes);
  }

  std::shared_ptr<MemoryTransport> server_link_ = std::make_shared<MemoryTransport>("client");
  std::shared_ptr<MemoryTransport> client_link_ = std::make_shared<MemoryTransport>("server");
  User server_;
  User client_;
  bool plain_;
  bool whole_ = true;
  uint8_t damage_ = 0;
  size_t to_client_ = 0, to_server_ = 0;  ///< bytes carried
};

}  // namespace
}  // namespace scree

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  scree::FuzzInput input(data, size);
  scree::Ends ends(input.below(8) == 7);
  for (int i = 0; i < scree::steps_max && !input.at_end(); ++i) ends.step(input);
  ends.finish();
  return 0;
}
