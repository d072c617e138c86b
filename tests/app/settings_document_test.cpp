// The table of settings in docs/host.md names each setting and its values.
#include <algorithm>
#include <fstream>
#include <gtest/gtest.h>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

#include "server/world/settings.h"

namespace scree {
namespace {

struct StatedSetting {
  std::string name;
  std::string values;
};

std::vector<StatedSetting> stated_settings() {
  static const std::regex row(R"(\| `([^`]+)` \| ([^|]+) \| .+ \|)");
  std::ifstream page(SCREE_SOURCE_DIR "/docs/host.md");
  std::vector<StatedSetting> rows;
  std::string line;
  while (std::getline(page, line) && line != "| setting | values | decides |") continue;
  std::smatch match;
  for (std::getline(page, line); std::getline(page, line) && std::regex_match(line, match, row);)
    rows.push_back({match[1], match[2]});
  return rows;
}

/// The words in backticks, in the order of the alphabet.
std::vector<std::string> quoted(const std::string& values) {
  static const std::regex word("`([^`]+)`");
  std::vector<std::string> words;
  for (std::sregex_iterator it(values.begin(), values.end(), word), end; it != end; ++it)
    words.push_back((*it)[1]);
  std::sort(words.begin(), words.end());
  return words;
}

TEST(SettingsDocument, the_page_names_every_setting_and_its_values) {
  const std::vector<StatedSetting> stated = stated_settings();
  ASSERT_EQ(stated.size(), settings().size());
  for (size_t i = 0; i < stated.size(); ++i) {
    const Setting& setting = settings()[i];
    EXPECT_EQ(stated[i].name, setting.name);
    if (setting.is_text()) {
      const std::vector<std::string> forms = quoted(stated[i].values);
      EXPECT_FALSE(forms.empty()) << setting.name;
      for (const std::string& form : forms)
        EXPECT_NE(setting.may_be().find(form), std::string::npos) << setting.name << ": " << form;
      continue;
    }
    if (setting.choices.empty()) {
      std::ostringstream bounds;
      bounds << setting.bounds.min << " to " << static_cast<int64_t>(setting.bounds.max);
      EXPECT_EQ(stated[i].values, bounds.str()) << setting.name;
      continue;
    }
    std::vector<std::string> names(setting.choices.begin(), setting.choices.end());
    std::sort(names.begin(), names.end());
    EXPECT_EQ(quoted(stated[i].values), names) << setting.name;
  }
}

}  // namespace
}  // namespace scree
