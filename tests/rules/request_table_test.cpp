// Requests as tables of scripts, both ways.
#include "server/rules/request_table.h"

#include <gtest/gtest.h>

#include "server/rules/prelude.h"
#include "server/rules/values.h"
#include "tests/support/flat_world.h"
#include "tests/support/request_samples.h"

namespace scree {
namespace {

ScriptOptions options_of_tables() {
  ScriptOptions options;
  options.name = "tables";
  options.work_max = 1'000'000'000;
  options.cpu_max_s = 60.0;
  return options;
}

/// A script without rules: what it gets and gives are tables of requests.
class TableScript {
 public:
  TableScript() : world_(flat_world()), script_(*Script::create(options_of_tables())) {
    persons_[5].who = {.session = 5, .name = "anna"};
    persons_[6].who = {.session = 6, .name = "bert", .token_id = 0xAB};
    moment.world = &world_;
    moment.persons = &persons_;
    moment.next_request = &next_request_;
    for (const std::string_view type : {person_type, body_type, joint_type})
      script_.define_method(type, "is_there", [](ScriptCall&) -> Result<void> { return {}; });
    script_.define("", "read", [this](ScriptCall& call) -> Result<void> {
      const std::string kind(TRY(call.argument(1, "kind").text()));
      request = TRY(read_request(kind, call.argument(2, kind), moment));
      return {};
    });
    script_.define("", "sample", [this](ScriptCall& call) -> Result<void> {
      call.results().open_table();
      write_request(call.results(), request, moment);
      call.results().close_table();
      return {};
    });
    script_.define("", "change", [this](ScriptCall& call) -> Result<void> {
      request = TRY(changed_request(request, call.argument(1, "request"), moment));
      return {};
    });
    ScriptBudget budget{1'000'000, 10.0};
    EXPECT_TRUE(load_prelude(script_, budget).has_value());
  }

