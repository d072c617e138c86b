// Sound by sound.wasm (client/web/sound_module.cpp). As a module of an AudioWorklet it sounds on the browser's own thread;
// a page without such a thread takes Synth from here.

/** How often the page is told how loud it was, in blocks of the browser's: 85 ms. */
const TOLD_QUANTA = 32;

export class Synth {
  #events;
  #samples;
  #add;
  #render;

  constructor({ exports: { _initialize, memory, sound_events, sound_add, sound_render, sound_event_bytes } }) {
    _initialize();
    this.#events = new Uint8Array(memory.buffer, sound_events());
    this.#samples = new Float32Array(memory.buffer, sound_render(0));
    this.#add = (bytes) => sound_add(bytes / sound_event_bytes());
    this.#render = sound_render;
  }

  /** Bytes of scree_sounds(). */
  add(events) {
    this.#events.set(events);
    this.#add(events.length);
  }

  /** The next samples of both sides; gives the greatest. */
  render(left, right) {
    let most = 0;
    this.#render(left.length);
    for (let i = 0; i < left.length; ++i) {
      left[i] = this.#samples[2 * i];
      right[i] = this.#samples[2 * i + 1];
      most = Math.max(most, Math.abs(left[i]), Math.abs(right[i]));
    }
    return most;
  }
}

if (globalThis.registerProcessor)
  registerProcessor('scree-sound', class extends AudioWorkletProcessor {
    #synth;
    #most = 0;
    #quanta = 0;

    constructor({ processorOptions: { wasm } }) {
      super();
      this.#synth = new Synth(new WebAssembly.Instance(new WebAssembly.Module(wasm)));
      this.port.onmessage = ({ data }) => this.#synth.add(data);
    }

    process(_, [[left, right]]) {
      this.#most = Math.max(this.#most, this.#synth.render(left, right));
      if (++this.#quanta === TOLD_QUANTA) {
        if (this.#most > 0) this.port.postMessage(this.#most);
        this.#quanta = this.#most = 0;
      }
      return true;
    }
  });
