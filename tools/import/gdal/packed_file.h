// A file of an archive that GDAL cannot read there: its reader sends it out, to be read by itself.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "tools/import/process/reader_channel.h"

namespace scree {

struct PackedFile {
  std::string address;  ///< by which GDAL opens it in the archive
  std::string ending;   ///< by which its form is known
  std::string layer;    ///< that is left to choose
  std::vector<std::string> said;
};

/// For netCDF, whose library maps a file of an archive in a way that its reader's walls refuse, and for HDF4,
/// which knows no archives. Nothing: GDAL reads the file as it is. `layer` as for open_raster_file().
Result<std::optional<PackedFile>> find_packed(const std::string& path, const std::string& layer);

/// At most limits::unpacked_bytes_max.
Result<void> send_packed(const PackedFile& file, ReaderChannel& channel);

/// On the import's side: the file that send_packed() sends, in the folder of temporary files. It goes with
/// the object.
class UnpackedFile {
 public:
  static Result<std::unique_ptr<UnpackedFile>> receive(ReaderChannel& channel);
  ~UnpackedFile();
  UnpackedFile(const UnpackedFile&) = delete;
  UnpackedFile& operator=(const UnpackedFile&) = delete;

  /// Who has it open goes on to read it. A program that is killed leaves nothing from then on.
  void remove_name();

  const std::string& path() const { return path_; }
  const std::string& layer() const { return layer_; }
  const std::vector<std::string>& said() const { return said_; }

 private:
  UnpackedFile() = default;
  Result<void> fill(ReaderChannel& channel);

  std::string path_;
  int descriptor_ = -1;
  bool has_name_ = false;
  std::string layer_;
  std::vector<std::string> said_;
};

}  // namespace scree
