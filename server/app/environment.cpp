#include "server/app/environment.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <limits>
#include <numeric>
#include <string_view>
#include <utility>

namespace scree {

namespace {

constexpr std::string_view variable_prefix = "SCREE_", ci_prefix = "SCREE_CI_";

/// A test compares them with the sources of these programs.
constexpr std::array<std::string_view, 58> others{
    // viewer, bot, admin, export, token
    "SCREE_ADMIN_TOKEN", "SCREE_ADMIN_TOKEN_FILE", "SCREE_AREA", "SCREE_CACHE", "SCREE_CACHE_MIB",
    "SCREE_CAMERA", "SCREE_CARVES", "SCREE_CHECK_HASH", "SCREE_FPS", "SCREE_FRAMES", "SCREE_GL_DEBUG",
    "SCREE_GRID_RESOLUTION", "SCREE_GRID_SCALE", "SCREE_GRID_SPACING", "SCREE_HOST", "SCREE_INSECURE_TOKEN",
    "SCREE_INTEREST", "SCREE_LINGER", "SCREE_LINK", "SCREE_METHOD", "SCREE_NAME", "SCREE_OFFSCREEN",
    "SCREE_OVERLAY", "SCREE_PAINT", "SCREE_PARTICLES", "SCREE_PATH", "SCREE_PATTERN", "SCREE_PREDICT",
    "SCREE_QUALITY", "SCREE_RADIUS", "SCREE_RATE", "SCREE_RECONNECTS", "SCREE_REFERENCE",
    "SCREE_RENDER_SCALE", "SCREE_SCREENSHOT", "SCREE_SEEDS", "SCREE_SHAPE", "SCREE_SIZE", "SCREE_SOUND",
    "SCREE_SOUND_FILE", "SCREE_THRESHOLD", "SCREE_TIMEDEMO", "SCREE_TIMEOUT", "SCREE_TLS", "SCREE_TLS_CA",
    "SCREE_TLS_FINGERPRINT", "SCREE_TOKEN", "SCREE_TOKEN_FILE", "SCREE_TOKEN_SIGNING_KEY",
    "SCREE_VIEW_RADIUS",
    // scripts, and tests
    "SCREE_DIST", "SCREE_FUZZ_ROUNDS", "SCREE_FUZZ_SEED", "SCREE_IMAGE_MIRROR", "SCREE_KILLS",
    "SCREE_MUTATIONS", "SCREE_PICTURES", "SCREE_PROGRAMS"};

/// Levenshtein's distance: how many letters are to be put in, left out or changed.
size_t distance(std::string_view a, std::string_view b) {
  std::vector<size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), size_t{0});
  for (size_t i = 0; i < a.size(); ++i) {
    size_t diagonal = std::exchange(row[0], i + 1);
    for (size_t j = 0; j < b.size(); ++j) {
      const size_t changed = diagonal + (a[i] == b[j] ? 0 : 1);
      diagonal = row[j + 1];
      row[j + 1] = std::min({row[j] + 1, row[j + 1] + 1, changed});
    }
  }
  return row[b.size()];
}

std::string nearest(std::string_view name, std::span<const std::string> own) {
  const auto near =
      std::ranges::min_element(own, {}, [&](const std::string& known) { return distance(name, known); });
  constexpr size_t mistyped_max = 4;
  return near != own.end() && distance(name, *near) <= mistyped_max ? "; did you mean " + *near + "?"
                                                                    : std::string();
}

}  // namespace

std::span<const std::string_view> variables_of_others() {
  return others;
}

std::string fault_in_environment(std::span<const std::string> own, const char* const* environment) {
  for (; environment != nullptr && *environment != nullptr; ++environment) {
    const std::string_view entry(*environment);
    const std::string_view name = entry.substr(0, entry.find('='));
    if (!name.starts_with(variable_prefix) || name.starts_with(ci_prefix) ||
        std::ranges::find(own, name) != own.end() || std::ranges::find(others, name) != others.end())
      continue;
    return fmt::format("the environment has {}, and there is no such option{}", name, nearest(name, own));
  }
  return {};
}

}  // namespace scree
