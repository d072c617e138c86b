// Walls around the process that reads a foreign file: a library that a file deceives reads no other file,
// writes none, reaches no network, and starts no program. Landlock walls off the file system, a filter of
// system calls the rest.
#pragma once

#include <string>
#include <vector>

#include "shared/base/result.h"

namespace scree {

/// What a reader may read besides the system's libraries and tables (/usr/lib, /usr/share, and the folders of
/// GDAL_DATA, PROJ_DATA and PROJ_LIB).
struct Readable {
  std::vector<std::string> files{};    ///< each by itself
  std::vector<std::string> folders{};  ///< with all that is below
};

/// The file, and the regular files beside it with its name but for the ending, at most
/// limits::reader_files_max: heights come with a header, a map, a mask.
Readable file_and_its_namesakes(const std::string& path);

/// The folder of the file, and the file itself, which may be a link.
Readable file_and_its_folder(const std::string& path);

/// From now on, in this process. It has one thread. Where the kernel has no Landlock, or no filters, that
/// wall is not there.
Result<void> enter_sandbox(const Readable& readable);

/// A sentence on the walls that this kernel lacks; empty: it has both.
std::string missing_walls();

}  // namespace scree
