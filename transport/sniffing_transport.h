// A server's end of a stream whose client chooses between the protocol's bytes and HTTP, both plainly or
// within TLS: its first bytes tell, and within TLS the first of those. An end that is written to before its
// first bytes came is written to plainly, and stays so. A stream of HTTP is given away.
#pragma once

#include <array>
#include <functional>
#include <memory>
#include <optional>

#include "crypto/tls_engine.h"
#include "transport/transport.h"

namespace scree {

/// Whether bytes that arrived first begin an HTTP request: capital letters of a method, which would begin a
/// message of 4 MB. Needs http_greeting_bytes of them.
inline constexpr size_t http_greeting_bytes = 3;
bool is_http_greeting(std::span<const uint8_t> first);

class SniffingTransport final : public Transport, public std::enable_shared_from_this<SniffingTransport> {
 public:
  /// Takes a stream of HTTP, and what was read of it. The read under way is never answered, and the
  /// SniffingTransport is empty: nothing done to it reaches the stream any more.
  using HttpHandoff = std::function<void(std::shared_ptr<Transport> stream, std::span<const uint8_t> first)>;

  /// `tls` may be null: TLS is not spoken; so may `http`.
  SniffingTransport(std::shared_ptr<Transport> below, std::shared_ptr<const TlsServerContext> tls,
                    HttpHandoff http);

  void read_some(std::span<uint8_t> into, Done done) override;
  void write_some(Buffers buffers, Done done) override;
  size_t write_now(Buffers buffers) override { return decided_ ? chosen_->write_now(buffers) : 0; }
  void send_rest() override { chosen_->send_rest(); }
  size_t unsent_bytes() override { return chosen_->unsent_bytes(); }
  void finish_sending() override { chosen_->finish_sending(); }
  void close() override {
    if (!given_) chosen_->close();
  }
  void abort() override {
    if (!given_) chosen_->abort();
  }
  bool established() const override { return chosen_->established(); }
  bool encrypted() const override { return chosen_->encrypted(); }
  const std::string& address() const override { return chosen_->address(); }
  uint16_t port() const override { return chosen_->port(); }

 private:
  void sniff(std::span<uint8_t> into, Done done);
  void choose(std::span<uint8_t> into, Done done);

  std::shared_ptr<Transport> chosen_;  ///< the one below, until TLS is put over it
  std::shared_ptr<const TlsServerContext> tls_;
  HttpHandoff http_;
  std::array<uint8_t, tls_greeting_bytes> first_{};
  size_t first_bytes_ = 0;
  std::optional<StreamEnd> end_;  ///< it came before there were enough; told behind those that came
  bool decided_ = false;
  bool given_ = false;  ///< away
};

}  // namespace scree
