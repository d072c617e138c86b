// Renders a film of a recording: the whole of `scree replay render`.
#pragma once

#include "tools/film/film_options.h"

namespace scree {

struct RenderedFilm {
  FilmPlan plan;
  double seconds = 0.0;  ///< that rendering took
};

/// Tells how far it is, from 0 to 1. An error leaves no half file, and so does being stopped.
Result<RenderedFilm> render_film(const FilmOptions& options, const Stopped& stopped,
                                 const std::function<void(double)>& progress);

}  // namespace scree