  /// The fault's words; empty: there was none.
  std::string run(const std::string& text) {
    ScriptBudget budget{1'000'000'000, 60.0};
    const auto ended = script_.load_text("test", text, budget);
    return ended ? "" : ended.error().message;
  }

  RulesMoment moment;
  Request request;

 private:
  World world_;
  RulesPersons persons_;
  uint32_t next_request_ = 1;
  Script script_;
};

/// The request of the same kind that says nothing; a joint and a region keep their kind, which the script
/// does not change by saying it again.
Request plain_request(const Request& like) {
  return std::visit([](const auto& one) { return Request(std::decay_t<decltype(one)>{}); }, like);
}

TEST(RequestTable, every_kind_comes_back_as_it_went) {
  TableScript script;
  for (const Request& sample : samples::script_requests()) {
    script.request = sample;
    ASSERT_EQ(script.run("kept = sample()"), "") << kind_of(sample);
    script.request = plain_request(sample);
    ASSERT_EQ(script.run("change(kept)"), "") << kind_of(sample);
    EXPECT_TRUE(script.request == sample) << kind_of(sample);
  }
}

TEST(RequestTable, a_handler_may_return_the_table_that_it_got) {
  TableScript script;
  script.request = samples::edit_requests().front();
  ASSERT_EQ(script.run("local r = sample() r.kind = 'carve' r.by = nil r.radius = 0.5 change(r)"), "");
  EXPECT_EQ(std::get<CarveRequest>(script.request).shape.radius_m, 0.5F);
  EXPECT_EQ(std::get<CarveRequest>(script.request).random_seed, 4000000000U);
  EXPECT_NE(script.run("change{ kind = 'fill' }").find("the kind of a request stays 'carve'"),
            std::string::npos);
}

TEST(RequestTable, what_is_not_said_is_as_usual) {
  TableScript script;
  ASSERT_EQ(script.run("read('carve', { at = vec(1, 2, 3), radius = 2 })"), "");
  const CarveRequest carve = std::get<CarveRequest>(script.request);
  EXPECT_EQ(carve.shape, sphere({1.0F, 2.0F, 3.0F}, 2.0F));
  EXPECT_EQ(carve.seeds, CarveRequest{}.seeds);
  EXPECT_EQ(carve.pattern, usual_pattern);
  EXPECT_EQ(carve.impact_m, glm::vec3(1.0F, 4.0F, 3.0F));
  EXPECT_EQ(carve.random_seed, random_seed_of(script.moment));
  ASSERT_EQ(script.run("read('dig', { at = { 1, 2, 3 }, radius = 1 })"), "");
  EXPECT_EQ(std::get<DigRequest>(script.request).store, worlds_store());
  ASSERT_EQ(script.run("read('add_prop', { box = { x = 1, y = 2, z = 3 }, at = vec{ 0, 4, 0 } })"), "");
  EXPECT_EQ(std::get<AddPropRequest>(script.request).prop.parts.front().half_m, glm::vec3(1.0F, 2.0F, 3.0F));
}

TEST(RequestTable, an_unknown_field_is_named_with_those_there_are) {
  TableScript script;
  EXPECT_EQ(script.run("read('fill', { at = vec(0, 0, 0), raduis = 1 })"),
            "test:1: argument 2 (fill): 'raduis' is no field of a fill: shape, at, radius, material");
  EXPECT_EQ(script.run("read('fill', { shape = 'box', at = vec(0, 0, 0), radius = 1 })"),
            "test:1: argument 2 (fill): 'radius' is no field of a fill: shape, at, half, rounding, material");
  EXPECT_EQ(script.run("read('fill', { vec(0, 0, 0), radius = 1 })"),
            "test:1: argument 2 (fill): an item without a name is no field of a fill: shape, at, radius, "
            "material");
}

TEST(RequestTable, a_missing_field_is_named_with_what_it_is) {
  TableScript script;
  EXPECT_EQ(script.run("read('fill', { at = vec(0, 0, 0) })"),
            "test:1: argument 2 (fill): a fill needs 'radius': metres; of all shapes but a box");
  EXPECT_EQ(script.run("read('paint', { at = vec(0, 0, 0), radius = 1 })"),
            "test:1: argument 2 (paint): a paint needs 'material': what the rock in it becomes");
  EXPECT_EQ(script.run("read('fill', 7)"),
            "test:1: argument 2 (fill) is a number, not a table with the fields of a fill");
}

TEST(RequestTable, a_value_of_the_wrong_sort_is_named_with_its_field) {
  TableScript script;
  const auto refusal_of = [&](const std::string& fields) {
    return script.run("read('carve', { at = vec(0, 0, 0), radius = 1, " + fields + " })");
  };
  EXPECT_NE(refusal_of("pieces = 2.5").find("argument 2 (carve).pieces is a number with a fraction"),
            std::string::npos);
  EXPECT_NE(refusal_of("pieces = -1").find("-1 is not 0 to 4294967295"), std::string::npos);
  EXPECT_NE(refusal_of("pattern = 'odd'").find("'odd' is not uniform, radial"), std::string::npos);
  EXPECT_NE(refusal_of("speed = 1e300").find("the number is too large"), std::string::npos);
  EXPECT_NE(refusal_of("speed = 0/0").find("is no finite number"), std::string::npos);
  EXPECT_NE(refusal_of("impact = { 1, 2 }").find("is no vec, such as vec(1, 2, 3)"), std::string::npos);
  EXPECT_NE(refusal_of("body = 0").find("0 is the number of no body"), std::string::npos);
  const std::string words = script.run("read('paint', { at = vec(0, 0, 0), radius = 1, material = 'gold' })");
  EXPECT_NE(words.find("there is no material 'gold': rock, soil, ice"), std::string::npos) << words;
}

TEST(RequestTable, what_no_world_takes_is_refused_at_once) {
  TableScript script;
  EXPECT_NE(script.run("read('fill', { at = vec(0, 0, 0), radius = -1 })"), "");
  EXPECT_NE(script.run("read('add_prop', { at = vec(0, 0, 0) })").find("a body needs parts"),
            std::string::npos);
  EXPECT_NE(script.run("read('set_region', { name = '', at = vec(0, 0, 0), half = vec(1, 1, 1) })"), "");
}

TEST(RequestTable, a_store_of_a_person_is_that_of_the_token) {
  TableScript script;
  script.request = TransferRequest{{StoreKind::token, 0xAB}, {StoreKind::session, 5}};
  ASSERT_EQ(
      script.run("t = sample() assert(tostring(t.from) == 'person 6' and tostring(t.to) == 'person 5')"), "");
  script.request = TransferRequest{};
  ASSERT_EQ(script.run("read('transfer', { from = t.from, to = t.to })"), "");
  EXPECT_EQ(std::get<TransferRequest>(script.request).from, (StoreName{StoreKind::token, 0xAB}));
  EXPECT_EQ(std::get<TransferRequest>(script.request).to, (StoreName{StoreKind::session, 5}));
}

TEST(RequestTable, requests_of_which_scripts_see_the_kind_alone_do_not_change) {
  TableScript script;
  for (const Request& request :
       {Request(SettingsRequest{}), Request(AddPieceRequest{}), Request(WalkRequest{})}) {
    script.request = request;
    EXPECT_EQ(script.run("assert(next(sample()) == nil)"), "");
    EXPECT_NE(script.run("change{}").find("may be refused, but not changed"), std::string::npos);
  }
}

/// All names of fields, and kinds, as a list of Lua.
std::string lua_list(bool kinds) {
  std::string list = "{";
  for (const FieldTable* const table : request_field_tables()) {
    if (kinds && table->name != "part" && !table->name.starts_with("joint_"))
      list += "'" + std::string(table->name) + "',";
    if (!kinds)
      for (const FieldRow& row : table->rows) list += "'" + std::string(row.name) + "',";
  }
  return list + "}";
}

TEST(RequestTable, random_tables_are_read_or_refused) {
  TableScript script;
  const std::string kinds = lua_list(true), names = lua_list(false);
  EXPECT_EQ(script.run("local kinds, names = " + kinds + ", " + names + R"(
    local words = { "box", "capsule", "hinge", "rope", "sphere", "rock", "world", "hull", "", "cylinder",
                    string.rep("f", 64), "\0\255" }
    local values
    local function some(list) return list[math.random(#list)] end
    local function table_of(depth)
      local t = setmetatable({}, { __index = function() error("asked") end })
      for _ = 1, math.random(0, 6) do
        t[math.random(9) == 1 and math.random(4) or some(names)] = values(depth + 1)
      end
      return t
    end
    function values(depth)
      local which = math.random(depth > 4 and 8 or 11)
      if which == 1 then return math.random(-3, 5000) end
      if which == 2 then return (math.random() - 0.5) * 10 ^ math.random(-5, 40) end
      if which == 3 then return some({ 0/0, 1/0, -1/0, math.maxinteger, math.mininteger, 2^53 }) end
      if which == 4 then return some(words) end
      if which == 5 then return math.random(2) == 1 end
      if which == 6 then return vec(math.random(), math.random(), math.random()) end
      if which == 7 then return { math.random(9), math.random(9), math.random(9) } end
      if which == 8 then return some({ print, 7, {}, { {} } }) end
      return table_of(depth)
    end
    read_count = 0
    for i = 1, 20000 do
      local kind = some(kinds)
      local t = table_of(0)
      if i % 2 == 0 then t.at = vec(0, 0, 0) t.radius = 1 end
      local done, words = pcall(read, kind, t)
      if done then
        read_count = read_count + 1
        local again = sample()
        change(again)
      else
        assert(type(words) == "string")
      end
    end
    assert(read_count > 100, read_count)
  )"),
            "");
}

TEST(RequestTable, every_field_of_the_reference_says_what_it_is) {
  for (const FieldTable* const table : request_field_tables()) {
    EXPECT_FALSE(table->what.empty()) << table->name;
    for (const FieldRow& row : table->rows) {
      EXPECT_FALSE(row.what.empty()) << table->name << "." << row.name;
      EXPECT_FALSE(row.type.empty()) << table->name << "." << row.name;
    }
  }
}

}  // namespace
}  // namespace scree
