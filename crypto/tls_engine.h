// One end of a TLS connection as bytes in and bytes out, without sockets: whoever carries the bytes feeds
// what arrived, and sends what output holds. Not thread-safe.
//
// The handshake goes on in shake(), which read() and write() need to be over. Every error is final; output
// may then hold an alert for the other end. What the other end sends is never trusted: OpenSSL bounds a
// message of the handshake, and an owner that stops feeding while it cannot send bounds the answers.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "crypto/tls_context.h"

namespace scree {

/// Whether bytes that arrived first begin a TLS handshake (RFC 8446, 5.1): needs tls_greeting_bytes of them.
inline constexpr size_t tls_greeting_bytes = 3;
bool is_tls_greeting(std::span<const uint8_t> first);

class TlsEngine {
 public:
  explicit TlsEngine(std::shared_ptr<const TlsServerContext> server);
  /// `host` is the name or address that the certificate must be for.
  TlsEngine(std::shared_ptr<const TlsClientContext> client, const std::string& host);
  ~TlsEngine();
  TlsEngine(TlsEngine&&) noexcept;

  void feed(std::span<const uint8_t> arrived);

  /// Continues the handshake as far as the bytes go. The error is in words for people.
  Result<void> shake();
  bool established() const;

  struct Got {
    size_t bytes = 0;    ///< 0: more must arrive first, or it ended
    bool ended = false;  ///< the other end will send no more
  };
  Result<Got> read(std::span<uint8_t> into);
  Result<void> write(std::span<const uint8_t> plain);
  /// Tells the other end that no more comes.
  void finish();

  size_t output_bytes() const;
  /// Moves all output into `into`, which is replaced.
  void take_output(std::vector<uint8_t>& into);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace scree
