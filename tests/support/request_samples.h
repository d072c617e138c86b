// Requests of every kind that scripts can write, with every field that the kind has set to something unusual.
#pragma once

#include <vector>

#include "shared/operation/request.h"

namespace scree::samples {

inline Prop odd_prop() {
  Prop prop;
  prop.parts = {
      {.kind = PropPartKind::box, .place_m = {0.1F, 0.0F, 0.0F}, .half_m = {0.5F, 0.25F, 1.0F}},
      {.kind = PropPartKind::sphere, .half_m = {0.7F, 0.5F, 0.5F}},
      {.kind = PropPartKind::capsule, .turn = {0.6F, 0.8F, 0.0F, 0.0F}, .half_m = {0.3F, 0.9F, 0.5F}},
      {.kind = PropPartKind::hull,
       .corners_m = {{0.0F, 0.0F, 0.0F}, {1.0F, 0.0F, 0.0F}, {0.0F, 1.0F, 0.0F}, {0.0F, 0.0F, 1.0F}}}};
  prop.motion = PropMotion::kinematic;
  prop.mass_kg = 12.5F;
  prop.friction = 0.3F;
  prop.restitution = 0.9F;
  prop.drag = 0.2F;
  prop.spin_drag = 0.4F;
  prop.gravity = -0.5F;
  prop.groups = 24;
  prop.meets = 0xFFFFFF0F;
  prop.material = material::ice;
  prop.model = Digest{1, 2, 250};
  prop.tag = 0xFEDCBA9876543210U;
  prop.data = {0, 255, 7};
  return prop;
}

inline std::vector<Request> joint_requests() {
  Joint hinge;
  hinge.kind = JointKind::hinge;
  hinge.a = {.body = 12, .place_m = {1.0F, 2.0F, 3.0F}, .turn = {0.6F, 0.0F, 0.8F, 0.0F}};
  hinge.b = {.body = 0, .place_m = {4.0F, 5.0F, 6.0F}};
  hinge.limits = JointLimits{-0.5F, 0.75F};
  hinge.motor = {2.0F, 300.0F};
  hinge.break_force_n = 1e4F;
  hinge.break_torque_nm = 2e4F;
  hinge.touches = true;
  Joint rope;
  rope.kind = JointKind::rope;
  rope.a = {.body = 3};
  rope.b = {.body = 4, .place_m = {0.5F, 0.0F, 0.0F}};
  rope.length_m = 7.5F;
  return {AddJointRequest{hinge}, AddJointRequest{rope}, RemoveJointRequest{99},
          SetMotorRequest{98, {-1.5F, 20.0F}}};
}

inline std::vector<Request> region_requests() {
  Region box;
  box.name = "home";
  box.centre_m = {1.0F, 2.0F, 3.0F};
  box.half_m = {4.0F, 5.0F, 6.0F};
  box.forbids = forbids::edits | forbids::pieces;
  box.editors = RegionEditors::persons;
  box.persons = {"anna", "bert"};
  box.teams = {"red"};
  box.tells = true;
  Region tower;
  tower.name = "tower";
  tower.form = RegionForm::cylinder;
  tower.half_m = {3.0F, 7.5F, 1.0F};
  tower.forbids = forbids::all;
  tower.editors = RegionEditors::role;
  tower.role = Role::director;
  tower.counts = true;
  Region ball;
  ball.name = "ball";
  ball.form = RegionForm::sphere;
  ball.half_m = {2.5F, 1.0F, 1.0F};
  return {SetRegionRequest{box, 12.5F}, SetRegionRequest{tower}, SetRegionRequest{ball},
          RemoveRegionRequest{"home"}};
}

inline std::vector<Request> edit_requests() {
  const Shape rounded{ShapeKind::box, {1.0F, 2.0F, 3.0F}, {0.5F, 1.5F, 2.5F}, 0.25F};
  return {
      CarveRequest{
          sphere({0.1F, -0.2F, 0.3F}, 1.7F), SeedPattern::radial, 9, 4000000000U, {3.0F, 2.0F, 1.0F}, 2.5F},
      CarveRequest{
          rounded, SeedPattern::authored, 2, 7, {}, 0.0F, {{1.0F, 2.0F, 3.0F}, {-1.0F, 0.5F, 0.25F}}},
      CarveRequest{.shape = capsule({0.0F, 0.0F, 0.0F}, {1.0F, 2.0F, 0.0F}, 0.5F), .piece = 33},
      FillRequest{crater({5.0F, 0.0F, 5.0F}, 2.0F), material::soil},
      FillRequest{rounded},
      PaintRequest{rounded, material::ice},
      CutOutRequest{rounded},
      BlastRequest{{1.0F, 2.0F, 3.0F}, 1.5e6F, 77},
      DigRequest{rounded, 12, {StoreKind::own}},
      DigRequest{sphere({0.0F, 0.0F, 0.0F}, 1.0F), 0, named_store("red")},
      PlaceRequest{rounded, material::soil, true, {StoreKind::token, 0x1234}},
      PlaceRequest{rounded, material::soil, false, {StoreKind::session, 5}},
      TransferRequest{worlds_store(), {StoreKind::token, 0xAB}, material::rock, 254 * 64},
      TransferRequest{{StoreKind::session, 9}, named_store("a store"), {}, 0},
  };
}

inline std::vector<Request> body_requests() {
  AddPropRequest add{
      odd_prop(), {1.0F, 2.0F, 3.0F}, {0.6F, 0.0F, 0.0F, 0.8F}, {4.0F, 5.0F, 6.0F}, {7.0F, 8.0F, 9.0F}};
  return {
      add,
      RemovePropRequest{4000000000U},
      MovePropRequest{5, glm::vec3(1.0F), glm::quat(0.0F, 1.0F, 0.0F, 0.0F), glm::vec3(2.0F),
                      glm::vec3(3.0F)},
      MovePropRequest{.prop = 6, .velocity_m_s = glm::vec3(0.0F)},
      PushRequest{7, {1.0F, -2.0F, 3.0F}, {0.0F, 0.5F, 0.0F}},
      BreakRequest{8, {1.0F, 1.0F, 1.0F}, 5, 123},
      ReleaseRequest{9},
      StandRequest{glm::vec3(1.0F, 2.0F, 3.0F)},
      StandRequest{.away = true},
  };
}

inline std::vector<Request> script_requests() {
  std::vector<Request> all;
  for (const auto& part : {edit_requests(), body_requests(), joint_requests(), region_requests()})
    all.insert(all.end(), part.begin(), part.end());
  return all;
}

}  // namespace scree::samples
