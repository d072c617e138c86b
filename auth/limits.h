// Bounds of tokens' files. Each says its unit, its reason, and its effect at the limit.
#pragma once

#include <cstddef>

namespace scree::limits {

/// Ids in a list of revoked tokens: a megabyte of text. Tokens that expire need not stay in it. Above:
/// refused.
inline constexpr size_t revoked_tokens_max = size_t{1} << 16;
/// The file of these ids, with comments, bytes.
inline constexpr size_t revoked_bytes_max = size_t{8} << 20;

}  // namespace scree::limits
