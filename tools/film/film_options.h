// The options of `scree replay render`.
#pragma once

#include <string>
#include <variant>

#include "tools/film/film_order.h"
#include "tools/film/frame_drawer.h"
#include "tools/film/frame_sink.h"

namespace scree {

struct FilmOptions {
  std::string recording{};
  std::string ground{};  ///< its ground file; empty: looked for
  FilmOrder order{};
  DrawChoice drawn{};
  FilmFormat format{};  ///< without its sound, which is made first
  bool sound = true;    ///< false also where the format has none
};

/// Nothing is opened but a file of --path. The exit status, if the program should end now; what it says is
/// printed.
std::variant<FilmOptions, int> parse_film_options(int argc, const char* const* argv);

}  // namespace scree
