// A mistyped name of an option, a command or a variable is refused with the name that was meant.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace scree {

/// "; did you mean NAME?" for the known name that differs least, in so many letters at most; else nothing.
std::string did_you_mean(std::string_view name, std::span<const std::string> known, size_t mistyped_max);

/// The refusal of words of a command line that belong to nothing. It names the first option among them, or
/// else the first word. `commands`: those that the word may have meant.
std::string words_of_unknown(std::span<const std::string> words, std::span<const std::string> options,
                             std::span<const std::string> commands);

/// Lets a CLI::App say so. `Extras`: CLI::ExtrasError.
template <typename Extras, typename App>
void name_unknown_words(App& app) {
  app.failure_message([](const auto* failed, const auto& error) {
    std::string text = error.what();
    if (dynamic_cast<const Extras*>(&error) != nullptr) {
      const auto given = failed->get_subcommands();
      std::vector<std::string> options, commands;
      const auto add_options = [&options](const auto* of) {
        for (const auto* option : of->get_options())
          for (const std::string& name : option->get_lnames()) options.push_back("--" + name);
      };
      add_options(failed);
      for (const auto* command : given) add_options(command);
      if (given.empty())
        for (const auto* command : failed->get_subcommands([](const auto*) { return true; }))
          commands.push_back(command->get_name());
      text = words_of_unknown(failed->remaining(true), options, commands);
    }
    return text + "\nRun with --help for more information.\n";
  });
}

}  // namespace scree
