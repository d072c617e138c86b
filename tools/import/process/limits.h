// Bounds of the processes that read foreign files. Each says its unit, its reason, and its effect at the
// limit.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>

namespace scree::limits {

/// Bytes of one frame between an import and its reader: a socket carries no more at once. Above: the reader
/// counts as broken.
inline constexpr uint32_t reader_frame_bytes_max = 1U << 18;

/// Bytes of words that a reader may send, an error's included. Above: cut in the reader, refused here.
inline constexpr size_t reader_words_bytes_max = 4096;

/// Memory that a reader may use beyond the import's own, by default; bytes. Above: the file is refused.
inline constexpr uint64_t reader_memory_bytes_max = uint64_t{2} << 30U;

/// Time that an import waits for its reader in all, by default. Above: refused.
inline constexpr std::chrono::milliseconds reader_time_max{600'000};

/// Files beside an elevation model that its reader may read: those with its name but for the ending. More are
/// left out.
inline constexpr size_t reader_files_max = 64;

}  // namespace scree::limits
