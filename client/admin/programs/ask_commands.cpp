// ask: questions about space.
#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <memory>

#include "client/admin/programs/world_commands.h"
#include "shared/base/option_check.h"
#include "shared/query/limits.h"

namespace scree {

namespace {

/// What the questions were told. Metres.
struct AskWords {
  Place from{}, to{}, direction{}, at{}, lo{}, hi{};
  float most_m = 100.0F, radius_m = 0.5F, near_m = 8.0F;
  int64_t as_of = 0;
  bool no_terrain = false, no_pieces = false, no_props = false;
  std::vector<PieceId> except;
};

/// What is asked, or why nothing can be.
using Asked = tl::expected<AskedFor, Failed>;
using Unit = tl::expected<glm::vec3, Failed>;

/// A direction of any length but 0.
Unit unit_of(const Place& direction) {
  const glm::vec3 way = vector_of(direction);
  const float length = glm::length(way);
  if (length > 0.0F) return way / length;
  return misused({"--direction has no length: name a way, such as 0 -1 0"});
}

Asked ray_of(const AskWords& w, const CLI::App&) {
  return RayQuestion{vector_of(w.from), TRY(unit_of(w.direction)), w.most_m};
}
Asked sphere_of(const AskWords& w, const CLI::App&) {
  return SphereQuestion{vector_of(w.from), TRY(unit_of(w.direction)), w.most_m, w.radius_m};
}
Asked capsule_of(const AskWords& w, const CLI::App&) {
  return CapsuleQuestion{vector_of(w.from), vector_of(w.to), TRY(unit_of(w.direction)), w.most_m, w.radius_m};
}
Asked overlap_of(const AskWords& w, const CLI::App& command) {
  if (command.count("--at") == 0 && command.count("--lo") == 0)
    return misused({"--at, or --lo and --hi, is required"});
  if (command.count("--at") > 0) return InSphereQuestion{vector_of(w.at), w.radius_m};
  return InBoxQuestion{vector_of(w.lo), vector_of(w.hi)};
}
Asked nearest_of(const AskWords& w, const CLI::App&) {
  return NearestQuestion{vector_of(w.at), w.near_m};
}
Asked solid_of(const AskWords& w, const CLI::App&) {
  return SolidQuestion{vector_of(w.at)};
}
Asked content_of(const AskWords& w, const CLI::App&) {
  return ContentQuestion{vector_of(w.lo), vector_of(w.hi)};
}
Asked bodies_of(const AskWords& w, const CLI::App&) {
  return BodiesQuestion{vector_of(w.lo), vector_of(w.hi)};
}

/// Options that a kind of question has.
enum Takes : unsigned { way = 1, line = 2, radius = 4, place = 8, box = 16, near = 32 };

struct AskKind {
  const char* name;
  const char* what;
  unsigned takes;
  Asked (*make)(const AskWords& words, const CLI::App& command);
};

constexpr AskKind kinds[] = {
    {"ray", "what does a ray hit first", way, ray_of},
    {"sphere", "what does a ball that moves hit first", way | radius, sphere_of},
    {"capsule", "what does a capsule that moves hit first", way | line | radius, capsule_of},
    {"overlap", "what has a place in a ball, or in a box", place | radius | box, overlap_of},
    {"nearest", "which surface is nearest to a place", place | near, nearest_of},
    {"solid", "does a place lie in rock or in a prop", place, solid_of},
    {"content", "what is the terrain in a box made of", box, content_of},
    {"bodies", "which bodies have their positions in a box", box, bodies_of},
};

void add_options(CLI::App* command, unsigned takes, AskWords& w) {
  if ((takes & way) != 0) {
    add_place(command, "--from", w.from, "X Y Z where it begins, metres")->required();
    add_place(command, "--direction", w.direction, "X Y Z: the way it goes")->required();
    command->add_option("--most", w.most_m, "how far it goes, metres")->capture_default_str();
  }
  if ((takes & line) != 0)
    add_place(command, "--to", w.to, "X Y Z: the capsule's other end as it begins")->required();
  if ((takes & radius) != 0)
    command->add_option("--radius", w.radius_m, "radius of the ball or the capsule, metres")
        ->capture_default_str();
  CLI::Option* at = nullptr;
  if ((takes & place) != 0) at = add_place(command, "--at", w.at, "X Y Z, metres");
  if ((takes & near) != 0)
    bounded(command->add_option("--most", w.near_m, "how far it may be, metres"),
            NumberWithin{0.0, limits::query_nearest_max_m})
        ->capture_default_str();
  if ((takes & box) == 0) {
    if (at != nullptr) at->required();
    return;
  }
  CLI::Option* const lo = add_place(command, "--lo", w.lo, "X Y Z: the box's lower corner, metres");
  CLI::Option* const hi = add_place(command, "--hi", w.hi, "X Y Z: the box's upper corner");
  lo->needs(hi);
  hi->needs(lo);
  if (at != nullptr)
    lo->excludes(at);
  else
    lo->required();
}

Printed ask(const AdminServer& server, const AskWords& words, const Asked& asks, bool as_json) {
  if (!asks) return tl::unexpected(asks.error());
  Question question{*asks, {}};
  question.mask.terrain = !words.no_terrain;
  question.mask.pieces = !words.no_pieces;
  question.mask.bodies = !words.no_props;
  question.mask.except = words.except;
  if (const Result<void> valid = validate(question); !valid) return misused(valid.error());
  const auto said = TRY(ask_space(server, question, words.as_of));
  const auto palette = names_materials(said) ? TRY(read_materials(server)) : Palette();
  return as_json ? answer_json(said, palette) : answer_lines(said, palette);
}

}  // namespace

void add_ask_commands(CLI::App& app, WorldCommands& table) {
  const auto words = std::make_shared<AskWords>();
  CLI::App* const asks = app.add_subcommand("ask", "asks what is where: rays, overlaps, what a box holds");
  asks->require_subcommand(1);
  asks->fallthrough();
  asks->add_option(
      "--as-of", words->as_of,
      "asks about a tick shortly before; negative: so many ticks before the newest; 0: the newest");
  asks->add_flag("--no-terrain", words->no_terrain, "leaves terrain out");
  asks->add_flag("--no-pieces", words->no_pieces, "leaves pieces out");
  asks->add_flag("--no-props", words->no_props, "leaves props out");
  asks->add_option("--except", words->except, "ids of bodies to leave out")->delimiter(',');
  for (const AskKind& kind : kinds) {
    CLI::App* const command = asks->add_subcommand(kind.name, kind.what);
    command->fallthrough();
    add_options(command, kind.takes, *words);
    table.push_back({command, [words, command, make = kind.make](const AdminServer& server, bool as_json) {
                       return ask(server, *words, make(*words, *command), as_json);
                     }});
  }
}

}  // namespace scree
