// What scripts ask the world, and ask it for: rows of server/rules/api.
#include <gtest/gtest.h>

#include "server/rules/api.h"
#include "tests/support/rules_world.h"

namespace scree {
namespace {

/// Runs a text in on.start(), and so many ticks more. Empty: nothing failed.
std::string faults_of(const std::string& text, int ticks = 3) {
  RulesWorld game("on.start(function()\n" + text + "\nend)");
  game.join("anna");
  game.steps(ticks);
  return game.rules->faults() == 0 ? "" : game.all_logged();
}

TEST(WorldApi, every_example_runs) {
  for (const std::span<const ApiFunction> part : {world_api(), body_api(), region_api()})
    for (const ApiFunction& row : part)
      EXPECT_EQ(faults_of(std::string(row.example)), "") << row.table << "." << row.name;
}

TEST(WorldApi, examples_of_handles_run_with_bodies_there) {
  constexpr const char* before =
      "bodies.add({ box = vec(0.5, 0.5, 0.5), at = vec(0, 3, 0), mass = 20, tag = 7 }, function(a)\n"
      "  bodies.add({ sphere = 0.4, at = vec(0, 4.5, 0) }, function(b)\n"
      "    joints.add{ kind = 'hinge', a = a.body, b = b.body, at = vec(0, 4, 0), motor = { speed = 1, "
      "greatest = 5 } }\n"
      "  end)\n"
      "end)\n"
      "world.carve{ at = vec(5, 0, 5), radius = 1.5 }\n"
      "after(0.2, function()\n  assert(#bodies.all() > 3 and #joints.all() == 1)\n";
  for (const ApiFunction& row : body_api())
    EXPECT_EQ(faults_of(before + std::string(row.example) + "\nend)", 20), "")
        << row.table << "." << row.name;
}

TEST(WorldApi, a_carve_is_carried_out_for_the_person_that_it_names) {
  RulesWorld game(R"(
    on.join(function(e)
      world.carve({ at = vec(0, 0, 0), radius = 1.5, pieces = 8, by = e.person }, function(reply)
        log("carved " .. tostring(reply.pieces > 0) .. " " .. bodies.all()[1]:owner():name())
        log("of nobody " .. tostring(bodies.all()[1]:person()))
      end)
    end))");
  game.join("anna");
  game.steps(3);
  EXPECT_TRUE(game.has_logged("carved true anna")) << game.all_logged();
  EXPECT_TRUE(game.has_logged("of nobody nil")) << game.all_logged();
}

TEST(WorldApi, questions_about_space_see_terrain_and_bodies) {
  EXPECT_EQ(faults_of(R"(
    bodies.add{ box = vec(1, 1, 1), at = vec(0, 10, 0), motion = "fixed" }
    after(0.1, function()
      local hit = world.ray(vec(0, 20, 0), vec(0, -3, 0))
      assert(hit.kind == "prop" and math.abs(hit.at.y - 11) < 0.01 and hit.normal.y > 0.99)
      assert(hit.body == bodies.all()[1] and hit.material == nil and not hit.inside)
      assert(world.ray(vec(0, 20, 0), vec(0, -1, 0), 5) == nil)
      local below = world.ray(vec(0, 20, 0), vec(0, -1, 0), 50, { except = { hit.body } })
      assert(below.kind == "terrain" and below.material == world.material(vec(0, -0.5, 0)))
      assert(world.ray(vec(0, 20, 0), vec(0, -1, 0), 50, { props = false }).kind == "terrain")
      assert(world.sphere_cast(vec(0, 20, 0), vec(0, -1, 0), 0.5, 20).distance < 9)
      local around = world.overlap_sphere(vec(0, 10, 0), 2)
      assert(not around.terrain and #around.bodies == 1)
      assert(world.solid(vec(0, 10, 0)) and not world.solid(vec(0, 10, 0), { props = false }))
      assert(world.nearest(vec(0, 12, 0)).kind == "prop")
      assert(math.abs(world.ground(0, 0)) < 0.2)
      world.fill{ shape = "box", at = vec(30, 5, 0), half = vec(1, 7, 1), material = "rock" }
      world.carve{ at = vec(40, 0, 0), radius = 2, pieces = 1 }
      after(0.1, function()
        assert(math.abs(world.ground(30, 0) - 12) < 0.2 and world.ground(40, 0) < -1)
      end)
    end)
  )",
                      12),
            "");
}

TEST(WorldApi, the_mass_of_a_box_is_that_of_its_rock) {
  EXPECT_EQ(faults_of(R"(
    local by_material, all = world.mass_in(vec(4, 3, 4), vec(0, -3, 0))
    local sum = 0
    for _, volume in pairs(by_material) do sum = sum + volume end
    assert(math.abs(all - 48) < 3 and math.abs(sum - all) < 0.01, all)
    local done, words = pcall(world.mass_in, vec(-100, -100, -100), vec(100, 100, 100))
    assert(not done and words:find("16", 1, true), words)
  )"),
            "");
}

TEST(WorldApi, a_prefab_stands_where_and_how_it_was_put) {
  EXPECT_EQ(faults_of(R"(
    local wall = {
      { shape = "box", at = vec(10, 2, 0), half = vec(10, 2, 0.5), material = "rock" },
      { at = vec(5, 4.5, 0), radius = 1, material = "ice" },
    }
    assert(world.build(wall, { at = vec(30, 0, 0) }) == 3)
    world.build(wall, { at = vec(-30, 0, 0), turn = 1 }, function(reply) log(tostring(reply.done)) end)
    after(0.5, function()
      for x = 31, 49, 3 do assert(world.solid(vec(x, 3, 0)), x) end
      assert(world.material(vec(35, 5, 0)) == "ice" and not world.solid(vec(40, 3, 2)))
      for z = 1, 19, 3 do assert(world.solid(vec(-30, 3, -z)), z) end
    end)
  )",
                      40),
            "");
  EXPECT_NE(faults_of("world.build{ { shape = 'box', at = vec(0, 0, 0), half = vec(200, 200, 200) } }")
                .find("256 fills at most"),
            std::string::npos);
}

TEST(WorldApi, settings_are_read_and_changed_by_name) {
  EXPECT_EQ(faults_of(R"(
    assert(world.setting("pieces-max") == world.setting("pieces_max") and world.setting("islands") == true)
    world.set{ air_drag = 7, dents = false }
    after(0.1, function() assert(world.setting("air_drag") == 7 and world.setting("dents") == false) end)
  )",
                      12),
            "");
  EXPECT_NE(faults_of("world.set{ air_dragg = 7 }").find("there is no setting 'air-dragg'"),
            std::string::npos);
  EXPECT_NE(faults_of("world.set{ air_drag = 7000 }").find("air-drag is 0 to"), std::string::npos);
}

