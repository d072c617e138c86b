// A bot: carves ten times around where visitors begin, and prints the server's replies.
//   node bot.js [ws://HOST:PORT]
import { connect } from 'scree-client';

const client = await connect(process.argv[2] ?? 'ws://127.0.0.1:4177', { name: 'Bot', program: 'bot-example' });
await client.loaded();
const [x, y, z] = client.status().eye;

for (let i = 0; i < 10; ++i) {
  const angle = 2.4 * i, away = 3 * Math.sqrt(i + 1);
  const above = [x + away * Math.cos(angle), y + 40, z + away * Math.sin(angle)];
  const ground = client.cast(above, [0, -1, 0], { of: ['terrain'] });
  if (!ground) continue;
  try {
    const { tick, count } = await client.carve({ centre: ground.place, radius: 1.2, seeds: 8, randomSeed: i });
    console.log(`tick ${tick}: ${count} pieces at ${ground.place.map((metres) => metres.toFixed(1)).join(', ')}`);
  } catch (refusal) {
    console.log(`${refusal.name}: ${refusal.message}`);
  }
}
await client.close();
