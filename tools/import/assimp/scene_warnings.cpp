#include "tools/import/assimp/scene_warnings.h"

#include <algorithm>
#include <array>
#include <assimp/DefaultLogger.hpp>
#include <assimp/LogStream.hpp>
#include <cctype>
#include <string_view>

#include "shared/base/small_letters.h"
#include "tools/import/assimp/scene_reader.h"

namespace scree {

namespace {

constexpr unsigned listened = Assimp::Logger::Warn | Assimp::Logger::Err;

/// Others are on materials, textures and movements.
bool is_on_shape(const std::string& said) {
  const std::string line = in_small_letters(said);
  constexpr std::array<std::string_view, 6> words = {"face",     "polygon", "triangle",
                                                     "vertices", "indices", "vertex index"};
  return std::ranges::any_of(words,
                             [&](std::string_view word) { return line.find(word) != std::string::npos; });
}

}  // namespace

class SceneWarnings::Stream final : public Assimp::LogStream {
 public:
  explicit Stream(std::vector<std::string>& lines) : lines_(lines) {}

  /// "Warn,  T123: words", with the end of its line.
  void write(const char* message) override {
    std::string line(message);
    if (const size_t head = line.find(": "); head != std::string::npos) line.erase(0, head + 2);
    line.erase(line.find_last_not_of(" \r\n") + 1);
    if (lines_.size() < scene_warnings_max && is_on_shape(line) &&
        std::ranges::find(lines_, line) == lines_.end())
      lines_.push_back(std::move(line));
  }

 private:
  std::vector<std::string>& lines_;
};

SceneWarnings::SceneWarnings() : stream_(std::make_unique<Stream>(lines_)) {
  Assimp::DefaultLogger::create("", Assimp::Logger::NORMAL, 0);
  Assimp::DefaultLogger::get()->attachStream(stream_.get(), listened);
}

SceneWarnings::~SceneWarnings() {
  Assimp::DefaultLogger::get()->detachStream(stream_.get(), listened);
  Assimp::DefaultLogger::kill();
}

}  // namespace scree
