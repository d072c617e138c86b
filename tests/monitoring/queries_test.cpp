// The queries of docker/monitoring, and the table of docs/monitoring.md, against the figures of a server that
// has worked.
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/monitoring/worked_server.h"
#include "tests/support/holds.h"
#include "tests/support/run_program.h"

namespace scree {
namespace {

const std::string monitoring = SCREE_SOURCE_DIR "/docker/monitoring/";

std::string read_text(const std::string& path) {
  std::ifstream file(path);
  std::stringstream text;
  text << file.rdbuf();
  return text.str();
}

std::vector<std::string> dashboard_queries() {
  std::vector<std::string> queries;
  const auto dashboard = nlohmann::json::parse(read_text(monitoring + "dashboard.json"));
  for (const auto& panel : dashboard["panels"])
    for (const auto& target : panel.value("targets", nlohmann::json::array()))
      queries.push_back(target["expr"]);
  for (const auto& variable : dashboard["templating"]["list"]) queries.push_back(variable["query"]["query"]);
  return queries;
}

/// Each `expr` of the file: on its line, or on the lines behind it.
std::vector<std::string> alert_queries() {
  std::vector<std::string> queries;
  std::istringstream lines(read_text(monitoring + "alerts.yml"));
  bool goes_on = false;
  for (std::string line; std::getline(lines, line);) {
    const size_t at = line.find("expr: ");
    const bool is_key = line.find(": ") != std::string::npos && line.find('{') > line.find(": ");
    if (at != std::string::npos) {
      queries.push_back(line.substr(at + 6));
      goes_on = holds(queries.back(), ">-");
      if (goes_on) queries.back().clear();
    } else if (goes_on && !is_key) {
      queries.back() += line;
    } else {
      goes_on = false;
    }
  }
  return queries;
}

struct Selector {
  std::string name;
  std::vector<std::pair<std::string, std::string>> labels;  ///< with "="; with other signs the value is empty
};

std::vector<Selector> selectors_in(const std::string& query) {
  static const std::regex selector(R"(\b((?:scree|process)_[a-z0-9_]+|up)\b(?:\{([^}]*)\})?)");
  static const std::regex matcher(R"re(([a-z_]+)\s*(=~|!~|!=|=)\s*"([^"]*)")re");
  std::vector<Selector> found;
  for (std::sregex_iterator at(query.begin(), query.end(), selector), end; at != end; ++at) {
    Selector one{(*at)[1].str(), {}};
    const std::string labels = (*at)[2].str();
    for (std::sregex_iterator label(labels.begin(), labels.end(), matcher); label != end; ++label)
      one.labels.emplace_back((*label)[1].str(), (*label)[2].str() == "=" ? (*label)[3].str() : "");
    found.push_back(std::move(one));
  }
  return found;
}

/// Whether a series has the name and the labels. Prometheus itself gives each a job and an instance.
bool is_served(const Samples& samples, const Selector& selector) {
  return std::ranges::any_of(samples, [&](const auto& sample) {
    if (sample.first.substr(0, sample.first.find('{')) != selector.name) return false;
    return std::ranges::all_of(selector.labels, [&](const auto& label) {
      if (label.first == "job" || label.first == "instance") return true;
      return holds(sample.first,
                   label.first + "=\"" + (label.second.empty() ? std::string() : label.second + "\""));
    });
  });
}

class MonitoringQueries : public ::testing::Test {
 protected:
  void SetUp() override {
    ASSERT_NO_FATAL_FAILURE(worked.work());
    page = worked.page();
    samples = samples_of(page);
  }
  void expect_served(const std::vector<std::string>& queries) {
    for (const std::string& query : queries) {
      const auto selectors = selectors_in(query);
      EXPECT_FALSE(selectors.empty()) << query << " asks for no figure of the server";
      for (const Selector& selector : selectors)
        EXPECT_TRUE(selector.name == "up" || is_served(samples, selector))
            << selector.name << " of \"" << query << "\" is no figure of the server, or lacks the label";
    }
  }
  WorkedServer worked;
  std::string page;
  Samples samples;
};

TEST_F(MonitoringQueries, of_the_dashboard_are_of_figures_that_a_server_serves) {
  const auto queries = dashboard_queries();
  EXPECT_GT(queries.size(), 50U);
  expect_served(queries);
}

TEST_F(MonitoringQueries, of_the_alerts_are_of_figures_that_a_server_serves) {
  const auto queries = alert_queries();
  EXPECT_EQ(queries.size(), 20U);
  expect_served(queries);
}

TEST_F(MonitoringQueries, with_a_name_or_a_label_that_no_server_has_are_found) {
  EXPECT_FALSE(is_served(samples, selectors_in("rate(scree_tick_total[1m])").at(0)));
  EXPECT_FALSE(is_served(samples, selectors_in("scree_healthy{path=\"status\"}").at(0)));
  EXPECT_TRUE(is_served(samples, selectors_in("scree_healthy{path=\"livez\", instance=~\"$i\"}").at(0)));
}

TEST_F(MonitoringQueries, of_the_dashboard_are_well_formed) {
  const TestFolder folder;
  {
    std::ofstream rules(folder / "rules.yml");
    rules << "groups:\n  - name: dashboard\n    rules:\n";
    size_t number = 0;
    for (const std::string& query : dashboard_queries()) {
      if (query.starts_with("label_values")) continue;  // Grafana's own
      const std::string filled = std::regex_replace(query, std::regex(R"(\$__rate_interval)"), "1m");
      rules << "      - {record: \"a" << number++ << "\", expr: " << nlohmann::json(filled).dump() << "}\n";
    }
  }
  const auto [status, said] = run_program(PROMTOOL " check rules " + (folder / "rules.yml"));
  EXPECT_EQ(status, 0) << said;
}

TEST(Monitoring, alerts_are_due_when_they_should_be) {
  const auto [status, said] =
      run_program("cd " SCREE_SOURCE_DIR "/tests/monitoring && " PROMTOOL " test rules alerts_test.yml");
  EXPECT_EQ(status, 0) << said;
  const auto [checked, why] = run_program(PROMTOOL " check config " + monitoring + "prometheus.yml");
  EXPECT_EQ(checked, 0) << why;
}

/// The names of a column of code in a table: "| `scree_pieces` | …".
TEST_F(MonitoringQueries, the_page_of_the_documentation_has_each_figure_and_no_other) {
  std::set<std::string> documented;
  const std::string text = read_text(SCREE_SOURCE_DIR "/docs/monitoring.md");
  static const std::regex named(R"(`((?:scree|process)_[a-z0-9_]+)`)");
  for (std::sregex_iterator at(text.begin(), text.end(), named), end; at != end; ++at)
    documented.insert((*at)[1].str());
  std::set<std::string> served;
  static const std::regex typed(R"(# TYPE ([a-z0-9_]+) )");
  for (std::sregex_iterator at(page.begin(), page.end(), typed), end; at != end; ++at)
    served.insert((*at)[1].str());
  EXPECT_GT(served.size(), 60U);
  // Those of a bus are served beside a server of NATS alone.
  const std::string of_bus = read_text(SCREE_SOURCE_DIR "/server/app/live_server_bus.cpp");
  static const std::regex added(R"re("(scree_[a-z0-9_]+)")re");
  for (std::sregex_iterator at(of_bus.begin(), of_bus.end(), added), end; at != end; ++at)
    served.insert((*at)[1].str());
  EXPECT_TRUE(served.contains("scree_edge_tick"));
  for (const std::string& name : served)
    EXPECT_TRUE(documented.contains(name)) << name << " is not documented";
  for (const std::string& name : documented) EXPECT_TRUE(served.contains(name)) << name << " is not served";
}

}  // namespace
}  // namespace scree
