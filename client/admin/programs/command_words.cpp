#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "client/admin/programs/world_commands.h"
#include "shared/base/option_check.h"

namespace scree {

namespace {

Printed mass_text(const AdminServer& server, MassUnits mass) {
  const auto world = TRY(read_world(server));
  return fmt::format("done, {:.3f} m³\n", m3_of(mass, world));
}

std::string answer_text(const ReplyMessage& reply, bool as_json) {
  if (as_json) {
    nlohmann::ordered_json json{{"tick", reply.tick}, {"pieces", reply.pieces}};
    if (reply.prop) json["prop"] = *reply.prop;
    if (reply.joint) json["joint"] = *reply.joint;
    if (reply.mass) json["units"] = *reply.mass;
    return json.dump(2) + "\n";
  }
  if (reply.joint) return fmt::format("joint {} is added\n", *reply.joint);
  if (reply.prop && reply.pieces > 0)
    return fmt::format("piece {} is kept, the first of {}\n", *reply.prop, reply.pieces);
  if (reply.prop) return fmt::format("prop {} is added\n", *reply.prop);
  return reply.pieces > 0 ? fmt::format("done, {} pieces\n", reply.pieces) : "done\n";
}

}  // namespace

glm::vec3 vector_of(const Place& numbers) {
  return {numbers[0], numbers[1], numbers[2]};
}

CLI::Option* add_place(CLI::App* command, const std::string& name, Place& to, const std::string& what) {
  return command->add_option(name, to, what)->delimiter(',')->check([](const std::string& text) {
    const bool is_number = text.find_first_not_of("0123456789+-.eE,") == std::string::npos;
    return is_number ? std::string() : "'" + text + "' is no number";
  });
}

CLI::Option* add_id(CLI::App* command, const std::string& name, PieceId& to, const std::string& what,
                    bool or_terrain) {
  CLI::Option* const option = command->add_option(name, to, what);
  const NumberWithin ids = whole_within(1, UINT32_MAX);
  if (!or_terrain) return bounded(option, ids);
  option->transform([](std::string text) { return text == "terrain" ? "0" : text; });
  return option->check(
      [ids](const std::string& text) {
        const std::string wrong = text == "0" ? "" : ids(text);
        return wrong.empty() ? wrong : "neither terrain nor the id of a body: " + wrong;
      },
      "terrain or an id");
}

Printed run_request(const AdminServer& server, const Made& request, bool as_json) {
  if (!request) return tl::unexpected(request.error());
  const auto reply = TRY(ask_world(server, *request));
  return reply.mass && !as_json ? mass_text(server, *reply.mass) : answer_text(reply, as_json);
}

}  // namespace scree
