// Requests about regions, and about persons on foot.
#include <algorithm>

#include "server/rules/request_fields.h"

namespace scree {

namespace {

template <RegionForm... forms>
bool is_form(const void* of) {
  const RegionForm form = static_cast<const SetRegionRequest*>(of)->region.form;
  return ((form == forms) || ...);
}

/// The names of what a region forbids.
struct ForbidsCodec {
  static constexpr std::string_view type = "string[]";
  static Result<void> read(uint8_t& to, const ScriptValue& value, const RulesMoment&) {
    to = 0;
    const int64_t length = std::min<int64_t>(TRY(value.length()), region_rules.size());
    for (int64_t i = 1; i <= length; ++i) {
      const ReadScope scope(value);
      const ScriptValue item = TRY(value.item(i));
      const std::string_view name = TRY(item.text());
      const auto rule = std::ranges::find(region_rules, name, &RegionRule::name);
      if (rule == region_rules.end()) return item.refuse("a region forbids edits, dents, falls or pieces");
      to |= rule->bit;
    }
    return {};
  }
  static void write(uint8_t from, ScriptWriter& to, const RulesMoment&) {
    to.open_table();
    for (const RegionRule& rule : region_rules)
      if ((from & rule.bit) != 0) to.text(rule.name);
    to.close_table();
  }
};

/// A number in Region::half_m, and so many of it in scripts.
template <int Axis, int Times>
constexpr FieldRow half_of_region(std::string_view name, std::string_view what) {
  FieldRow row{.name = name, .type = FloatCodec::type, .what = what};
  row.read = [](void* to, const ScriptValue& value, const RulesMoment&) -> Result<void> {
    static_cast<SetRegionRequest*>(to)->region.half_m[Axis] = TRY(read_float(value)) / Times;
    return {};
  };
  row.write = [](const void* from, ScriptWriter& to, const RulesMoment&) {
    to.number(static_cast<const SetRegionRequest*>(from)->region.half_m[Axis] * Times);
  };
  return row;
}

bool is_by_role(const void* of) {
  return static_cast<const SetRegionRequest*>(of)->region.editors == RegionEditors::role;
}
bool is_by_persons(const void* of) {
  return static_cast<const SetRegionRequest*>(of)->region.editors == RegionEditors::persons;
}

constexpr std::array set_region_rows{
    needed(field<&SetRegionRequest::region, &Region::name>("name", "its own; one of that name is replaced")),
    field<&SetRegionRequest::region, &Region::form>(
        "form", "box (as usual), sphere or cylinder, which stands upright"),
    needed(field<&SetRegionRequest::region, &Region::centre_m>("at", "its centre")),
    if_applies(is_form<RegionForm::box>,
               needed(field<&SetRegionRequest::region, &Region::half_m>("half", "half the sides of a box"))),
    if_applies(is_form<RegionForm::sphere, RegionForm::cylinder>,
               needed(half_of_region<0, 1>("radius", "of a sphere or a cylinder"))),
    if_applies(is_form<RegionForm::cylinder>, needed(half_of_region<1, 2>("height", "of a cylinder"))),
    field_by<ForbidsCodec, &SetRegionRequest::region, &Region::forbids>(
        "forbid", "any of edits, dents, falls and pieces"),
    field<&SetRegionRequest::region, &Region::editors>(
        "editors", "who may edit in spite of it: nobody (as usual), role, persons or all"),
    if_applies(is_by_role, field<&SetRegionRequest::region, &Region::role>(
                               "role", "of editors: this one and those above")),
    if_applies(is_by_persons, field<&SetRegionRequest::region, &Region::persons>(
                                  "persons", "of editors: names that tokens state")),
    if_applies(is_by_persons, field<&SetRegionRequest::region, &Region::teams>("teams", "of editors: teams")),
    field<&SetRegionRequest::region, &Region::tells>("tells", "whether on.enter and on.exit hear of it"),
    field<&SetRegionRequest::region, &Region::counts>("counts", "whether regions.masses() counts its rock"),
    field<&SetRegionRequest::lasts_s>("lasts", "seconds; until it is removed as usual"),
};

Result<void> check_region(void* of, const GivenFields&, const RulesMoment&) {
  return validate(static_cast<const SetRegionRequest*>(of)->region);
}

constexpr std::array remove_region_rows{needed(field<&RemoveRegionRequest::name>("name", "of the region"))};

bool comes(const void* of) {
  return !static_cast<const StandRequest*>(of)->away;
}

constexpr std::array stand_rows{
    field<&StandRequest::away>("away", "the person leaves the world on foot"),
    if_applies(comes, field<&StandRequest::place_m>("at", "of the feet; as usual where visitors begin")),
};

}  // namespace

constexpr FieldTable set_region_fields{"set_region", "a region", "A named place with rules of its own.",
                                       set_region_rows, check_region};
constexpr FieldTable remove_region_fields{"remove_region", "a remove_region", "Takes a region away.",
                                          remove_region_rows};
constexpr FieldTable stand_fields{"stand", "a stand", "A person enters the world on foot, or leaves it.",
                                  stand_rows};

}  // namespace scree
