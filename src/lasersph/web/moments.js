/** Times in a train of pulses, said by the pulse that they follow. */

const AT = 1 - 1e-12; // of the time at which a pulse begins: at it, but for rounding

/** Number of the pulse that a time follows, from 1, and the time since its start [s]. */
export function pulseAt(time, starts) {
  const number = Math.max(1, starts.filter((start) => start * AT <= time).length);
  return [number, Math.max(0, time - starts[number - 1])];
}

/** A time in words, "57 ns"; where pulses of a train have starts "pulse 5 + 57 ns". `told(value, unit)` gives the words of a quantity. */
export function moment(time, starts, told) {
  if (!starts.length) return told(time, "s");
  const [number, since] = pulseAt(time, starts);
  return `pulse ${number} + ${told(since, "s")}`;
}

/** How much of a run is done, 0 to 1: of a train as many pulses, each as long as the last one, since pauses take no time. */
export function partDone({ time_s: time, end_s: end, pulses: starts }) {
  if (!starts.length) return end ? Math.min(1, time / end) : 0;
  const [number, since] = pulseAt(time, starts);
  return (number - 1 + Math.min(1, since / (end - starts.at(-1)))) / starts.length;
}
