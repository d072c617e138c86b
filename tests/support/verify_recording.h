// A recording that a test has just written: simulated again, it has the same hash at every tick.
#pragma once

#include <filesystem>
#include <gtest/gtest.h>

#include "server/replay/verify.h"
#include "server/store/recording_reader.h"

namespace scree {

/// Removes the file in the end.
inline void expect_verifies(const std::filesystem::path& path) {
  auto reader = RecordingReader::open(path.string());
  ASSERT_TRUE(reader.has_value()) << reader.error().message;
  const auto report = verify(**reader, {});
  ASSERT_TRUE(report.has_value()) << report.error().message;
  EXPECT_TRUE(report->agrees()) << report->difference;
  std::filesystem::remove(path);
}

}  // namespace scree
