#include "tools/film/picture_folder.h"

#include <filesystem>
#include <utility>

#include "client/viewer/pictures/png.h"

namespace scree {
namespace {

/// Named as by write_frame().
bool is_frame(const std::string& name) {
  return name.ends_with(".png") && name.find_first_not_of("0123456789") == name.size() - 4 && name.size() > 4;
}

class PictureFolder final : public FrameSink {
 public:
  PictureFolder(std::string folder, std::string sound)
      : folder_(std::move(folder)), sound_(std::move(sound)) {}
  Result<void> add(const Image& frame) override { return write_frame(folder_, frames_++, frame); }
  Result<void> finish() override {
    std::error_code error;
    const std::string file = folder_ + "sound.wav";
    if (!sound_.empty()) std::filesystem::rename(sound_, file, error);
    if (error) return fail(file + " cannot be written: " + error.message());
    return {};
  }

 private:
  std::string folder_;
  std::string sound_;
  size_t frames_ = 0;
};

}  // namespace

Result<std::unique_ptr<FrameSink>> open_picture_folder(const std::string& folder, const std::string& sound) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) return fail(folder + " cannot be made: " + error.message());
  for (const auto& entry : std::filesystem::directory_iterator(folder, error))
    if (is_frame(entry.path().filename().string()))
      return fail(folder + " has pictures of a film already, " + entry.path().filename().string() +
                  " for one: choose another folder, or move them away (--out)");
  return std::make_unique<PictureFolder>(folder, sound);
}

}  // namespace scree
