// Signatures by Ed25519 (RFC 8032), keys in PEM files, and random bytes. Keys are immutable; any thread may
// use them.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <string>

#include "shared/base/result.h"

namespace scree {

inline constexpr size_t signature_bytes = 64;
using Signature = std::array<uint8_t, signature_bytes>;

struct KeyHandle;  // OpenSSL's

/// Says whether a signature is by the private key that belongs to it.
class VerifyingKey {
 public:
  static Result<VerifyingKey> read(const std::string& path);
  bool holds(std::span<const uint8_t> message, std::span<const uint8_t, signature_bytes> signature) const;

 private:
  friend class SigningKey;
  explicit VerifyingKey(std::shared_ptr<const KeyHandle> key) : key_(std::move(key)) {}
  std::shared_ptr<const KeyHandle> key_;
};

class SigningKey {
 public:
  static SigningKey generate();
  static Result<SigningKey> read(const std::string& path);
  /// Writes this key, which its owner alone may read, and the public one. Neither file may exist.
  Result<void> write(const std::string& path, const std::string& public_path) const;
  VerifyingKey public_key() const;
  Signature sign(std::span<const uint8_t> message) const;

 private:
  explicit SigningKey(std::shared_ptr<const KeyHandle> key) : key_(std::move(key)) {}
  std::shared_ptr<const KeyHandle> key_;
};

/// Fit for secrets.
uint64_t random_number();

}  // namespace scree
