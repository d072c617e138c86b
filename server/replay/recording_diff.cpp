#include "server/replay/recording_diff.h"

#include <algorithm>
#include <fmt/format.h>

#include "server/replay/field_diff.h"
#include "server/replay/recorded_world.h"
#include "server/store/recording_reader.h"
#include "server/world/settings.h"
#include "shared/base/overloaded.h"

namespace scree {

namespace {

/// Ticks behind one with another hash of the bodies in which a piece with another pose is looked for.
constexpr Tick looked_ahead_max = 600;

std::string text_of(glm::vec3 p) {
  return fmt::format("({:.3f}, {:.3f}, {:.3f}) m", p.x, p.y, p.z);
}

std::string text_of(const Shape& shape) {
  return fmt::format("{} at {}, radius {:.3f} m", name_of(shape.kind), text_of(centre_of(shape)),
                     shape.radius_m);
}

std::string text_of(const Command& command, const Palette& palette) {
  const std::string body = std::visit(
      Overloaded{
          [](const CarveRequest& carve) {
            const std::string of = carve.piece != 0 ? fmt::format(" out of piece {}", carve.piece) : "";
            return fmt::format("carve a {}{}, {} seeds, random seed {}", text_of(carve.shape), of,
                               carve.seeds, carve.random_seed);
          },
          [](const FillRequest& fill) { return "fill a " + text_of(fill.shape); },
          [&](const PaintRequest& paint) {
            return fmt::format("paint a {} as {}", text_of(paint.shape),
                               palette.row_or_first(paint.material).name);
          },
          [](const SettingsRequest& request) {
            std::string set = "set";
            for (const SettingValue& value : request.settings)
              set += fmt::format(" {}={}", value.name, value.value);
            return set;
          },
          [](const LeaveRequest&) { return std::string("leave"); },
          [](const AddPropRequest& add) {
            return fmt::format("add a prop of {} parts", add.prop.parts.size());
          },
          [](const RemovePropRequest& remove) { return fmt::format("remove prop {}", remove.prop); },
          [](const MovePropRequest& move) { return fmt::format("move prop {}", move.prop); },
          [](const PushRequest& push) { return fmt::format("push body {}", push.body); },
          [](const BreakRequest& broken) { return fmt::format("break piece {}", broken.piece); },
          [](const BlastRequest& blast) { return fmt::format("a blast of {} J", blast.energy_j); },
          [](const AddJointRequest& add) { return fmt::format("add a {} joint", name_of(add.joint.kind)); },
          [](const RemoveJointRequest& remove) { return fmt::format("remove joint {}", remove.joint); },
          [](const SetMotorRequest& set) { return fmt::format("set the motor of joint {}", set.joint); },
          [](const CutOutRequest& cut_out) { return "cut out a " + text_of(cut_out.shape); },
          [](const ReleaseRequest& release) { return fmt::format("release piece {}", release.piece); },
          [](const StandRequest& stand) { return std::string(stand.away ? "leave on foot" : "stand"); },
          [](const WalkRequest& walk) {
            return fmt::format("walk towards {}{}", text_of(walk.input.go), walk.input.jump ? ", jump" : "");
          },
          [](const DigRequest& dig) {
            const std::string piece = dig.piece != 0 ? fmt::format("piece {} at ", dig.piece) : std::string();
            return fmt::format("dig {}a {} into {}", piece, text_of(dig.shape), text_of(dig.store));
          },
          [&](const PlaceRequest& place) {
            return fmt::format("place a {} of {}{} out of {}", text_of(place.shape),
                               palette.row_or_first(place.material).name, place.solid ? ", solid," : "",
                               text_of(place.store));
          },
          [](const TransferRequest& transfer) {
            return fmt::format("transfer {} units from {} to {}", transfer.mass, text_of(transfer.from),
                               text_of(transfer.to));
          },
          [](const RulesRequest& rules) { return "rules: " + text_of(rules.act); },
          [](const RestoreRequest& restore) {
            return fmt::format("restore {} bricks, remove {} pieces",
                               restore.bricks == nullptr ? 0 : restore.bricks->size(), restore.pieces.size());
          },
          [](const AddPieceRequest& add) {
            return add.volume ? fmt::format("add a piece of {} voxels", add.volume->window.codes.size())
                              : std::string("add a piece that cannot be read");
          },
          [](const SetRegionRequest& set) { return fmt::format("set region '{}'", set.region.name); },
          [](const RemoveRegionRequest& remove) { return fmt::format("remove region '{}'", remove.name); }},
      command.body);
  return fmt::format("session {}, request {}: {}", command.session, command.request, body);
}

/// One side as it is read tick by tick.
struct Side {
  std::unique_ptr<RecordingReader> reader;
  SettingValues settings;  ///< as they stand
  RecordedFrame frame;
  std::vector<Command> commands;

