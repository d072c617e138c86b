// What is wrong with a folder of rules before it runs: syntax, unknown names and fields, and what its files
// do as they load.
#pragma once

#include <string>
#include <vector>

#include "shared/base/result.h"

namespace scree {

struct FolderFault {
  std::string file;  ///< in the folder: "init.lua"
  int line = 0;      ///< 0: of none
  int column = 0;    ///< likewise
  std::string words;

  bool operator==(const FolderFault&) const = default;
};

/// In the order of files and lines. An error: the folder is none, or luacheck is not there.
Result<std::vector<FolderFault>> check_folder(const std::string& folder);

}  // namespace scree
