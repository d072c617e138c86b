// The samples of a file of sound, for tests.
#pragma once

#include <algorithm>
#include <cstdint>
#include <fstream>
#include <gtest/gtest.h>
#include <sstream>
#include <string>
#include <vector>

namespace scree {

/// The samples that the header of a WAV of 16 bits tells of, which must be there.
inline std::vector<float> samples_in(const std::string& path) {
  std::ostringstream text;
  text << std::ifstream(path, std::ios::binary).rdbuf();
  const std::string bytes = text.str();
  const auto number_at = [&](size_t at, size_t count) {
    size_t number = 0;
    for (size_t i = 0; i < count; ++i) number |= size_t{static_cast<uint8_t>(bytes[at + i])} << (8 * i);
    return number;
  };
  EXPECT_GE(bytes.size(), 44U);
  EXPECT_EQ(bytes.substr(0, 4) + bytes.substr(8, 4), "RIFFWAVE");
  EXPECT_LE(number_at(4, 4), bytes.size() - 8);
  const size_t end = 44 + number_at(40, 4);
  EXPECT_LE(end, bytes.size());
  std::vector<float> samples;
  for (size_t i = 44; i + 1 < std::min(end, bytes.size()); i += 2)
    samples.push_back(static_cast<float>(static_cast<int16_t>(number_at(i, 2))) / 32767.0F);
  return samples;
}

}  // namespace scree
