// The files of the page: all of a folder, read at once and kept in memory. So what a request names is looked
// up among names, and no path leads anywhere. Immutable; any thread may read.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <string_view>

#include "server/web/web_config.h"
#include "shared/base/result.h"

namespace scree {

struct WebFile {
  std::shared_ptr<const std::string> bytes;
  std::shared_ptr<const std::string> gzip;  ///< the same, compressed; null: there is none
  std::string type;                         ///< as of Content-Type
  std::string etag;
  bool immutable = false;  ///< its name holds a hash of it, so it never changes
};

class WebFiles {
 public:
  WebFiles() = default;
  /// Reads the folder, with the folders in it (limits::web_folders_max). Left out are names of other letters
  /// than A-Z a-z 0-9 . _ -, those that begin with a dot, whatever is no file, links to folders, and links
  /// that lead out of the folder. NAME.gz beside NAME is NAME compressed. The error names the folder.
  static Result<std::shared_ptr<const WebFiles>> load(const std::string& folder);

  /// `path`: as "/" and "/assets/a.js"; "/" is index.html, "/status" and
  /// "/admin" are status.html and admin.html. Null: there is none.
  const WebFile* find(std::string_view path) const;
  bool has_page() const { return find("/") != nullptr; }
  size_t count() const { return files_.size(); }

 private:
  std::map<std::string, WebFile, std::less<>> files_;  ///< by path, without the first slash
};

/// Those of WebConfig::folder, which must have a page; none if the folder is not said.
Result<std::shared_ptr<const WebFiles>> web_files(const WebConfig& config);

/// Whether a name has at least eight hexadecimal digits between two dots, not all of them decimal.
bool holds_hash(std::string_view name);

}  // namespace scree