TEST(WorldApi, bodies_tell_how_they_move_and_are_moved) {
  EXPECT_EQ(faults_of(R"(
    bodies.add({ sphere = 0.5, at = vec(0, 50, 0), mass = 10, tag = 3, velocity = vec(4, 0, 0) }, function(reply)
      local ball = reply.body
      assert(ball:kind() == "prop" and math.abs(ball:mass() - 10) < 0.01 and ball:tag() == 3)
      assert(math.abs(ball:velocity().x - 4) < 0.1 and ball:volume() == nil and ball:owner() == nil)
      assert(#bodies.near(vec(0, 50, 0), 2) == 1 and #bodies.near(vec(0, 0, 0), 2) == 0)
      assert(bodies.get(ball:number()) == ball)
      assert(ball:push(vec(0, 0, 50)))
      after(0.1, function()
        assert(math.abs(ball:velocity().z - 5) < 0.2)
        assert(ball:move{ at = vec(9, 60, 9), velocity = vec(0, 0, 0), turn = { degrees = 90 } })
        after(0.1, function()
          assert(ball:place():distance(vec(9, 60, 9)) < 1 and math.abs(ball:turn().w - math.sqrt(0.5)) < 0.05)
          assert(ball:remove())
          after(0.1, function()
            assert(not ball:exists() and ball:place() == nil and ball:push(vec(0, 1, 0)) == false)
            log("done")
          end)
        end)
      end)
    end)
  )",
                      40),
            "");
}

