#include "server/app/environment.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <string_view>

#include "shared/base/near_name.h"

namespace scree {

namespace {

constexpr std::string_view variable_prefix = "SCREE_", ci_prefix = "SCREE_CI_";

/// A test compares them with the sources of these programs.
constexpr std::array<std::string_view, 65> others{
    // viewer, bot, admin, export, token
    "SCREE_ADMIN_TOKEN", "SCREE_ADMIN_TOKEN_FILE", "SCREE_AREA", "SCREE_CACHE", "SCREE_CACHE_MIB",
    "SCREE_CAMERA", "SCREE_CARVES", "SCREE_CHECK_HASH", "SCREE_DETAILS", "SCREE_DIGS", "SCREE_FPS",
    "SCREE_FRAMES", "SCREE_GL_DEBUG", "SCREE_GRID_RESOLUTION", "SCREE_GRID_SCALE", "SCREE_GRID_SPACING",
    "SCREE_HEAR", "SCREE_HOST", "SCREE_INSECURE_TOKEN", "SCREE_INTEREST", "SCREE_LINGER", "SCREE_LINK",
    "SCREE_METHOD", "SCREE_NAME", "SCREE_OFFSCREEN", "SCREE_OVERLAY", "SCREE_PAINT", "SCREE_PARTICLES",
    "SCREE_PAST", "SCREE_PATH", "SCREE_PATTERN", "SCREE_PLACES", "SCREE_PREDICT", "SCREE_QUALITY",
    "SCREE_RADIUS", "SCREE_RATE", "SCREE_RECONNECTS", "SCREE_REFERENCE", "SCREE_RENDER_SCALE",
    "SCREE_SCREENSHOT", "SCREE_SEEDS", "SCREE_SHAKE", "SCREE_SHAPE", "SCREE_SIZE", "SCREE_SOUND",
    "SCREE_SOUND_FILE", "SCREE_THRESHOLD", "SCREE_TIMEDEMO", "SCREE_TIMEOUT", "SCREE_TLS", "SCREE_TLS_CA",
    "SCREE_TLS_FINGERPRINT", "SCREE_TOKEN", "SCREE_TOKEN_FILE", "SCREE_TOKEN_SIGNING_KEY",
    "SCREE_VIEW_RADIUS", "SCREE_WALK",
    // scripts, and tests
    "SCREE_DIST", "SCREE_FUZZ_ROUNDS", "SCREE_FUZZ_SEED", "SCREE_IMAGE_MIRROR", "SCREE_KILLS",
    "SCREE_MUTATIONS", "SCREE_PICTURES", "SCREE_PROGRAMS"};

constexpr size_t mistyped_max = 4;

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
    return fmt::format("the environment has {}, and there is no such option{}", name,
                       did_you_mean(name, own, mistyped_max));
  }
  return {};
}

}  // namespace scree
