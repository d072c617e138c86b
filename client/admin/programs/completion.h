// What may come next in a line of the console, by the subcommands and options of an app of CLI11. Pure.
#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <string>
#include <vector>

#include "client/admin/console/typed_words.h"

namespace scree {

/// Words of the console itself, which it takes where a line begins.
inline constexpr const char* console_help = "help";
inline constexpr const char* console_ends[] = {"quit", "exit"};

/// The names of settings; is called where one is typed.
using SettingNames = std::function<std::vector<std::string>()>;

/// Words that begin with the one that is typed, sorted: subcommands, options of the subcommand, or "NAME=" of
/// settings.
std::vector<std::string> continuations(const CLI::App& app, const Typing& typing,
                                       const SettingNames& settings);

}  // namespace scree
