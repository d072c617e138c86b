// What both ends of TLS connections have in common for many connections: a server's certificate and key, and
// whom a client trusts. TLS 1.3, or 1.2 with AEAD ciphers and ephemeral keys; no compression, renegotiation,
// tickets or early data. Immutable; any thread may use them.
#pragma once

#include <memory>
#include <string>

#include "shared/base/result.h"

namespace scree {

class TlsServerContext {
 public:
  /// Reads PEM files: the certificate with its chain behind it, and its private key without a passphrase. The
  /// error names the file.
  static Result<std::shared_ptr<const TlsServerContext>> load(const std::string& certificate_path,
                                                              const std::string& key_path);
  ~TlsServerContext();
  TlsServerContext(const TlsServerContext&) = delete;
  TlsServerContext& operator=(const TlsServerContext&) = delete;

  /// SHA-256 of the certificate: 32 hex numbers with colons between them.
  std::string fingerprint() const;
  /// Whether the certificate's time is over, or has not begun.
  bool out_of_date() const;

  struct Impl;
  const Impl& impl() const { return *impl_; }

 private:
  explicit TlsServerContext(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

/// Whom a client trusts. Both empty: the certificate authorities of the system.
struct TlsTrust {
  std::string ca_path;  ///< PEM file of certificates that are trusted, instead of the system's
  /// SHA-256 of the one certificate that is trusted, whatever its name, its dates and its issuer: 64 hex
  /// digits, with or without colons.
  std::string fingerprint;
};

class TlsClientContext {
 public:
  static Result<std::shared_ptr<const TlsClientContext>> make(const TlsTrust& trust);
  ~TlsClientContext();
  TlsClientContext(const TlsClientContext&) = delete;
  TlsClientContext& operator=(const TlsClientContext&) = delete;

  struct Impl;
  const Impl& impl() const { return *impl_; }

 private:
  explicit TlsClientContext(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace scree
