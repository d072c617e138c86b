#include "studies/matrix/results_log.h"

#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <sstream>
#include <vector>

namespace scree {

namespace {

using Json = nlohmann::ordered_json;

struct Line {
  std::string what;
  NamedFigures figures;
};

std::string text_of(const ResultsIdentity& identity) {
  return Json{{"build", identity.build}, {"machine", identity.machine}, {"plan", identity.plan}}.dump();
}

std::string text_of(const std::string& what, const NamedFigures& figures) {
  return Json{{"of", what}, {"figures", figures}}.dump();
}

/// Nothing: the line is no result.
std::optional<Line> result_in(const std::string& text) {
  const Json json = Json::parse(text, nullptr, false);
  if (!json.is_object() || json.size() != 2) return std::nullopt;
  const auto of = json.find("of"), figures = json.find("figures");
  if (of == json.end() || !of->is_string() || figures == json.end() || !figures->is_object())
    return std::nullopt;
  Line line{of->get<std::string>(), {}};
  for (const auto& [name, value] : figures->items()) {
    if (!value.is_number()) return std::nullopt;
    line.figures[name] = value.get<double>();
  }
  return line;
}

/// The lines of a file that have an end; `length`: of all these.
std::vector<std::string> whole_lines(const std::string& path, size_t& length) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream all;
  all << file.rdbuf();
  const std::string text = all.str();
  std::vector<std::string> lines;
  length = 0;
  for (size_t end = text.find('\n'); end != std::string::npos; end = text.find('\n', length)) {
    lines.push_back(text.substr(length, end - length));
    length = end + 1;
  }
  return lines;
}

}  // namespace

Result<ResultsLog> ResultsLog::open(const std::string& path, const ResultsIdentity& identity) {
  ResultsLog log;
  log.path_ = path;
  std::error_code error;
  std::filesystem::create_directories(std::filesystem::path(path).parent_path(), error);
  size_t length = 0;
  const std::vector<std::string> lines = whole_lines(path, length);
  const bool is_there = std::filesystem::exists(path, error);
  if (lines.empty()) {
    if (is_there && std::filesystem::file_size(path, error) > 0)
      log.begun_anew_ = path + ": no line is whole";
  } else if (!Json::accept(lines.front())) {
    log.begun_anew_ = path + ":1: damaged";
  } else if (lines.front() != text_of(identity)) {
    log.begun_anew_ = path + ": of another build, machine or plan";
  } else {
    for (size_t i = 1; i < lines.size() && log.begun_anew_.empty(); ++i) {
      std::optional<Line> line = result_in(lines[i]);
      if (line)
        log.results_[line->what] = std::move(line->figures);
      else
        log.begun_anew_ = path + ":" + std::to_string(i + 1) + ": damaged";
    }
  }
  if (lines.empty() || !log.begun_anew_.empty()) {
    if (Result<void> begun = log.begin(identity); !begun) return fail(begun.error().message);
    return log;
  }
  std::filesystem::resize_file(path, length, error);  // what was being written goes
  log.file_.open(path, std::ios::binary | std::ios::app);
  if (error || !log.file_) return fail("cannot write " + path);
  return log;
}

Result<void> ResultsLog::begin(const ResultsIdentity& identity) {
  results_.clear();
  file_.open(path_, std::ios::binary | std::ios::trunc);
  file_ << text_of(identity) << '\n' << std::flush;
  if (!file_) return fail("cannot write " + path_);
  return {};
}

const NamedFigures* ResultsLog::find(const std::string& what) const {
  const auto found = results_.find(what);
  return found == results_.end() ? nullptr : &found->second;
}

Result<void> ResultsLog::add(const std::string& what, const NamedFigures& figures) {
  for (const auto& [name, value] : figures)
    if (!std::isfinite(value)) return fail(what + ": " + name + " is no number");
  results_[what] = figures;
  file_ << text_of(what, figures) << '\n' << std::flush;
  if (!file_) return fail("cannot write " + path_);
  return {};
}

}  // namespace scree