TEST(WorldApi, pieces_shatter_and_kept_ones_are_released) {
  EXPECT_EQ(faults_of(R"(
    world.cut_out({ shape = "box", at = vec(0, 0, 0), half = vec(1, 1, 1) }, function(reply)
      local block = reply.body
      assert(block:kind() == "piece" and block:kept() and block:volume() > 3)
      assert(block:release() and block:shatter{ pieces = 6 })
      after(0.2, function()
        assert(not block:exists() and #bodies.all() > 2)
        for _, piece in ipairs(bodies.all()) do assert(not piece:kept()) end
      end)
    end)
  )",
                      30),
            "");
}

TEST(WorldApi, regions_are_set_asked_for_and_counted) {
  EXPECT_EQ(faults_of(R"(
    regions.set{ name = "pit", at = vec(0, 0, 0), half = vec(5, 5, 5), counts = true, tells = true, lasts = 100 }
    regions.set{ name = "tower", form = "cylinder", at = vec(0, 0, 0), radius = 2, height = 6, forbid = { "edits" },
                 editors = "persons", teams = { "red" } }
    local anna = persons.named("anna")
    after(0.1, function()
      assert(#regions.all() == 2 and #regions.at(vec(0, 0, 0)) == 2 and #regions.at(vec(4, 0, 0)) == 1)
      local tower = regions.get("tower")
      assert(tower.height == 6 and tower.forbid[1] == "edits" and tower.teams[1] == "red" and tower.lasts == 0)
      assert(regions.get("pit").lasts > 99)
      world.carve{ at = vec(3, 0, 3), radius = 1, by = anna }
      after(0.1, function()
        local cut = 0
        for _, row in ipairs(regions.masses("pit")) do
          assert(row.by == anna and math.abs(row.cut - row.pieces - row.dust - row.back - row.away) < 1e-6)
          cut = cut + row.cut
        end
        assert(cut > 1, cut)
        regions.remove("pit")
        after(0.1, function() assert(regions.get("pit") == nil and not pcall(regions.masses, "pit")) end)
      end)
    end)
  )",
                      40),
            "");
}

TEST(WorldApi, the_ledger_and_the_stores_have_what_was_dug_and_poured) {
  EXPECT_EQ(faults_of(R"(
    world.fill{ at = vec(0, 5, 0), radius = 1, material = "rock" }
    world.dig({ shape = "box", at = vec(20, -3, 0), half = vec(1, 1, 1), store = "red" }, function(reply)
      local by_material, dug = stores.of("red")
      assert(reply.done and math.abs(reply.volume - dug) < 1e-6 and dug > 6)
      local rows, all = world.ledger()
      assert(math.abs(all.stored - dug) < 1e-6 and all.poured > 3)
      assert(math.abs(all.terrain + all.pieces + all.dust + all.stored - all.poured) < 1e-6)
      assert(rows.rock.poured > 3)
      world.transfer{ from = "red", to = persons.named("anna") }
      after(0.1, function()
        local _, left = stores.of("red")
        local _, carried = stores.of(persons.named("anna"))
        assert(left == 0 and math.abs(carried - dug) < 1e-6)
      end)
    end)
  )",
                      30),
            "");
}

TEST(WorldApi, each_type_of_a_table_is_explained_and_no_name_comes_twice) {
  std::vector<std::string_view> names;
  for (const ApiType& type : api_types()) {
    EXPECT_FALSE(type.what.empty()) << type.name;
    EXPECT_EQ(std::ranges::count(names, type.name), 0) << type.name;
    names.push_back(type.name);
  }
}

}  // namespace
}  // namespace scree
