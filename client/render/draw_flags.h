// The drawing methods' own options on a command line: for a CLI::App of any program that draws.
#pragma once

#include <string>

#include "client/render/scene/draw_option.h"

namespace scree {

/// Adds the option as a flag that takes one of its values, and puts the usual one into `text`. After parsing
/// `text` is one of them. Both must outlive the parsing.
template <typename App>
auto* add_draw_option(App& app, const DrawOption& option, std::string& text) {
  const auto complaint = [&option](const std::string& given) {
    return value_of(option, given) ? std::string()
                                   : "there is no '" + given + "'; there are " + describe_values(option);
  };
  text = text_of(option, option.usual);
  return app
      .add_option("--" + std::string(option.name), text,
                  std::string(option.help) + ": " + describe_values(option))
      ->check(complaint, "VALUE")
      ->capture_default_str();
}

/// The values whose texts add_draw_option() filled; `texts` maps options to them.
template <typename Texts>
DrawOptionValues values_of_texts(const Texts& texts) {
  DrawOptionValues values;
  for (const auto& [option, text] : texts) values.set(*option, value_of(*option, text).value());
  return values;
}

}  // namespace scree
