// A gamepad of the standard mapping: its state goes to the client once a frame, which knows what its buttons do.

/** The numbers that the client takes: axes, triggers (buttons 6 and 7, from 0 to 1), and the buttons as bits. */
export function pad_state(pad) {
  const value = (index) => pad.buttons[index]?.value ?? 0;
  let buttons = 0;
  for (let i = 0; i < 17; ++i) if (pad.buttons[i]?.pressed) buttons |= 1 << i;
  return [pad.axes[0] ?? 0, pad.axes[1] ?? 0, pad.axes[2] ?? 0, pad.axes[3] ?? 0, value(6), value(7), buttons >>> 0];
}

export function step_pad(client) {
  const pads = navigator.getGamepads?.() ?? [];
  const pad = [...pads].find((one) => one?.connected && one.mapping === 'standard');
  if (pad) client.gamepad(...pad_state(pad));
  return pad !== undefined;
}