  Result<void> read(Tick tick) {
    auto next = TRY(reader->frame(tick));
    auto asked = TRY(reader->commands(tick));
    frame = std::move(next);
    commands = std::move(asked);
    if (!frame.settings.empty()) settings = frame.settings;
    return {};
  }
};

Result<Side> open_side(const std::string& path) {
  auto reader = TRY(RecordingReader::open(path));
  return Side{std::move(reader), {}, {}, {}};
}

/// How the settings stood before the first tick that is compared.
Result<void> begin(Side& side, Tick first) {
  side.settings = print(side.reader->header().world);
  const auto keyframe = TRY(side.reader->keyframe_before(first - 1));
  if (keyframe.has_value() && !keyframe->settings.empty()) side.settings = keyframe->settings;
  return {};
}

std::string world_difference(const WorldConfig& a, const WorldConfig& b) {
  if (!is_same_terrain(a, b)) return "they are of another ground, seed or voxel size";
  if (a.tick_rate_hz != b.tick_rate_hz)
    return fmt::format("{} ticks a second, in the other {}", a.tick_rate_hz, b.tick_rate_hz);
  if (a.merges_per_tick_max != b.merges_per_tick_max)
    return fmt::format("{} merges a tick at most, in the other {}", a.merges_per_tick_max,
                       b.merges_per_tick_max);
  return {};
}

std::string command_difference(const Side& a, const Side& b) {
  if (a.commands == b.commands) return {};
  const size_t both = std::min(a.commands.size(), b.commands.size());
  size_t at = 0;
  while (at < both && a.commands[at] == b.commands[at]) ++at;
  const auto said = [at](const Side& side) {
    return at < side.commands.size() ? text_of(side.commands[at], *side.reader->header().world.palette)
                                     : std::string("none");
  };
  return fmt::format("command {}: {}; in the other: {}", at + 1, said(a), said(b));
}

std::string setting_difference(const Side& a, const Side& b) {
  if (a.frame.settings.empty() && b.frame.settings.empty()) return {};
  for (const SettingValue& value : a.settings) {
    const auto other = std::ranges::find(b.settings, value.name, &SettingValue::name);
    if (other == b.settings.end())
      return fmt::format("{}={}, which the other does not have", value.name, value.value);
    if (other->value != value.value)
      return fmt::format("{}={}, in the other {}", value.name, value.value, other->value);
  }
  return a.settings.size() == b.settings.size() ? std::string() : "the other has more settings";
}

std::string ledger_difference(const Ledger& a, const Ledger& b, float voxel_size_m) {
  const double m3 = double{voxel_size_m} * voxel_size_m * voxel_size_m / units_per_voxel;
  std::string text;
  const auto compare = [&](const char* name, int64_t one, int64_t other) {
    if (one != other)
      text += fmt::format("{}{} {:.6f} m³, in the other {:.6f} m³", text.empty() ? "" : "; ", name,
                          static_cast<double>(one) * m3, static_cast<double>(other) * m3);
  };
  compare("terrain", a.terrain, b.terrain);
  compare("pieces", a.pieces, b.pieces);
  compare("dust", a.dust, b.dust);
  compare("poured", a.poured, b.poured);
  compare("moved", a.moved, b.moved);
  compare("stored", a.stored, b.stored);
  return text;
}

/// The first piece, by its id, that did not move alike; empty: all did.
std::string piece_difference(const std::vector<PieceState>& a, const std::vector<PieceState>& b) {
  const auto [one, other] = std::ranges::mismatch(a, b);
  if (one == a.end() && other == b.end()) return {};
  const auto place = [](const PieceState& piece) { return text_of(dequantise(piece.pose).position_m); };
  if (other == b.end() || (one != a.end() && one->id < other->id))
    return fmt::format("piece {} moves to {}, and does not in the other", one->id, place(*one));
  if (one == a.end() || other->id < one->id)
    return fmt::format("piece {} does not move, and does in the other, to {}", other->id, place(*other));
  if (place(*one) == place(*other))
    return fmt::format("piece {} at {} is turned otherwise", one->id, place(*one));
  return fmt::format("piece {} is at {}, in the other at {}", one->id, place(*one), place(*other));
}

class Comparison {
 public:
  Comparison(const DiffSide& a, const DiffSide& b, Side one, Side other)
      : names_a_(a), names_b_(b), a_(std::move(one)), b_(std::move(other)) {}

