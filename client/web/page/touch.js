// Fingers on the picture, and the buttons for thumbs.
import { $ } from './dom.js';
import { STICK, Thumbs } from './gestures.js';

export class Touch {
  #client;
  #thumbs = new Thumbs();
  #up = 0;
  #moves = false;
  #tapped;

  constructor(canvas, client, tapped) {
    this.#client = client;
    this.#tapped = tapped;
    const of_touch = (act) => (event) => {
      if (event.pointerType !== 'touch') return;
      event.preventDefault();
      act(event);
    };
    canvas.addEventListener('pointerdown', of_touch((event) => {
      this.show();
      canvas.setPointerCapture(event.pointerId);
      this.#thumbs.down(event.pointerId, event.clientX, event.clientY, canvas.clientWidth, event.timeStamp);
    }));
    canvas.addEventListener('pointermove', of_touch((event) =>
      this.#thumbs.move(event.pointerId, event.clientX, event.clientY)));
    for (const end of ['pointerup', 'pointercancel'])
      canvas.addEventListener(end, of_touch((event) => {
        if (this.#thumbs.up(event.pointerId, event.timeStamp) && end === 'pointerup') this.#tapped();
      }));
    // As the finger comes down: browsers make no click of a long press, nor of a second finger.
    $('strike').addEventListener('pointerdown', (event) => {
      if (event.button !== 0) return;
      client.strike();
      client.hold(true);
    });
    for (const end of ['pointerup', 'pointercancel', 'lostpointercapture'])
      $('strike').addEventListener(end, () => client.hold(false));
    // A click without a pointer: by the keyboard, or by what reads the page aloud.
    $('strike').addEventListener('click', (event) => { if (event.detail === 0) client.strike(); });
    for (const [id, way] of [['up', 1], ['down', -1]]) {
      $(id).addEventListener('pointerdown', (event) => {
        $(id).setPointerCapture(event.pointerId);
        this.#up = way;
      });
      for (const end of ['pointerup', 'pointercancel', 'lostpointercapture'])
        $(id).addEventListener(end, () => { this.#up = 0; });
    }
    if (matchMedia('(pointer: coarse)').matches) this.show();
  }

  show() {
    $('thumbs').hidden = false;
    document.body.dataset.touch = '';
  }

  /** Once a frame. */
  step() {
    const stick = this.#thumbs.stick();
    const moves = stick !== null || this.#up !== 0;
    if (moves || this.#moves) this.#client.move(stick?.right ?? 0, this.#up, stick?.forward ?? 0, stick?.fast ?? false);
    this.#moves = moves;
    const look = this.#thumbs.take_look();
    if (look.right || look.down) this.#client.look(look.right, look.down);
    this.#draw(stick);
  }

  /** The stick stands where the thumb came down, and in its corner otherwise. */
  #draw(stick) {
    const rim = $('stick');
    if (!stick) {
      if (rim.style.transform) rim.style.transform = rim.firstChild.style.transform = '';
      delete rim.dataset.fast;
      return;
    }
    rim.style.transform = '';
    const box = rim.getBoundingClientRect();
    rim.style.transform = `translate(${stick.x - box.left - box.width / 2}px, ${stick.y - box.top - box.height / 2}px)`;
    const part = Math.min(STICK.full / Math.max(Math.hypot(stick.dx, stick.dy), 1), 1);
    rim.firstChild.style.transform = `translate(${stick.dx * part}px, ${stick.dy * part}px)`;
    rim.toggleAttribute('data-fast', stick.fast);
  }
}
