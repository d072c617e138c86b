#include "studies/support/studies.h"

namespace scree {

const std::vector<Study>& all_studies() {
  static const std::vector<Study> studies = {
      {"matrix", "every combination of methods, and the presets, with a ranking", run_matrix_study},
      {"paper", "the paper's experiments, with a report of every figure", run_paper_study},
      {"peers", "libraries and programs of others on the same work, as ratios", run_peers_study},
      {"scale", "cost over size with its exponents, and what one machine holds", run_scale_study},
  };
  return studies;
}

}  // namespace scree
