// A script of luacheck's own Lua that finds misspelt fields of tables and misspelt methods, which luacheck
// itself does not look for. It reads files by luacheck's parser; what is known comes from the rows of
// functions, events and types (server/rules/api.h).
#pragma once

#include <string>

namespace scree {

/// The script's text. It takes names of files, and prints "file:line:column: words" for each fault. A file
/// with wrong syntax is left out, because luacheck says that.
std::string field_check_script();

}  // namespace scree