  Result<RecordingDiff> run(const std::function<void(Tick, Tick)>& progress) {
    result_.first = std::max(a_.reader->first_tick(), b_.reader->first_tick());
    result_.last = std::min(a_.reader->last_tick(), b_.reader->last_tick());
    if (result_.first > result_.last) return fail("they have no tick in common");
    const WorldConfig& world = a_.reader->header().world;
    add(DiffStage::world, world_difference(world, b_.reader->header().world));
    if (!result_.same()) return at(result_.first);
    for (Side* side : {&a_, &b_}) TRY(begin(*side, result_.first));
    for (Tick tick = result_.first; tick <= result_.last; ++tick) {
      for (Side* side : {&a_, &b_}) TRY(side->read(tick));
      TRY(compare(tick));
      if (!result_.same()) return at(tick);
      if (progress && tick % progress_ticks == 0)
        progress(tick - result_.first + 1, result_.last - result_.first + 1);
    }
    compare_extent();
    return result_;
  }

 private:
  void add(DiffStage stage, std::string text) {
    if (!text.empty()) result_.stages.push_back({stage, std::move(text)});
  }
  RecordingDiff at(Tick tick) {
    result_.tick = tick;
    return result_;
  }

  Result<void> compare(Tick tick) {
    add(DiffStage::commands, command_difference(a_, b_));
    add(DiffStage::settings, setting_difference(a_, b_));
    if (a_.frame.field_hash != b_.frame.field_hash) {
      const auto where = TRY(field_difference(names_a_, names_b_, tick));
      add(DiffStage::field, where);
    }
    std::string moved = piece_difference(a_.frame.moved, b_.frame.moved);
    // The hash is of field, ledger and bodies: where the others agree, the bodies do not.
    if (moved.empty() && result_.same() && is_same_ledger() && a_.frame.state_hash != b_.frame.state_hash) {
      auto later = TRY(first_piece_after(tick));
      moved = std::move(later);
    }
    add(DiffStage::bodies, std::move(moved));
    add(DiffStage::ledger,
        ledger_difference(a_.frame.ledger, b_.frame.ledger, a_.reader->header().world.terrain.voxel_size_m));
    return {};
  }

  bool is_same_ledger() const { return ledger_difference(a_.frame.ledger, b_.frame.ledger, 1.0F).empty(); }

  /// Bodies differ by less than poses tell; where that shows first.
  Result<std::string> first_piece_after(Tick tick) {
    const std::string exact = "the exact motions differ by less than poses can store";
    const Tick end = std::min(result_.last, tick + looked_ahead_max);
    for (Tick later = tick + 1; later <= end; ++later) {
      const auto one = TRY(a_.reader->frame(later));
      const auto other = TRY(b_.reader->frame(later));
      if (const std::string piece = piece_difference(one.moved, other.moved); !piece.empty())
        return exact + fmt::format("; seen first at tick {}: ", later) + piece;
    }
    return exact;
  }

  void compare_extent() {
    const auto ticks = [](const Side& side) {
      return fmt::format("{} to {}", side.reader->first_tick(), side.reader->last_tick());
    };
    if (ticks(a_) == ticks(b_)) return;
    const bool begins_apart = a_.reader->first_tick() != b_.reader->first_tick();
    result_.tick =
        begins_apart ? std::min(a_.reader->first_tick(), b_.reader->first_tick()) : result_.last + 1;
    add(DiffStage::extent,
        fmt::format("has the ticks {}, the other {}; the ticks {} to {}, which both have, are the same",
                    ticks(a_), ticks(b_), result_.first, result_.last));
  }

  const DiffSide& names_a_;
  const DiffSide& names_b_;
  Side a_, b_;
  RecordingDiff result_;
};

}  // namespace

Result<RecordingDiff> diff(const DiffSide& a, const DiffSide& b,
                           const std::function<void(Tick, Tick)>& progress) {
  auto one = TRY(open_side(a.path));
  auto other = TRY(open_side(b.path));
  return Comparison(a, b, std::move(one), std::move(other)).run(progress);
}

}  // namespace scree
