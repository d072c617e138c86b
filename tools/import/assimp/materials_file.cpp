#include "tools/import/assimp/materials_file.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <sstream>
#include <string_view>

namespace scree {

namespace {

/// Colours and numbers that assimp reads. Its colours have three numbers.
constexpr std::array<std::string_view, 5> colours{"Ka", "Kd", "Ks", "Ke", "Tf"};
constexpr std::array<std::string_view, 8> numbers{"d", "Tr", "Ns", "Ni", "Pr", "Pm", "Ps", "Pc"};

bool begins_number(const std::string& word) {
  const size_t at = word.find_first_not_of("+-.");
  return at != std::string::npos && word[at] >= '0' && word[at] <= '9';
}

bool lacks_numbers(const std::string& line) {
  std::istringstream words(line);
  std::string key;
  words >> key;
  const size_t wanted = std::ranges::count(colours, key) > 0   ? 3
                        : std::ranges::count(numbers, key) > 0 ? 1
                                                               : 0;
  size_t found = 0;
  for (std::string word; found < wanted && words >> word && begins_number(word);) ++found;
  return found < wanted;
}

}  // namespace

std::optional<std::string> fault_of_materials(const std::string& path) {
  std::ifstream in(path);
  int number = 0;
  for (std::string line; std::getline(in, line);) {
    ++number;
    if (!lacks_numbers(line)) continue;
    std::istringstream words(line);
    std::string key;
    words >> key;
    return fmt::format("{}:{}: '{}' stands without its numbers",
                       std::filesystem::path(path).filename().string(), number, key);
  }
  return std::nullopt;
}

}  // namespace scree
