#include "client/admin/programs/completion.h"

#include <algorithm>

namespace scree {

namespace {

using Words = std::vector<std::string>;

/// Groups of options have no name; theirs are the command's.
void add_options(const CLI::App& command, Words& words) {
  for (const CLI::Option* option : command.get_options())
    for (const std::string& name : option->get_lnames()) words.push_back("--" + name);
  for (const CLI::App* group :
       command.get_subcommands([](const CLI::App* one) { return one->get_name().empty(); }))
    add_options(*group, words);
}

void add_subcommands(const CLI::App& command, Words& words) {
  for (const CLI::App* one :
       command.get_subcommands([](const CLI::App* sub) { return !sub->get_name().empty(); }))
    words.push_back(one->get_name());
}

const CLI::App* subcommand_named(const CLI::App& command, const std::string& name) {
  const auto found = command.get_subcommands([&](const CLI::App* one) { return one->get_name() == name; });
  return name.empty() || found.empty() ? nullptr : found.front();
}

bool takes_setting(const CLI::App& command) {
  return std::ranges::any_of(command.get_options(), [](const CLI::Option* option) {
    return option->get_positional() && option->get_name(true) == "NAME=VALUE";
  });
}

/// Whether the word is an option that a value follows.
bool wants_value(const CLI::App& command, const std::string& word) {
  if (!word.starts_with("--") || word.find('=') != std::string::npos) return false;
  const CLI::Option* const option = command.get_option_no_throw(word);
  return option != nullptr && option->get_items_expected_min() > 0;
}

Words all_words(const CLI::App& app, const Typing& typing, const SettingNames& settings) {
  Words words;
  const bool helps = !typing.before.empty() && typing.before.front() == console_help;
  const CLI::App* command = &app;
  for (size_t i = helps ? 1 : 0; i < typing.before.size(); ++i)
    if (const CLI::App* const next = subcommand_named(*command, typing.before[i])) command = next;
  if (!typing.before.empty() && wants_value(*command, typing.before.back())) return words;
  if (typing.word.starts_with('-')) {
    add_options(*command, words);
    if (command != &app) add_options(app, words);
    return words;
  }
  add_subcommands(*command, words);
  if (typing.before.empty()) {
    words.emplace_back(console_help);
    words.insert(words.end(), std::begin(console_ends), std::end(console_ends));
  }
  if (!helps && takes_setting(*command))
    for (const std::string& name : settings()) words.push_back(name + "=");
  return words;
}

}  // namespace

std::vector<std::string> continuations(const CLI::App& app, const Typing& typing,
                                       const SettingNames& settings) {
  Words words = all_words(app, typing, settings);
  std::erase_if(words, [&](const std::string& word) { return !word.starts_with(typing.word); });
  std::ranges::sort(words);
  words.erase(std::unique(words.begin(), words.end()), words.end());  // clang 14 lacks std::ranges::unique
  return words;
}

}  // namespace scree
