// PNG files of black pixels, made byte by byte for tests.
#pragma once

#include <algorithm>
#include <cstdint>
#include <string>
#include <string_view>

namespace scree {

inline std::string big_endian_bytes(uint32_t value) {
  std::string bytes;
  for (const unsigned shift : {24U, 16U, 8U, 0U}) bytes.push_back(static_cast<char>(value >> shift));
  return bytes;
}

/// CRC-32 of ISO 3309, bit by bit.
inline uint32_t png_crc(std::string_view bytes) {
  uint32_t crc = 0xFFFFFFFFU;
  for (const char byte : bytes) {
    crc ^= static_cast<uint8_t>(byte);
    for (int bit = 0; bit < 8; ++bit) crc = (crc >> 1U) ^ ((crc & 1U) != 0 ? 0xEDB88320U : 0U);
  }
  return ~crc;
}

inline std::string png_chunk(const std::string& name, const std::string& content) {
  return big_endian_bytes(static_cast<uint32_t>(content.size())) + name + content +
         big_endian_bytes(png_crc(name + content));
}

/// The signature and a header for pixels of one bit of grey.
inline std::string png_header(uint32_t width, uint32_t height) {
  return std::string("\x89PNG\r\n\x1a\n") +
         png_chunk("IHDR", big_endian_bytes(width) + big_endian_bytes(height) + std::string("\1\0\0\0\0", 5));
}

/// Zeros as a stream of zlib, in blocks that are not compressed.
inline std::string stored_zeros(size_t count) {
  std::string stream("\x78\x01");
  const auto sum = static_cast<uint32_t>(count % 65521U) << 16U | 1U;  // Adler-32
  do {
    const size_t part = std::min<size_t>(count, 65535);
    count -= part;
    stream.push_back(count == 0 ? '\1' : '\0');
    for (const size_t length : {part, ~part})
      for (const unsigned shift : {0U, 8U}) stream.push_back(static_cast<char>(length >> shift));
    stream.append(part, '\0');
  } while (count > 0);
  return stream + big_endian_bytes(sum);
}

/// A whole PNG of this size, then zeros up to so many bytes. `missing`: bytes of its pixels that it lacks.
inline std::string png_bytes(uint32_t width, uint32_t height, size_t bytes = 0, size_t missing = 0) {
  const size_t row_bytes = 1 + (size_t{width} + 7) / 8;
  std::string png = png_header(width, height) +
                    png_chunk("IDAT", stored_zeros(row_bytes * height - missing)) + png_chunk("IEND", "");
  png.resize(std::max(png.size(), bytes), '\0');
  return png;
}

}  // namespace scree
