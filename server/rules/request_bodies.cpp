// Requests about pieces and props.
#include "server/rules/request_fields.h"
#include "server/rules/request_table.h"
#include "shared/base/check.h"

namespace scree {

namespace {

template <PropPartKind... kinds>
bool is_part(const void* of) {
  const PropPartKind kind = static_cast<const PropPart*>(of)->kind;
  return ((kind == kinds) || ...);
}

/// A row of a number in a part's half_m.
template <int Axis>
constexpr FieldRow half_field(std::string_view name, std::string_view what) {
  FieldRow row{.name = name, .type = FloatCodec::type, .what = what};
  row.read = [](void* to, const ScriptValue& value, const RulesMoment& moment) {
    return FloatCodec::read(static_cast<PropPart*>(to)->half_m[Axis], value, moment);
  };
  row.write = [](const void* from, ScriptWriter& to, const RulesMoment&) {
    to.number(static_cast<const PropPart*>(from)->half_m[Axis]);
  };
  return row;
}

constexpr std::array part_rows{
    field<&PropPart::kind>("shape", "box (as usual), sphere, capsule, cylinder or hull"),
    if_applies(is_part<PropPartKind::box>,
               field<&PropPart::half_m>("half", "half the sides of a box; vec(0.5, 0.5, 0.5) as usual")),
    if_applies(is_part<PropPartKind::sphere, PropPartKind::capsule, PropPartKind::cylinder>,
               needed(half_field<0>("radius", "metres; of a sphere, a capsule, a cylinder"))),
    if_applies(is_part<PropPartKind::capsule, PropPartKind::cylinder>,
               needed(half_field<1>("half_length", "of a capsule without its ends, of a cylinder, along y"))),
    if_applies(is_part<PropPartKind::hull>, needed(field<&PropPart::corners_m>("corners", "of a hull"))),
    field<&PropPart::place_m>("at", "in the body's axes"),
    field<&PropPart::turn>("turn", "likewise"),
};

}  // namespace

constexpr FieldTable prop_part_fields{"part", "a part", "A convex part of a body.", part_rows};

namespace {

Result<void> finish_prop(void* of, const GivenFields&, const RulesMoment&) {
  const Prop& prop = static_cast<const AddPropRequest*>(of)->prop;
  if (prop.parts.empty())
    return fail("a body needs parts: say box = half its sides, sphere = radius, or parts");
  return validate(prop);
}

/// A row that adds a part by one value.
template <PropPartKind kind, typename Codec>
constexpr FieldRow part_shorthand(std::string_view name, std::string_view what) {
  FieldRow row{.name = name, .type = Codec::type, .what = what};
  row.read = [](void* to, const ScriptValue& value, const RulesMoment& moment) -> Result<void> {
    PropPart part{.kind = kind};
    if constexpr (std::is_same_v<Codec, VecCodec>)
      TRY(VecCodec::read(part.half_m, value, moment));
    else
      TRY(FloatCodec::read(part.half_m.x, value, moment));
    static_cast<AddPropRequest*>(to)->prop.parts.push_back(std::move(part));
    return {};
  };
  return row;
}

constexpr FieldRow parts_row() {
  FieldRow row = field_by<ListCodec<TableCodec<prop_part_fields>>, &AddPropRequest::prop, &Prop::parts>(
      "parts", "convex solids that it is made of");
  row.type = "part[]";
  return row;
}

constexpr std::array add_prop_rows{
    parts_row(),
    part_shorthand<PropPartKind::box, VecCodec>("box", "for a box alone: half its sides"),
    part_shorthand<PropPartKind::sphere, FloatCodec>("sphere", "for a sphere alone: its radius"),
    needed(field<&AddPropRequest::place_m>("at", "where its origin is")),
    field<&AddPropRequest::turn>("turn", "how it is turned"),
    field<&AddPropRequest::velocity_m_s>("velocity", "m/s"),
    field<&AddPropRequest::spin_rad_s>("spin", "rad/s"),
    field<&AddPropRequest::prop, &Prop::material>("material", "how it looks and weighs"),
    field<&AddPropRequest::prop, &Prop::mass_kg>("mass", "kg; as usual by the material's density"),
    field<&AddPropRequest::prop, &Prop::motion>("motion", "dynamic (as usual), kinematic or fixed"),
    field<&AddPropRequest::prop, &Prop::tag>("tag", "a number of the game's own"),
    field<&AddPropRequest::prop, &Prop::friction>("friction", "coefficient; 0.6 as usual"),
    field<&AddPropRequest::prop, &Prop::restitution>("bounce",
                                                     "share of the speed that a blow gives back, 0 to 1"),
    field<&AddPropRequest::prop, &Prop::drag>("drag", "share of its speed that the air takes in a second"),
    field<&AddPropRequest::prop, &Prop::spin_drag>("spin_drag", "likewise of its spin"),
    field<&AddPropRequest::prop, &Prop::gravity>("gravity", "share of the world's gravity; 1 as usual"),
    field<&AddPropRequest::prop, &Prop::groups>("groups", "bits of the groups that it is of"),
    field<&AddPropRequest::prop, &Prop::meets>("meets", "bits of the groups that it collides with"),
    field<&AddPropRequest::prop, &Prop::model>("model", "SHA-256 of a glTF file that shows it"),
    field<&AddPropRequest::prop, &Prop::data>("data", "bytes of the game's own"),
};

constexpr std::array remove_prop_rows{
    needed(body_field<&RemovePropRequest::prop>("body", "that is taken away"))};

constexpr std::array move_prop_rows{
    needed(body_field<&MovePropRequest::prop>("body", "that is moved")),
    field<&MovePropRequest::place_m>("at", "where it is from then on"),
    field<&MovePropRequest::turn>("turn", "how it is turned"),
    field<&MovePropRequest::velocity_m_s>("velocity", "m/s"),
    field<&MovePropRequest::spin_rad_s>("spin", "rad/s"),
};

/// Puts a place at the body's own where the script said none.
template <typename Ask, PieceId Ask::*body>
Result<void> finish_at_body(void* of, const GivenFields& given, const RulesMoment& moment) {
  auto& ask = *static_cast<Ask*>(of);
  if constexpr (std::is_same_v<Ask, BreakRequest>)
    if (!given.has("seed")) ask.random_seed = random_seed_of(moment);
  if (given.has("at")) return {};
  CHECK(moment.world != nullptr);
  const auto facts = moment.world->body(ask.*body);
  if (!facts) return fail("body " + std::to_string(ask.*body) + " is not there: it may have become terrain");
  ask.at_m = facts->pose.position_m;
  return {};
}

constexpr std::array push_rows{
    needed(body_field<&PushRequest::body>("body", "that is pushed")),
    needed(field<&PushRequest::impulse_n_s>("impulse", "newton seconds")),
    field<&PushRequest::at_m>("at", "where it is pushed; its middle as usual"),
};

constexpr std::array break_rows{
    needed(body_field<&BreakRequest::piece>("body", "the piece that breaks")),
    field<&BreakRequest::at_m>("at", "about which it breaks; its middle as usual"),
    field<&BreakRequest::seeds>("pieces", "into about so many; 8 as usual"),
    field<&BreakRequest::random_seed>("seed", "of the random numbers; as usual one of the tick's"),
};

constexpr std::array release_rows{
    needed(body_field<&ReleaseRequest::piece>("body", "a kept piece, which may become terrain then"))};

}  // namespace

constexpr FieldTable add_prop_fields{"add_prop", "a body", "Adds a body of the game, a prop.", add_prop_rows,
                                     finish_prop};
constexpr FieldTable remove_prop_fields{"remove_prop", "a remove_prop", "Takes a prop away.",
                                        remove_prop_rows};
constexpr FieldTable move_prop_fields{
    "move_prop", "a move", "Puts a prop elsewhere, or changes how it moves; the rest stays.", move_prop_rows};
constexpr FieldTable push_fields{"push", "a push", "Gives a prop or a piece an impulse.", push_rows,
                                 finish_at_body<PushRequest, &PushRequest::body>};
constexpr FieldTable break_fields{"break", "a break", "Breaks a piece where it is.", break_rows,
                                  finish_at_body<BreakRequest, &BreakRequest::piece>};
constexpr FieldTable release_fields{"release", "a release", "Lets a kept piece become terrain.",
                                    release_rows};

}  // namespace scree
