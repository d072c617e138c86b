#include "server/replay/request_lines.h"

#include <cmath>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <optional>
#include <vector>

#include "server/replay/recorded_people.h"
#include "shared/base/overloaded.h"
#include "shared/base/wall_clock.h"

namespace scree {

namespace {

constexpr Tick people_batch_ticks = 3600;

/// What a request asks for.
struct Asked {
  std::string_view name;  ///< empty: nobody asked
  std::optional<Shape> shape{};
  std::string text{};
};

Asked asked_of(const Region& region) {
  std::vector<std::string_view> forbidden;
  for (const RegionRule& rule : region_rules)
    if (region.forbids_any(rule.bit)) forbidden.push_back(rule.name);
  const glm::vec3 at = region.centre_m, half = region.half_m;
  return {"set_region",
          {},
          fmt::format("{}: {} at {:g} {:g} {:g}, half {:g} {:g} {:g}, forbids {}{}{}", region.name,
                      name_of(region.form), at.x, at.y, at.z, half.x, half.y, half.z,
                      forbidden.empty() ? "nothing" : fmt::format("{}", fmt::join(forbidden, ",")),
                      region.tells ? ", tells" : "", region.counts ? ", counts" : "")};
}

Asked asked_of(const DigRequest& dig) {
  const std::string piece = dig.piece != 0 ? fmt::format("piece {} ", dig.piece) : std::string();
  return {"dig", dig.shape, piece + "into " + text_of(dig.store)};
}

Asked asked_of(const PlaceRequest& place, const Palette& palette) {
  return {"place", place.shape,
          fmt::format("{}{} out of {}", palette.row_or_first(place.material).name,
                      place.solid ? ", solid," : "", text_of(place.store))};
}

Asked asked_of(const TransferRequest& transfer, const Palette& palette) {
  std::string of = transfer.material ? std::string(palette.row_or_first(*transfer.material).name) : "all";
  if (transfer.mass != 0) of = fmt::format("{} units of {}", transfer.mass, of);
  return {"transfer", {}, fmt::format("{} from {} to {}", of, text_of(transfer.from), text_of(transfer.to))};
}

Asked asked_of(const RulesRequest& rules) {
  return {"rules", {}, text_of(rules.act)};
}

Asked asked_of(const RestoreRequest& restore) {
  const size_t bricks = restore.bricks == nullptr ? 0 : restore.bricks->size();
  return {"restore", {}, fmt::format("{} bricks, without {} pieces", bricks, restore.pieces.size())};
}

Asked asked_of(const SettingsRequest& settings) {
  Asked asked{"settings"};
  for (const SettingValue& setting : settings.settings)
    asked.text += (asked.text.empty() ? "" : " ") + setting.name + "=" + setting.value;
  return asked;
}

Asked asked_of(const AddJointRequest& add) {
  const Joint& joint = add.joint;
  const auto side = [](PieceId body) {
    return body == 0 ? std::string("the terrain") : fmt::format("body {}", body);
  };
  return {"add_joint",
          {},
          fmt::format("{}, {} and {}", name_of(joint.kind), side(joint.a.body), side(joint.b.body))};
}

Asked asked_by(const Request& request, const Palette& palette) {
  return std::visit(
      Overloaded{[](const CarveRequest& carve) {
                   const bool of_piece = carve.piece != 0;
                   return Asked{"carve", carve.shape, of_piece ? fmt::format("piece {}", carve.piece) : ""};
                 },
                 [&](const FillRequest& fill) {
                   const std::string material =
                       fill.material ? palette.row_or_first(*fill.material).name : "";
                   return Asked{"fill", fill.shape, material};
                 },
                 [&](const PaintRequest& paint) {
                   return Asked{"paint", paint.shape, std::string(palette.row_or_first(paint.material).name)};
                 },
                 [](const SettingsRequest& settings) { return asked_of(settings); },
                 [](const LeaveRequest&) { return Asked{}; },
                 [](const AddPropRequest& add) {
                   return Asked{
                       "add_prop", {}, fmt::format("{} parts, tag {}", add.prop.parts.size(), add.prop.tag)};
                 },
                 [](const RemovePropRequest& remove) {
                   return Asked{"remove_prop", {}, fmt::format("prop {}", remove.prop)};
                 },
                 [](const MovePropRequest& move) {
                   return Asked{"move_prop", {}, fmt::format("prop {}", move.prop)};
                 },
                 [](const PushRequest& push) {
                   return Asked{"push", {}, fmt::format("body {}", push.body)};
                 },
                 [](const BlastRequest& blast) {
                   return Asked{"blast", *shape_of(blast), fmt::format("{} J", blast.energy_j)};
                 },
                 [](const BreakRequest& broken) {
                   return Asked{"break", {}, fmt::format("piece {}", broken.piece)};
                 },
                 [](const AddJointRequest& add) { return asked_of(add); },
                 [](const RemoveJointRequest& remove) {
                   return Asked{"remove_joint", {}, fmt::format("joint {}", remove.joint)};
                 },
                 [](const SetMotorRequest& set) {
                   return Asked{"set_motor", {}, fmt::format("joint {}", set.joint)};
                 },
                 [](const CutOutRequest& cut_out) {
                   return Asked{"cut_out", cut_out.shape};
                 },
                 [](const ReleaseRequest& release) {
                   return Asked{"release", {}, fmt::format("piece {}", release.piece)};
                 },
                 [](const StandRequest& stand) {
                   return Asked{"stand", {}, stand.away ? "away" : ""};
                 },
                 [](const WalkRequest&) { return Asked{}; },  // too many to be read
                 [](const DigRequest& dig) { return asked_of(dig); },
                 [&](const PlaceRequest& place) { return asked_of(place, palette); },
                 [&](const TransferRequest& transfer) { return asked_of(transfer, palette); },
                 [](const RulesRequest& rules) { return asked_of(rules); },
                 [](const RestoreRequest& restore) { return asked_of(restore); },
                 [](const AddPieceRequest& add) {
                   return Asked{
                       "add_piece",
                       {},
                       add.volume ? fmt::format("{} voxels", add.volume->window.codes.size()) : "no voxels"};
                 },
                 [](const SetRegionRequest& set) { return asked_of(set.region); },
                 [](const RemoveRegionRequest& remove) {
                   return Asked{"remove_region", {}, remove.name};
                 }},
      request);
}

/// In the order of the columns; what is not known is null.
nlohmann::ordered_json line_of(const Command& command, const Asked& asked, Tick tick, uint32_t tick_rate_hz,
                               const RecordedPeople& people) {
  const auto rounded = [](double value) { return std::round(value * 1000.0) / 1000.0; };
  const Participant who = people.find(command.session);
  const uint64_t unix_ms = people.unix_ms(tick);
  nlohmann::ordered_json line{{"tick", tick}, {"time_s", rounded(static_cast<double>(tick) / tick_rate_hz)}};
  line["at"] = unix_ms == 0 ? nlohmann::ordered_json() : nlohmann::ordered_json(iso_time(unix_ms));
  line["request"] = asked.name;
  line["session"] = command.session;
  line["name"] = who.name.empty() ? nlohmann::ordered_json() : nlohmann::ordered_json(who.name);
  line["token"] = who.token_id == 0 ? nlohmann::ordered_json()
                                    : nlohmann::ordered_json(fmt::format("{:016x}", who.token_id));
  line["party"] = party_of(command);
  for (const char* key : {"x_m", "y_m", "z_m", "reach_m"}) line[key] = nullptr;
  if (asked.shape) {
    const glm::vec3 middle = centre_of(*asked.shape);
    line["x_m"] = rounded(middle.x);
    line["y_m"] = rounded(middle.y);
    line["z_m"] = rounded(middle.z);
    line["reach_m"] = rounded(reach_of(*asked.shape));
  }
  line["text"] = asked.text.empty() ? nlohmann::ordered_json() : nlohmann::ordered_json(asked.text);
  return line;
}

std::string as_csv(const nlohmann::ordered_json& line) {
  std::string csv;
  for (const auto& [key, value] : line.items()) {
    if (!csv.empty()) csv += ',';
    if (value.is_string())
      csv += csv_field(value.get<std::string>());
    else if (!value.is_null())
      csv += value.dump();
  }
  return csv;
}

std::string as_json(nlohmann::ordered_json line) {
  nlohmann::ordered_json known;
  for (const auto& [key, value] : line.items())
    if (!value.is_null()) known[key] = value;
  return known.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

}  // namespace

Result<void> export_requests(RecordingReader& recording, LineFormat format, const LineSink& write) {
  const uint32_t tick_rate_hz = recording.header().world.tick_rate_hz;
  if (format == LineFormat::csv) write(std::string(request_csv_heads));
  RecordedPeople people(tick_rate_hz);
  Tick known_to = 0;
  for (Tick tick = recording.first_tick(); tick <= recording.last_tick(); ++tick) {
    if (tick > known_to) {
      known_to = tick + people_batch_ticks - 1;
      const auto rows = TRY(recording.machine(tick, known_to));
      people.add(rows);
    }
    const auto commands = recording.commands(tick);
    TRY(commands);
    for (const Command& command : *commands) {
      const Asked asked = asked_by(command.body, *recording.header().world.palette);
      if (asked.name.empty()) continue;
      auto line = line_of(command, asked, tick, tick_rate_hz, people);
      write(format == LineFormat::csv ? as_csv(line) : as_json(std::move(line)));
    }
  }
  return {};
}

}  // namespace scree
