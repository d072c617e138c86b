// The picture of this moment as a PNG, without panels. Called right after a frame was drawn, in its task: later the
// browser has cleared the canvas.

export function picture_name(now = new Date()) {
  return `scree-${now.toISOString().slice(0, 19).replaceAll(':', '-')}.png`;
}

/** Calls back with what was done, in words. */
export function save_picture(canvas, done) {
  canvas.toBlob((blob) => {
    if (!blob) return done('The browser made no picture.');
    const link = document.createElement('a');
    link.href = URL.createObjectURL(blob);
    link.download = picture_name();
    link.click();
    setTimeout(() => URL.revokeObjectURL(link.href), 10000);
    done(`Saved ${link.download}.`);
  });
}
