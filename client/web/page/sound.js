// What pieces do, to be heard. Loaded with the first gesture (main.js), and sound.wasm with it. Where there is no
// AudioWorklet, as in pages by plain http from another machine, the page's own thread makes the samples, ahead.
import { keep, load } from './kept.js';

const RATE_HZ = 48000;  // the synthesiser's
/** Without a worklet: how far ahead samples are made, longer than a frame of most machines; in how large pieces; and how often. */
const AHEAD_S = 0.25, PIECE_FRAMES = 1024, AHEAD_MS = 40;

async function fetch_sound() {
  const answer = await fetch(new URL('sound.wasm', import.meta.url));
  if (!answer.ok) throw new Error(`the server has no sound.wasm (${answer.status})`);
  return answer.arrayBuffer();
}

/** What takes events, on the browser's thread of sound. `sounds(most)`: is told the greatest samples. */
async function by_worklet(context, wasm, sounds) {
  await context.audioWorklet.addModule(new URL('sound_worklet.js', import.meta.url));
  const node = new AudioWorkletNode(context, 'scree-sound',
    { numberOfInputs: 0, outputChannelCount: [2], processorOptions: { wasm } });
  node.port.onmessage = ({ data }) => sounds(data);
  node.connect(context.destination);
  return (events) => node.port.postMessage(events);
}

/** The same on the page's own. */
async function by_page(context, wasm, sounds) {
  const { Synth } = await import('./sound_worklet.js');
  const { instance } = await WebAssembly.instantiate(wasm);
  const synth = new Synth(instance);
  let until_s = 0;
  setInterval(() => {
    if (context.state !== 'running') return;
    for (until_s = Math.max(until_s, context.currentTime); until_s < context.currentTime + AHEAD_S; until_s += PIECE_FRAMES / RATE_HZ) {
      const buffer = context.createBuffer(2, PIECE_FRAMES, RATE_HZ);
      sounds(synth.render(buffer.getChannelData(0), buffer.getChannelData(1)));
      const source = new AudioBufferSourceNode(context, { buffer });
      source.connect(context.destination);
      source.start(until_s);
    }
  }, AHEAD_MS);
  return (events) => synth.add(events);
}

export class Sound {
  #client;
  #say;
  #on = load().sound !== false;
  #context = null;
  #add = null;
  #most = 0;

  /** In the wake of a gesture. `say(text)`: as Notices.say(). */
  constructor(client, say) {
    this.#client = client;
    this.#say = say;
    for (const gesture of ['pointerdown', 'pointerup', 'keydown'])
      addEventListener(gesture, () => this.#play(), { passive: true });
    this.#play();
  }

  get on() { return this.#on; }

  /** Once a frame. */
  step() {
    if (!this.#add || !this.#on) return;
    const events = this.#client.take_sounds();
    if (events) this.#add(events);
  }

  toggle() {
    this.#on = !this.#on;
    keep({ sound: this.#on });
    this.#say(this.#on ? 'Sound on.' : 'Sound off; 6 turns it on.');
    if (this.#on) this.#play();
    else this.#context?.suspend();
  }

  /** The greatest sample since the last call; −1: it does not play. For a browser's console, and for tests. */
  peak() {
    if (this.#context?.state !== 'running' || !this.#add) return -1;
    const most = this.#most;
    this.#most = 0;
    return most;
  }

  /** Some browsers let a page play in a gesture alone, so the next one tries again. */
  async #play() {
    if (!this.#on || !globalThis.AudioContext) return;
    if (this.#context) {
      if (this.#context.state === 'suspended') await this.#context.resume();
      return;
    }
    const context = new AudioContext({ sampleRate: RATE_HZ });
    this.#context = context;
    try {
      const wasm = await fetch_sound();
      const sounds = (most) => { this.#most = Math.max(this.#most, most); };
      this.#add = await (context.audioWorklet ? by_worklet : by_page)(context, wasm, sounds);
    } catch (error) {
      this.#say(`There is no sound: ${error.message}.`);
    }
  }
}
