// The bodies of `bench run bodies` in another engine, in one thread: NAME SCENE TICKS.
//
// SCENE is the JSON that bench/peers/body_engines.h writes. Prints one line of JSON: the milliseconds of each tick,
// the version, how many bodies are awake after the last one, and how many have fallen through the ground.
import { readFileSync } from 'node:fs';

const [name, scenePath, ticks] = process.argv.slice(2);
const scene = JSON.parse(readFileSync(scenePath, 'utf8'));
const tickSeconds = 1 / 60;
// Where their modules are installed.
const modules = `${process.env.SCREE_BENCH_MODULES}/node_modules`;
const versionOf = (module) => JSON.parse(readFileSync(`${modules}/${module}/package.json`, 'utf8')).version;

async function jolt() {
  const { default: start } = await import(`${modules}/jolt-physics/dist/jolt-physics.wasm-compat.js`);
  const Jolt = await start();
  const settings = new Jolt.JoltSettings();
  const [fixed, moving] = [0, 1];
  const pairs = new Jolt.ObjectLayerPairFilterTable(2);
  pairs.EnableCollision(fixed, moving);
  pairs.EnableCollision(moving, moving);
  const layers = new Jolt.BroadPhaseLayerInterfaceTable(2, 2);
  layers.MapObjectToBroadPhaseLayer(fixed, new Jolt.BroadPhaseLayer(0));
  layers.MapObjectToBroadPhaseLayer(moving, new Jolt.BroadPhaseLayer(1));
  settings.mObjectLayerPairFilter = pairs;
  settings.mBroadPhaseLayerInterface = layers;
  settings.mObjectVsBroadPhaseLayerFilter = new Jolt.ObjectVsBroadPhaseLayerFilterTable(layers, 2, pairs, 2);
  settings.mMaxBodies = 4096;
  // The scratch memory of these bindings has 10 MiB, which these leave room in.
  settings.mMaxBodyPairs = 16384;
  settings.mMaxContactConstraints = 12288;
  settings.mMaxWorkerThreads = 0;
  const world = new Jolt.JoltInterface(settings);
  const system = world.GetPhysicsSystem();
  system.SetGravity(new Jolt.Vec3(0, -scene.gravity, 0));
  const bodies = system.GetBodyInterface();

  const { side, step, low, heights } = scene.ground;
  const field = new Jolt.HeightFieldShapeSettings();
  field.mOffset = new Jolt.Vec3(low, 0, low);
  field.mScale = new Jolt.Vec3(step, 1, step);
  field.mSampleCount = side;
  field.mHeightSamples.resize(side * side);
  const at = Jolt.getPointer(field.mHeightSamples.data()) >> 2;
  Jolt.HEAPF32.set(heights, at);
  const noTurn = new Jolt.Quat(0, 0, 0, 1);
  const ground = new Jolt.BodyCreationSettings(
    field.Create().Get(), new Jolt.RVec3(0, 0, 0), noTurn, Jolt.EMotionType_Static, fixed);
  ground.mFriction = scene.friction;
  bodies.AddBody(bodies.CreateBody(ground).GetID(), Jolt.EActivation_DontActivate);

  const shapeOf = (body) => {
    if (body.kind === 'box') return new Jolt.BoxShape(new Jolt.Vec3(...body.half), 0.02);
    if (body.kind === 'capsule') return new Jolt.CapsuleShape(body.half[1], body.half[0]);
    const hull = new Jolt.ConvexHullShapeSettings();
    hull.mMaxConvexRadius = 0.02;
    for (let i = 0; i < body.corners.length; i += 3)
      hull.mPoints.push_back(new Jolt.Vec3(body.corners[i], body.corners[i + 1], body.corners[i + 2]));
    const made = hull.Create();
    if (made.HasError()) throw new Error(made.GetError().c_str());
    return made.Get();
  };
  const all = [];
  for (const body of scene.bodies) {
    const made = new Jolt.BodyCreationSettings(
      shapeOf(body), new Jolt.RVec3(...body.place), new Jolt.Quat(...body.turn), Jolt.EMotionType_Dynamic, moving);
    made.mOverrideMassProperties = Jolt.EOverrideMassProperties_CalculateInertia;
    made.mMassPropertiesOverride.mMass = body.mass;
    made.mFriction = body.friction;
    made.mRestitution = body.restitution;
    made.mLinearVelocity = new Jolt.Vec3(...body.velocity);
    made.mAngularVelocity = new Jolt.Vec3(...body.spin);
    const one = bodies.CreateBody(made);
    bodies.AddBody(one.GetID(), Jolt.EActivation_Activate);
    all.push(one);
  }
  system.OptimizeBroadPhase();
  return {
    version: versionOf('jolt-physics'),
    step: () => world.Step(tickSeconds, 1),
    awake: () => system.GetNumActiveBodies(Jolt.EBodyType_RigidBody),
    heights: () => all.map((body) => body.GetPosition().GetY()),
  };
}

async function rapier() {
  const { default: Rapier } = await import(`${modules}/@dimforge/rapier3d-compat/dist/rapier.mjs`);
  await Rapier.init();
  const world = new Rapier.World({ x: 0, y: -scene.gravity, z: 0 });
  world.timestep = tickSeconds;
  const { side, step, low, heights } = scene.ground;
  // Rapier's columns go along x, and its field lies about its middle.
  const columns = new Float32Array(side * side);
  for (let z = 0; z < side; ++z) for (let x = 0; x < side; ++x) columns[x * side + z] = heights[z * side + x];
  const width = step * (side - 1);
  const middle = low + width / 2;
  world.createCollider(
    Rapier.ColliderDesc.heightfield(side - 1, side - 1, columns, { x: width, y: 1, z: width })
      .setTranslation(middle, 0, middle).setFriction(scene.friction));

  const shapeOf = (body) => {
    if (body.kind === 'box') return Rapier.ColliderDesc.cuboid(...body.half);
    if (body.kind === 'capsule') return Rapier.ColliderDesc.capsule(body.half[1], body.half[0]);
    return Rapier.ColliderDesc.convexHull(new Float32Array(body.corners));
  };
  const made = scene.bodies.map((body) => {
    const [x, y, z, w] = body.turn;
    const rigid = world.createRigidBody(
      Rapier.RigidBodyDesc.dynamic().setTranslation(...body.place).setRotation({ x, y, z, w })
        .setLinvel(...body.velocity).setAngvel({ x: body.spin[0], y: body.spin[1], z: body.spin[2] }));
    world.createCollider(
      shapeOf(body).setMass(body.mass).setFriction(body.friction).setRestitution(body.restitution), rigid);
    return rigid;
  });
  return {
    version: versionOf('@dimforge/rapier3d-compat'),
    step: () => world.step(),
    awake: () => made.filter((body) => !body.isSleeping()).length,
    heights: () => made.map((body) => body.worldCom().y),
  };
}

const engine = await { jolt, rapier }[name]();
const ticksMs = [];
for (let tick = 0; tick < Number(ticks); ++tick) {
  const begin = performance.now();
  engine.step();
  ticksMs.push(Math.round((performance.now() - begin) * 1000) / 1000);
}
const through = engine.heights().filter((y) => y < scene.ground.lowest - 1).length;
console.log(JSON.stringify({ version: engine.version, awake: engine.awake(), through, ticksMs }));
process.exit(0);
