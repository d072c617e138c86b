// What pieces do, to be heard. Loaded with the first gesture (main.js), and sound.wasm with it. Where there is no
// AudioWorklet, as in pages by plain http from another machine, the page's own thread makes the samples, ahead.
import { keep, load } from './kept.js';

const RATE_HZ = 48000;  // the synthesiser's
/** The most that browsers look back upon, 0.7 s: longer than a slow frame. */
const METER_FRAMES = 32768;
/** Without a worklet: how far ahead samples are made, longer than a frame of most machines; in how large pieces; and how often. */
const AHEAD_S = 0.25, PIECE_FRAMES = 1024, AHEAD_MS = 40;

async function fetch_sound() {
  const answer = await fetch(new URL('sound.wasm', import.meta.url));
  if (!answer.ok) throw new Error(`the server has no sound.wasm (${answer.status})`);
  return answer.arrayBuffer();
}

/** What takes events, on the browser's thread of sound. */
async function by_worklet(context, wasm, out) {
  await context.audioWorklet.addModule(new URL('sound_worklet.js', import.meta.url));
  const node = new AudioWorkletNode(context, 'scree-sound',
    { numberOfInputs: 0, outputChannelCount: [2], processorOptions: { wasm } });
  node.connect(out);
  return (events) => node.port.postMessage(events);
}

/** The same on the page's own. */
async function by_page(context, wasm, out) {
  const { Synth } = await import('./sound_worklet.js');
  const { instance } = await WebAssembly.instantiate(wasm);
  const synth = new Synth(instance);
  let until_s = 0;
  setInterval(() => {
    if (context.state !== 'running') return;
    for (until_s = Math.max(until_s, context.currentTime); until_s < context.currentTime + AHEAD_S; until_s += PIECE_FRAMES / RATE_HZ) {
      const buffer = context.createBuffer(2, PIECE_FRAMES, RATE_HZ);
      synth.render(buffer.getChannelData(0), buffer.getChannelData(1));
      const source = new AudioBufferSourceNode(context, { buffer });
      source.connect(out);
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
  #meter = null;
  #add = null;

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

  /** The greatest of the last METER_FRAMES; −1: it does not play. For a browser's console, and for tests. */
  peak() {
    if (this.#context?.state !== 'running' || !this.#add) return -1;
    const samples = new Float32Array(this.#meter.fftSize);
    this.#meter.getFloatTimeDomainData(samples);
    return samples.reduce((most, sample) => Math.max(most, Math.abs(sample)), 0);
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
    this.#meter = new AnalyserNode(context, { fftSize: METER_FRAMES });
    this.#meter.connect(context.destination);
    try {
      const wasm = await fetch_sound();
      this.#add = await (context.audioWorklet ? by_worklet : by_page)(context, wasm, this.#meter);
    } catch (error) {
      this.#say(`There is no sound: ${error.message}.`);
    }
  }
}
