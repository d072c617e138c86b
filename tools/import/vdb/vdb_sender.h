// The child's part of reading an OpenVDB file. Internal to import/vdb.
#pragma once

#include <string>

#include "tools/import/process/reader_channel.h"

namespace scree {

/// `grid`: the name of the grid; empty: the one level set, or else the one grid of floats. The error says
/// which grids there are.
Result<void> send_vdb(ReaderChannel& channel, const std::string& path, const std::string& grid);

}  // namespace scree
