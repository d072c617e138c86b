// Presets of the viewer's options: what each gives, and what overrides it.
#include <cstdlib>
#include <gtest/gtest.h>

#include "client/viewer/viewing/settings.h"
#include "shared/base/preset.h"

namespace scree {
namespace {

std::variant<ViewerOptions, ExitNow> parse_preset(std::vector<const char*> arguments) {
  arguments.insert(arguments.begin(), "scree-viewer");
  return parse_options(static_cast<int>(arguments.size()), arguments.data());
}

ViewerOptions viewer_by(std::vector<const char*> arguments) {
  const auto parsed = parse_preset(std::move(arguments));
  const auto* options = std::get_if<ViewerOptions>(&parsed);
  EXPECT_NE(options, nullptr);
  return options == nullptr ? ViewerOptions() : *options;
}

TEST(ViewerPreset, gives_all_values_of_its_column) {
  for (const Preset preset : viewer_presets) {
    const ViewerOptions options = viewer_by({"--preset", name_of(preset).data()});
    const auto value = [&](std::string_view name) {
      const auto* row = std::ranges::find(viewer_preset_options, name, &PresetOption::name);
      return row == viewer_preset_options.end() ? std::string_view() : row->of(preset);
    };
    ASSERT_NE(options.method, nullptr);
    ASSERT_TRUE(options.quality && options.pattern);
    EXPECT_EQ(options.method->name, value("method"));
    EXPECT_NE(options.method->name, "grid") << "not every driver has geometry shaders";
    EXPECT_EQ(name_of(*options.quality), value("quality"));
    EXPECT_EQ(options.particles ? "true" : "false", value("particles"));
    EXPECT_EQ(name_of(*options.pattern), value("pattern"));
    EXPECT_EQ(viewer_preset_options.size(), 4U) << "the values above are all";
  }
}

TEST(ViewerPreset, flag_and_environment_stand_over_it_and_it_over_what_was_kept) {
  ::setenv("SCREE_PRESET", "laptop", 1);
  ::setenv("SCREE_QUALITY", "medium", 1);
  ViewerOptions options = viewer_by({"--method", "raymarch"});
  ::unsetenv("SCREE_PRESET");
  ::unsetenv("SCREE_QUALITY");
  Settings kept;
  kept.quality = Quality::high;
  kept.particles = true;
  kept.method = "dual";
  apply_settings(kept, options);
  EXPECT_EQ(options.method->name, "raymarch");
  EXPECT_EQ(options.quality, Quality::medium);
  EXPECT_FALSE(options.particles) << "the preset's";
  EXPECT_FALSE(options.given.view_radius) << "so that another quality, chosen later, brings its own";
}

TEST(ViewerPreset, one_that_draws_nothing_or_is_unknown_is_a_mistake) {
  for (const char* name : {"dedicated", "toaster"}) {
    testing::internal::CaptureStderr();
    const auto parsed = parse_preset({"--preset", name});
    const std::string said = testing::internal::GetCapturedStderr();
    ASSERT_TRUE(std::holds_alternative<ExitNow>(parsed)) << name;
    EXPECT_EQ(std::get<ExitNow>(parsed).status, 2);
    EXPECT_NE(said.find(name), std::string::npos) << said;
  }
}

TEST(ViewerPreset, a_pattern_is_one_that_a_hand_has) {
  EXPECT_EQ(viewer_by({"--pattern", "even"}).pattern, SeedPattern::even);
  EXPECT_EQ(viewer_by({}).pattern, std::nullopt) << "as it was kept";
  for (const char* pattern : {"authored", "woven"})
    EXPECT_EQ(std::get<ExitNow>(parse_preset({"--pattern", pattern})).status, 2) << pattern;
}

}  // namespace
}  // namespace scree
