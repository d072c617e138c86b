// The mouse: the first click takes it and strikes nothing. Where a browser does not give it away, dragging looks around,
// and a click strikes.
import { TAP } from './gestures.js';

const NOTCH_PIXELS = 100;

export class Mouse {
  #canvas;
  #client;
  #refused = false;  // the browser keeps the mouse
  #drag = null;
  #changed;

  constructor(canvas, client, changed) {
    this.#canvas = canvas;
    this.#client = client;
    this.#changed = changed;
    canvas.addEventListener('pointerdown', (event) => this.#down(event));
    canvas.addEventListener('pointermove', (event) => this.#move(event));
    canvas.addEventListener('pointerup', (event) => this.#up(event));
    canvas.addEventListener('pointercancel', () => client.hold(false));
    canvas.addEventListener('wheel', (event) => this.#wheel(event), { passive: false });
    canvas.addEventListener('contextmenu', (event) => event.preventDefault());
    document.addEventListener('pointerlockchange', () => {
      client.hold(false);
      changed(this.taken);
    });
    document.addEventListener('pointerlockerror', () => this.#refuse());
  }

  get taken() { return document.pointerLockElement === this.#canvas; }

  async take() {
    if (this.#refused || !this.#canvas.requestPointerLock) return this.#refuse();
    try {
      await this.#canvas.requestPointerLock();
    } catch (error) {
      // Chromium lets a page take it again only a second after Esc: that is no refusal for good.
      if (error.name !== 'SecurityError') this.#refuse();
    }
  }

  free() { document.exitPointerLock?.(); }

  #refuse() {
    this.#refused = true;
    this.#changed(false);
  }

  #down(event) {
    if (event.pointerType === 'touch') return;
    this.#canvas.focus({ preventScroll: true });
    if (this.taken) {
      if (event.button !== 0) return;
      this.#client.strike();
      this.#client.hold(true);
    } else if (this.#refused) {
      this.#drag = { far: 0, x: event.clientX, y: event.clientY };
      this.#canvas.setPointerCapture(event.pointerId);
    } else if (event.button === 0) {
      this.take();
    }
  }

  #move(event) {
    if (event.pointerType === 'touch') return;
    if (this.taken) return this.#client.look(event.movementX, event.movementY);
    if (!this.#drag) return;
    const right = event.clientX - this.#drag.x, down = event.clientY - this.#drag.y;
    this.#drag = { far: this.#drag.far + Math.hypot(right, down), x: event.clientX, y: event.clientY };
    this.#client.look(right, down);
  }

  #up(event) {
    if (event.pointerType !== 'touch' && event.button === 0) this.#client.hold(false);
    if (!this.#drag || event.pointerType === 'touch') return;
    if (this.#drag.far <= TAP.pixels && event.button === 0) this.#client.strike();
    this.#drag = null;
  }

  #wheel(event) {
    event.preventDefault();
    const pixels = event.deltaMode === 0 ? event.deltaY : event.deltaY * NOTCH_PIXELS / 3;
    this.#client.grow(Math.max(-5, Math.min(5, -pixels / NOTCH_PIXELS)));
  }
}
