// A ground file of rough hills, written for a test.
#pragma once

#include <gtest/gtest.h>

#include "ground/ground_file.h"
#include "ground/ground_writer.h"
#include "tests/support/memory_heights.h"

namespace scree {

inline std::shared_ptr<const GroundFile> written_ground(const std::string& path, int columns, int rows,
                                                        float cell_m) {
  auto writer = GroundWriter::create(path, {columns, rows, cell_m, 0, 0, {5.0F, 60.0F}}, 0.0F);
  if (!writer) {
    ADD_FAILURE() << writer.error().message;
    return nullptr;
  }
  std::vector<int32_t> row(static_cast<size_t>(columns));
  for (int z = 0; z < rows; ++z) {
    for (int x = 0; x < columns; ++x) row[static_cast<size_t>(x)] = rough_height(x, z);
    (*writer)->add_row(row);
  }
  EXPECT_TRUE((*writer)->finish());
  auto file = GroundFile::open(path);
  EXPECT_TRUE(file) << file.error().message;
  return file ? *file : nullptr;
}

}  // namespace scree
