// A program in TypeScript, which is compiled and never run.
import { connect, ScreeError, type Event, type Mesh } from 'scree-client';

const client = await connect('ws://127.0.0.1:4177', { name: 'Ann', eye: { x: 0, y: 6, z: 0 }, radius: 64, smooth: true });
const { count, tick } = await client.carve({ centre: [0, 5, 0], radius: 1, seeds: 8 });
await client.fill({ shape: 'box', centre: new Float32Array(3), half: [1, 1, 1], material: 'granite' });
await client.dig({ piece: count });
const meshes: Mesh[] = client.mesher({ radius: 32 }).update([0, 6, 0]);
const triangles: number = meshes.reduce((sum, mesh) => sum + mesh.indices.length / 3, tick);
const tell = (event: Event): string => (event.kind === 'said' ? `${event.name}: ${event.text}` : event.kind);
for await (const event of client.events()) console.log(tell(event), triangles);
const same: boolean = client.status().fieldHash === client.status().serverHash;
// @ts-expect-error: a sphere has a radius
await client.carve({ centre: [0, 5, 0] });
// @ts-expect-error: there is no such shape
await client.fill({ shape: 'cone', centre: [0, 5, 0], radius: 1 });
// @ts-expect-error: a paint has a material
await client.paint({ centre: [0, 5, 0], radius: 1 });
try {
  await client.give();
} catch (error) {
  if (error instanceof ScreeError) console.log(error.name, same);
}
