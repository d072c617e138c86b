// history, undo and restore: who edited the world, and taking that back.
#include <chrono>
#include <cmath>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>
#include <thread>
#include <unistd.h>

#include "client/admin/programs/interrupt.h"
#include "client/admin/programs/world_commands.h"
#include "proto/limits.h"
#include "shared/base/option_check.h"

namespace scree {

namespace {

constexpr std::chrono::milliseconds progress_period{250};
constexpr float history_radius_max_m = 10'000.0F;

/// What these were told.
struct HistoryWords {
  Place at_m{};
  float radius_m = 4.0F;
  std::string by;
  double since_s = 0.0;
  Tick to_tick = 0;
  uint64_t show_session = 0;
  std::vector<float> box;
  bool preview = false, keep_others = false, over_others = false, stop = false, progress = false, wait = true;
  CLI::Option* at = nullptr;
};

/// "20m" and the like.
CLI::Option* add_since(CLI::App* command, HistoryWords& words, const std::string& what) {
  return command->add_option("--since", words.since_s, what + ": seconds, or as 90s, 20m, 2h, 1d")
      ->transform(CLI::AsNumberWithUnit(
          std::map<std::string, double>{{"s", 1.0}, {"m", 60.0}, {"h", 3600.0}, {"d", 86400.0}},
          CLI::AsNumberWithUnit::CASE_SENSITIVE, "TIME"))
      ->check(CLI::Range(1e-3, 1e9));
}

void add_box(CLI::App* command, HistoryWords& words) {
  command->add_option("--box", words.box, "only within this box: its lowest and its highest corner, metres")
      ->expected(6)
      ->delimiter(',');
}

/// Lines for a terminal, or JSON that this program has read.
Printed print_history(const Result<std::string>& said, bool as_json) {
  if (!said) return tl::unexpected(Failed(said.error()));
  if (!as_json) return rules_lines(*said);
  const auto json = nlohmann::ordered_json::parse(*said, nullptr, false);
  if (json.is_discarded()) return tl::unexpected(Failed(Error{"the server's answer is no JSON"}));
  return json.dump(2, ' ', true, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

uint32_t whole_seconds(double seconds) {
  return static_cast<uint32_t>(std::ceil(seconds));
}

Printed print_edits(const AdminServer& server, const HistoryWords& words, bool as_json) {
  HistoryRequest request{.radius_m = words.radius_m, .by = words.by, .since_s = whole_seconds(words.since_s)};
  if (words.at->count() > 0) request.at_m = vector_of(words.at_m);
  request.as_json = as_json;
  return print_history(ask_history(server, request), as_json);
}

/// Who sits at a terminal is asked what becomes of others' edits; nothing: he gives up.
std::optional<UndoMode> asked_of_person(const std::string& conflict) {
  if (::isatty(STDIN_FILENO) == 0 || ::isatty(STDERR_FILENO) == 0) return std::nullopt;
  std::cerr << rules_lines(conflict)
            << "keep what others did last, or take back theirs, too? [keep/over/no] ";
  std::string line;
  if (!read_line_unless_interrupted(line)) return std::nullopt;
  if (line == "keep") return UndoMode::keep_others;
  if (line == "over") return UndoMode::over_others;
  return std::nullopt;
}

/// Looks how far it is until it is over.
Printed wait_for_end(const AdminServer& server, bool as_json) {
  UndoRequest look{.mode = UndoMode::progress};
  look.as_json = true;
  for (;;) {
    const auto said = TRY(ask_history(server, look));
    const auto json = nlohmann::json::parse(said, nullptr, false);
    if (!json.is_object()) return tl::unexpected(Failed(Error{"the server's answer is no JSON"}));
    if (::isatty(STDERR_FILENO) != 0)
      std::cerr << "\r" << json.value("bricks_done", 0) << " of " << json.value("bricks", 0) << " bricks ";
    if (json.value("over", true)) break;
    if (was_interrupted()) return "\nthe undo goes on in the server: undo --progress says how far\n";
    std::this_thread::sleep_for(progress_period);
  }
  if (::isatty(STDERR_FILENO) != 0) std::cerr << "\r\x1b[K";
  look.as_json = as_json;
  return print_history(ask_history(server, look), as_json);
}

Printed take_back(const AdminServer& server, const HistoryWords& words, bool as_json) {
  UndoRequest request{.by = words.by, .since_s = whole_seconds(words.since_s), .to_tick = words.to_tick};
  request.as_json = as_json;
  request.show_session = words.show_session;
  request.mode = words.preview       ? UndoMode::preview
                 : words.keep_others ? UndoMode::keep_others
                 : words.over_others ? UndoMode::over_others
                                     : UndoMode::refuse_conflicts;
  if (words.stop) request.mode = UndoMode::stop;
  if (words.progress) request.mode = UndoMode::progress;
  const bool begins = !words.preview && !words.stop && !words.progress;
  if (begins && words.by.empty() && words.to_tick == 0)
    return misused({"say whose edits are taken back (--by)"});
  if (words.box.size() == 6) {
    request.lo_m = glm::vec3(words.box[0], words.box[1], words.box[2]);
    request.hi_m = glm::vec3(words.box[3], words.box[4], words.box[5]);
  }
  auto said = ask_history(server, request);
  if (!said && request.mode == UndoMode::refuse_conflicts &&
      said.error().message.find("--keep-others") != std::string::npos)
    if (const auto mode = asked_of_person(said.error().message)) {
      request.mode = *mode;
      said = ask_history(server, request);
    }
  if (!begins || !said || !words.wait) return print_history(said, as_json);
  if (as_json) return wait_for_end(server, true);
  std::string text = rules_lines(*said);
  const auto end = TRY(wait_for_end(server, false));
  return text + end;
}

void add_taking_back(CLI::App* command, const std::shared_ptr<HistoryWords>& words, WorldCommands& table) {
  add_box(command, *words);
  CLI::Option* const preview =
      command->add_flag("--preview", words->preview, "only says what would be taken back");
  bounded(command->add_option("--show", words->show_session,
                              "marks the places for half a minute on the screen of this session"),
          whole_within(1, whole_most))
      ->needs(preview);
  command->add_flag("!--no-wait", words->wait, "returns when it begins, not when it is over");
  table.push_back({command, [words](const AdminServer& server, bool as_json) -> Printed {
                     return take_back(server, *words, as_json);
                   }});
}

}  // namespace

void add_history_commands(CLI::App& app, WorldCommands& table) {
  const auto asked = std::make_shared<HistoryWords>();
  const std::string whose =
      "whose: a name or name:NAME, session:NUMBER, token:ID, address:HASH or undo:NUMBER";
  CLI::App* const history = app.add_subcommand("history", "prints who edited the world, the newest first");
  asked->at = add_place(history, "--at", asked->at_m, "edits near this place: x y z, metres");
  bounded(history->add_option("--radius", asked->radius_m, "from there, metres"), {0.0, history_radius_max_m})
      ->capture_default_str()
      ->needs(asked->at);
  history->add_option("--by", asked->by, whose);
  add_since(history, *asked, "edits of the last time");
  table.push_back({history, [asked](const AdminServer& server, bool as_json) -> Printed {
                     return print_edits(server, *asked, as_json);
                   }});

  const auto undone = std::make_shared<HistoryWords>();
  CLI::App* const undo =
      app.add_subcommand("undo", "takes back what somebody did: bricks become what they were, pieces go");
  undo->add_option("--by", undone->by, whose);
  add_since(undo, *undone, "what was done in the last time; without it: all that is remembered");
  add_taking_back(undo, undone, table);
  CLI::Option* const keep = undo->add_flag("--keep-others", undone->keep_others,
                                           "what others edited since stays, where they were the last");
  undo->add_flag("--over-others", undone->over_others, "what others edited since is taken back, too")
      ->excludes(keep)
      ->excludes(undo->get_option("--preview"));
  std::vector<CLI::Option*> others = undo->get_options();
  std::erase_if(others, [](const CLI::Option* option) { return option->check_lname("help"); });
  CLI::Option* const stop = undo->add_flag("--stop", undone->stop, "ends the undo that goes on");
  CLI::Option* const progress =
      undo->add_flag("--progress", undone->progress, "says how far the last undo is")->excludes(stop);
  for (CLI::Option* const option : others) option->excludes(stop)->excludes(progress);

  const auto restored = std::make_shared<HistoryWords>();
  restored->over_others = true;
  CLI::App* const restore =
      app.add_subcommand("restore", "makes the terrain in a box what it was after a tick");
  bounded(restore->add_option("--to", restored->to_tick, "the tick"), whole_within(1, whole_most))
      ->required();
  add_taking_back(restore, restored, table);
  restore->get_option("--box")->required();
}

}  // namespace scree
