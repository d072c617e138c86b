// One end of a TLS connection as bytes in and bytes out (StreamEngine). OpenSSL bounds a message of the
// handshake; after an error output may hold an alert for the other end.
#pragma once

#include <memory>
#include <string>

#include "crypto/tls_context.h"
#include "shared/base/stream_engine.h"

namespace scree {

/// Whether bytes that arrived first begin a TLS handshake (RFC 8446, 5.1): needs tls_greeting_bytes of them.
inline constexpr size_t tls_greeting_bytes = 3;
bool is_tls_greeting(std::span<const uint8_t> first);

/// Bytes that one record holds (RFC 8446, 5.1).
inline constexpr size_t tls_record_bytes = size_t{16} << 10;

namespace limits {
/// Key updates (RFC 8446, 4.6.3) that the other end may send, beside one for so many bytes that were read.
/// Each costs keys for both directions, and is in no session's count of bytes; keys last for more than a
/// thousand times as many. Above: the connection fails.
inline constexpr uint64_t tls_key_updates_max = 32;
inline constexpr uint64_t tls_bytes_per_key_update = 64 * 1024;
}  // namespace limits

class TlsEngine final : public StreamEngine {
 public:
  explicit TlsEngine(std::shared_ptr<const TlsServerContext> server);
  /// `host` is the name or address that the certificate must be for.
  TlsEngine(std::shared_ptr<const TlsClientContext> client, const std::string& host);
  ~TlsEngine() override;
  TlsEngine(TlsEngine&&) noexcept;

  void feed(std::span<const uint8_t> arrived) override;
  Result<void> shake() override;
  bool established() const override;
  Result<Got> read(std::span<uint8_t> into) override;
  Result<void> write(std::span<const uint8_t> plain) override;
  size_t chunk_bytes() const override { return tls_record_bytes; }
  void finish() override;
  size_t output_bytes() const override;
  void drain_output(std::vector<uint8_t>& into) override;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace scree
