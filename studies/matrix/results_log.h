// What a study measured so far, in a file of JSON Lines, so that a run that was broken off goes on.
//
// The first line says of which build, machine and plan the results are; each further one is a result. Results
// of another build, machine or plan, and those of a damaged file, are not used: the file is begun anew. A
// last line without its end was being written when the run broke off, and is measured again. One thread.
#pragma once

#include <fstream>
#include <map>
#include <string>

#include "shared/base/result.h"

namespace scree {

/// A result's numbers, by name.
using NamedFigures = std::map<std::string, double>;

/// Tells which runs' results may be used together.
struct ResultsIdentity {
  std::string build;  ///< this_build() (studies/support/this_build.h)
  std::string machine;
  std::string plan;  ///< what is measured, and how: "full"

  bool operator==(const ResultsIdentity&) const = default;
};

class ResultsLog {
 public:
  /// Reads the file, if there is one, and writes on from there. Fails where it cannot be written.
  static Result<ResultsLog> open(const std::string& path, const ResultsIdentity& identity);

  /// Why results in the file were not used; empty: there were none, or all are.
  const std::string& begun_anew() const { return begun_anew_; }
  size_t count() const { return results_.size(); }
  /// Null if that was not measured yet.
  const NamedFigures* find(const std::string& what) const;
  /// Writes the result at once, with all of its line.
  Result<void> add(const std::string& what, const NamedFigures& figures);

 private:
  Result<void> begin(const ResultsIdentity& identity);

  std::string path_;
  std::string begun_anew_;
  std::map<std::string, NamedFigures> results_;
  std::ofstream file_;
};

/// A member of T, and its name in files.
template <typename T>
struct FigureField {
  const char* name;
  double T::*member;
};

/// The result, measured if it is not there yet. T says its fields as a range of FigureField<T> by
/// T::fields(); one that the file lacks makes the result to be measured again.
template <typename T, typename Measure>
Result<T> read_or_measure(ResultsLog& log, const std::string& what, const Measure& measure) {
  if (const NamedFigures* found = log.find(what); found != nullptr) {
    T value{};
    bool whole = true;
    for (const FigureField<T>& field : T::fields()) {
      const auto it = found->find(field.name);
      whole = whole && it != found->end();
      if (it != found->end()) value.*field.member = it->second;
    }
    if (whole) return value;
  }
  const Result<T> value = measure();
  if (!value) return value;
  NamedFigures figures;
  for (const FigureField<T>& field : T::fields()) figures[field.name] = (*value).*field.member;
  if (Result<void> added = log.add(what, figures); !added) return fail(added.error().message);
  return value;
}

}  // namespace scree
