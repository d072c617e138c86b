#include <algorithm>
#include <nlohmann/json.hpp>
#include <numeric>
#include <sstream>
#include <tuple>

#include "bench/support/machine.h"
#include "bench/support/text_file.h"
#include "studies/matrix/matrix_report.h"

namespace scree {

namespace {

using Json = nlohmann::ordered_json;

Json as_json(const MatrixResults& results, const std::vector<MatrixScore>& scores, size_t number) {
  const auto [drawing, simulated] = combination_of(results, number);
  Json json{{"drawing", drawing},
            {"cutter", name_of(simulated.cutter)},
            {"simplifier", name_of(simulated.simplifier)},
            {"collider", name_of(simulated.collider)},
            {"recombine", name_of(simulated.recombine)},
            {"pattern", name_of(simulated.pattern)}};
  for (size_t i = 0; i < matrix_criteria.size(); ++i)
    json[std::string(matrix_criteria[i].name)] = scores[number][i];
  return json;
}

Json as_json(const ProfileFigures& figures) {
  Json json;
  for (const FigureField<ProfileFigures>& field : ProfileFigures::fields())
    json[field.name] = figures.*field.member;
  return json;
}

Result<void> write_best(const MatrixResults& results, const std::vector<MatrixScore>& scores,
                        const std::string& path) {
  Json json;
  json["conditions"] = {{"machine", slug_of(this_machine())},
                        {"renderer", results.renderer},
                        {"quick", results.quick},
                        {"combinations", scores.size()}};
  json["balanced"] = as_json(results, scores, balanced_choice(scores));
  for (size_t i = 0; i < matrix_criteria.size(); ++i)
    json["by"][std::string(matrix_criteria[i].name)] = as_json(results, scores, best_by(scores, i));
  for (const auto& [who, number] :
       {std::pair("defaults", number_of(results, "mesh", {})),
        std::pair("papers_program", number_of(results, "raymarch", papers_program()))})
    if (number < scores.size()) json[who] = as_json(results, scores, number);
  for (const auto& [preset, figures] : results.profiles)
    json["presets"][std::string(name_of(preset))] = as_json(figures);
  return write_text_file(path, json.dump(2) + '\n');
}

Result<void> write_ranking(const MatrixResults& results, const std::vector<MatrixScore>& scores,
                           const std::string& path) {
  const std::vector<MatrixScore> ranks = ranks_of(scores);
  std::vector<size_t> order(scores.size());
  std::iota(order.begin(), order.end(), size_t{0});
  std::ranges::sort(order, {}, [&](size_t i) {
    return std::tuple(std::ranges::max(ranks[i]), std::accumulate(ranks[i].begin(), ranks[i].end(), 0.0), i);
  });
  std::ostringstream file;
  file << "drawing,cutter,simplifier,collider,recombine,pattern";
  for (const Criterion& criterion : matrix_criteria) file << ',' << criterion.name;
  file << ",worst_rank\n";
  for (const size_t i : order) {
    std::string names = text_of(combination_of(results, i));
    std::ranges::replace(names, ' ', ',');
    file << names;
    for (const double value : scores[i]) file << ',' << value;
    file << ',' << std::ranges::max(ranks[i]) << '\n';
  }
  return write_text_file(path, file.str());
}

}  // namespace

Result<void> write_matrix_files(const MatrixResults& results, const std::string& folder) {
  const std::vector<MatrixScore> scores = scores_of(results);
  TRY(write_best(results, scores, folder + "/best.json"));
  return write_ranking(results, scores, folder + "/ranking.csv");
}

}  // namespace scree
