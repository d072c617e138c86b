// An answer to an HTTP request, and its head as bytes.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "server/command/refusal.h"

namespace scree {

struct HttpResponse {
  int status = 200;
  std::vector<std::pair<std::string, std::string>> fields{};  ///< beside those that every answer has
  std::shared_ptr<const std::string> body{};                  ///< null: none
  bool ends = false;                                          ///< the connection, behind this answer
  bool is_file = false;                                       ///< of the page, or the browser has it already
  std::optional<Refusal> refused{};                           ///< it is counted as this

  bool is_upgrade() const { return status == 101; }
};

/// A line of text for people.
HttpResponse words(int status, const std::string& line);
/// Likewise, counted as a refusal, behind which the connection ends.
HttpResponse refusal(int status, Refusal reason, const std::string& line);

/// The head, with what every answer says: the date, the body's length, what isolates the page from others and
/// keeps it from loading anything from elsewhere. `keep_alive`: the connection stays open behind it.
std::string head_of(const HttpResponse& response, bool keep_alive);

}  // namespace scree
