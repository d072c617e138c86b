// One file for two purposes is a mistake of a command line: what one writes the other overwrites.
#pragma once

#include <span>
#include <string>

#include "shared/base/result.h"

namespace scree {

struct NamedFile {
  std::string option;  ///< with its dashes
  std::string path;    ///< empty: not given
  bool written = false;
  bool database = false;  ///< of SQLite: files with its name and a suffix are its own
};

/// Refuses two names of one file, by whatever path or link, when it is written for one of them, and names of
/// files that a database keeps beside it. Devices and pipes take anything. Nothing is created.
Result<void> check_distinct(std::span<const NamedFile> files);

}  // namespace scree
