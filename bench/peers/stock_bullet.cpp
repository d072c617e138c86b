#include "bench/peers/stock_bullet.h"

#include <algorithm>
#include <btBulletDynamicsCommon.h>

#include "server/colliders/terrain_mesh.h"
#include "shared/base/check.h"

namespace scree::peers {

namespace {

constexpr float step_s = 1.0F / 60.0F;
constexpr float gravity_m_s2 = 9.81F;
/// The values of rubble and of the ground, like ours (BodiesConfig): materials are no matter of solver or
/// sleeping.
constexpr float restitution = 0.05F;
constexpr float ground_friction = 0.7F;

btVector3 vector_of(glm::vec3 v) {
  return {v.x, v.y, v.z};
}

struct Body {
  std::unique_ptr<btConvexHullShape> shape;
  std::unique_ptr<btRigidBody> body;
};

struct Ground {
  std::unique_ptr<btTriangleMesh> mesh;
  std::unique_ptr<btBvhTriangleMeshShape> shape;
  std::unique_ptr<btRigidBody> body;
};

Ground ground_of(const Field& field, const VoxelBox& box) {
  const float dx = field.source().voxel_size_m;
  Ground ground;
  ground.mesh = std::make_unique<btTriangleMesh>();
  TerrainMesh terrain(field);
  for (const TerrainTriangle& triangle : terrain.near(box)) {
    const auto& [a, b, c] = triangle.corners;
    ground.mesh->addTriangle(vector_of(a * dx), vector_of(b * dx), vector_of(c * dx));
  }
  ground.shape = std::make_unique<btBvhTriangleMeshShape>(ground.mesh.get(), true);
  ground.body = std::make_unique<btRigidBody>(0.0F, nullptr, ground.shape.get());
  ground.body->setFriction(ground_friction);
  ground.body->setRestitution(restitution);
  return ground;
}

}  // namespace

struct StockBullet::State {
  btDefaultCollisionConfiguration configuration;
  btCollisionDispatcher dispatcher{&configuration};
  btDbvtBroadphase broadphase;
  btSequentialImpulseConstraintSolver solver;
  Ground ground;
  std::vector<Body> bodies;
  btDiscreteDynamicsWorld world{&dispatcher, &broadphase, &solver, &configuration};
};

StockBullet::StockBullet(const Field& field, const VoxelBox& box) : state_(std::make_unique<State>()) {
  state_->world.setGravity({0.0F, -gravity_m_s2, 0.0F});
  state_->ground = ground_of(field, box);
  state_->world.addRigidBody(state_->ground.body.get());
}

StockBullet::~StockBullet() {
  for (const Body& each : state_->bodies) state_->world.removeRigidBody(each.body.get());
  state_->world.removeRigidBody(state_->ground.body.get());
}

void StockBullet::rebuild_ground(const Field& field, const VoxelBox& box) {
  Ground fresh = ground_of(field, box);
  state_->world.removeRigidBody(state_->ground.body.get());
  state_->ground = std::move(fresh);
  state_->world.addRigidBody(state_->ground.body.get());
}

size_t StockBullet::triangles() const {
  return static_cast<size_t>(state_->ground.mesh->getNumTriangles());
}

void StockBullet::add(const StockPiece& piece) {
  CHECK(piece.hull_m.size() >= 4 && piece.mass_kg > 0.0F);
  Body made;
  made.shape = std::make_unique<btConvexHullShape>();
  for (const glm::vec3& corner : piece.hull_m) made.shape->addPoint(vector_of(corner), false);
  made.shape->recalcLocalAabb();
  btVector3 inertia;
  made.shape->calculateLocalInertia(piece.mass_kg, inertia);
  made.body = std::make_unique<btRigidBody>(piece.mass_kg, nullptr, made.shape.get(), inertia);
  const glm::quat& q = piece.pose.rotation;
  made.body->setWorldTransform(
      btTransform(btQuaternion(q.x, q.y, q.z, q.w), vector_of(piece.pose.position_m)));
  made.body->setLinearVelocity(vector_of(piece.velocity_m_s));
  made.body->setAngularVelocity(vector_of(piece.spin_rad_s));
  made.body->setFriction(piece.friction);
  made.body->setRestitution(restitution);
  state_->world.addRigidBody(made.body.get());
  state_->bodies.push_back(std::move(made));
}

void StockBullet::step() {
  state_->world.stepSimulation(step_s, 0);
}

size_t StockBullet::awake() const {
  return static_cast<size_t>(
      std::ranges::count_if(state_->bodies, [](const Body& each) { return each.body->isActive(); }));
}

size_t StockBullet::below(float height_m) const {
  return static_cast<size_t>(std::ranges::count_if(state_->bodies, [&](const Body& each) {
    return each.body->getWorldTransform().getOrigin().y() < height_m;
  }));
}

std::string StockBullet::version() {
  return std::to_string(btGetVersion() / 100) + "." + std::to_string(btGetVersion() % 100);
}

}  // namespace scree::peers
