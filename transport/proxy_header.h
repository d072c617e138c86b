// The header by which a proxy says for whom it speaks, before a connection's own bytes: versions 1 (text) and
// 2 (binary) of the PROXY protocol (haproxy's doc/proxy-protocol.txt). What arrives is checked, never
// trusted; the caller decides from whom it takes one.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "shared/base/result.h"

namespace scree {

struct ProxyHeader {
  size_t bytes = 0;  ///< its length; 0: the bytes begin otherwise
  /// The client's numeric address; empty: the proxy speaks for itself (a check of its own), or does not know.
  std::string address{};
  uint16_t port = 0;
};

/// Bytes of the longest header that is read: of version 2 with its extensions. Above: an error.
inline constexpr size_t proxy_header_bytes_max = 4096;

/// `first`: the first bytes of a connection. Nothing: more are needed to tell. An error: they begin a header
/// that breaks the rules.
Result<std::optional<ProxyHeader>> read_proxy_header(std::span<const uint8_t> first);

}  // namespace scree
