// Bounds of byte streams. Each says its unit, its reason, and its effect at the limit.
#pragma once

#include <cstddef>

namespace scree::limits {

/// Bytes that TLS encrypts, and reads, at once: one record (RFC 8446, 5.1). Above: the rest is taken next
/// time.
inline constexpr size_t tls_chunk_bytes = size_t{16} << 10;

/// Encrypted bytes that wait to be sent. Above: no more is read, because what arrives may ask for answers
/// (key updates), until these are gone.
inline constexpr size_t tls_unsent_bytes_max = size_t{64} << 10;

}  // namespace scree::limits
