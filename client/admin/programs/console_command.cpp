#include "client/admin/programs/console_command.h"

#include <algorithm>
#include <cstdio>
#include <iostream>
#include <unistd.h>

#include "client/admin/console/line_editor.h"
#include "client/admin/console/line_history.h"
#include "client/admin/console/typed_words.h"
#include "client/admin/programs/completion.h"
#include "client/admin/programs/interrupt.h"

namespace scree {

namespace {

/// For the names of settings, while a person waits for a completion.
constexpr std::chrono::milliseconds names_within{1000};
constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";

/// As completion leaves them; a backslash keeps one.
std::string without_last_spaces(std::string line) {
  while (line.ends_with(' ') && !line.ends_with("\\ ")) line.pop_back();
  return line;
}

class Console {
 public:
  Console(const AdminServer& server, const AdminSettings& settings) : server_(server), settings_(settings) {}

  int run_on_terminal();
  int run_script();

 private:
  bool ends(const std::vector<std::string>& words) const {
    return words.size() == 1 && std::ranges::find(console_ends, words.front()) != std::end(console_ends);
  }
  int run_line(const std::string& line);
  int run_words(std::vector<std::string> words) const;
  std::string unknown_of(const std::vector<std::string>& words) const;
  LineEditor::Offer offer(std::string_view line);
  const std::vector<std::string>& setting_names();

  const AdminServer server_;
  const AdminSettings settings_;
  std::vector<std::string> setting_names_;  ///< empty: not known yet
  bool over_ = false;
};

/// Returns the exit status that the program would have.
int Console::run_line(const std::string& line) {
  auto words = split_words(line);
  if (!words) return complain(words.error(), exit_usage);
  if (words->empty()) return 0;
  if (ends(*words)) {
    over_ = true;
    return 0;
  }
  if (words->front() == console_help) {
    words->erase(words->begin());
    if (const std::string unknown = unknown_of(*words); !unknown.empty())
      return complain(Error{"there is no subcommand " + unknown + " to help with"}, exit_usage);
    words->emplace_back("--help");
  }
  const int status = run_words(std::move(*words));
  std::fflush(stdout);
  return status;
}

/// The first of these that names no subcommand of the one before it; empty: all do.
std::string Console::unknown_of(const std::vector<std::string>& words) const {
  CLI::App app("", "");
  const AdminApp commands(app, settings_);
  const CLI::App* within = &app;
  for (const std::string& word : words) {
    const auto named =
        within->get_subcommands([&](const CLI::App* command) { return command->check_name(word); });
    if (named.empty()) return word;
    within = named.front();
  }
  return {};
}

/// The app is made for each line, for it keeps what it has parsed.
int Console::run_words(std::vector<std::string> words) const {
  CLI::App app("", "");
  AdminApp commands(app, settings_);
  app.footer("The console has help SUBCOMMAND, quit and exit, too.");
  std::ranges::reverse(words);  // CLI11 takes them from the back
  try {
    app.parse(std::move(words));
    if (app.get_subcommands().empty()) throw CLI::RequiredError("A subcommand");
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : exit_usage;
  }
  return commands.run(server_);
}

/// They are asked for once.
const std::vector<std::string>& Console::setting_names() {
  if (!setting_names_.empty()) return setting_names_;
  AdminServer server = server_;
  server.within = std::min(names_within, settings_.within());
  if (const auto settings = read_settings(server))
    for (const SettingValue& setting : *settings) setting_names_.push_back(setting.name);
  return setting_names_;
}

LineEditor::Offer Console::offer(std::string_view line) {
  const Typing typing = typing_of(line);
  if (typing.quoted) return {};
  CLI::App app("", "");
  const AdminApp commands(app, settings_);
  return {typing.word.size(), continuations(app, typing, [this] { return setting_names(); })};
}

int Console::run_on_terminal() {
  note_interrupts();
  std::printf("scree-admin %s at %s: help lists the subcommands, Tab completes, Ctrl-D ends\n", SCREE_VERSION,
              text_of(server_).c_str());
  LineHistory history(admin_history_path());
  LineEditor editor(text_of(server_) + "> ", [this](std::string_view line) { return offer(line); });
  for (const std::string& line : history.lines()) editor.remember(line);
  while (!over_) {
    const LineEditor::Typed typed = editor.read();
    if (typed.end == LineEditor::End::dropped) {
      std::printf("\n");
      continue;
    }
    if (typed.end == LineEditor::End::closed) {
      std::printf("\n");
      break;
    }
    const std::string kept = without_last_spaces(typed.line);
    if (history.add(kept)) editor.remember(kept);
    forget_interrupt();
    run_line(typed.line);
  }
  return 0;
}

int Console::run_script() {
  size_t number = 0;
  int status = 0;
  for (std::string line; !over_ && std::getline(std::cin, line);) {
    if (++number == 1 && line.starts_with(byte_order_mark)) line.erase(0, byte_order_mark.size());
    if (line.ends_with('\r')) line.pop_back();  // of a script from another system
    if (run_line(line) == 0) continue;
    std::fprintf(stderr, "scree-admin: line %zu failed\n", number);
    status = exit_failed;
  }
  if (std::ferror(stdin) != 0) return complain(Error{"the script cannot be read to its end"}, exit_failed);
  return status;
}

}  // namespace

int run_console(const AdminServer& server, const AdminSettings& settings) {
  Console console(server, settings);
  const bool on_terminal = ::isatty(STDIN_FILENO) != 0 && ::isatty(STDOUT_FILENO) != 0;
  return on_terminal ? console.run_on_terminal() : console.run_script();
}

}  // namespace scree
