/** The axis of time of a chart. Pauses between pulses that were jumped over are cut out of it. */

import { fittingUnit, number } from "./dom.js";

const GAP = 0.06; // left for a pause, of the mean length of what is computed between two
const PARTS = 5; // into which marks divide an axis, about
const CLOSEST = 0.6; // of such a part: from one mark to the next, at least
const NARROW = 1.3; // of such a part: a pulse that follows another by less is marked by its number alone

/**
 * Where times of some runs stand on one axis: end to end, with a small gap for each pause that all of them jumped over.
 *
 * runs: [{history, pulses}], pulses: when those of a train begin [s]. end: of the axis where nothing is cut out [s].
 */
export class TimeAxis {
  unit = "s";

  constructor(runs, end) {
    this.runs = runs;
    this.end = end;
    const [longest] = [...runs].sort((one, other) => other.pulses.length - one.pulses.length);
    const isAlike = runs.every(({ pulses }) => pulses.every((start, k) => start === longest.pulses[k]));
    this.pulses = isAlike ? longest.pulses : []; // of trains with different periods no pulse has a place
    if (runs.some(({ pulses }) => pulses.length)) this.marks = this.marksOfPulses;
    this.update();
  }

  /** Follow histories that have grown. */
  update() {
    const spans = this.runs.flatMap(({ history }) => history.spans()).sort(([one], [other]) => one - other);
    this.pieces = [];
    for (const [first, last] of spans) {
      const before = this.pieces.at(-1);
      if (before && first <= before.last) before.last = Math.max(before.last, last);
      else this.pieces.push({ first, last });
    }
    if (this.pieces.length) this.pieces[0].first = 0; // before the first step
    const gap = (GAP * this.pieces.reduce((sum, { first, last }) => sum + last - first, 0)) / this.pieces.length;
    let place = 0;
    for (const piece of this.pieces) {
      piece.place = place;
      place += piece.last - piece.first + gap;
    }
  }

  get isCut() {
    return this.pieces.length > 1;
  }

  get words() {
    return this.isCut ? "time without the pauses between pulses" : "time";
  }

  /** First and last place; of a train as far as it is computed, since its first pulse is a stroke beside the pauses to come. */
  ends() {
    const last = this.pieces.at(-1)?.last;
    return [0, last > 0 && (this.isCut || this.pulses.length > 1) ? this.placeOf(last) : this.end];
  }

  placeOf(time) {
    const { first, place } = this.pieces.findLast((piece) => piece.first <= time) ?? { first: 0, place: 0 };
    return place + time - first;
  }

  /** Places of the rows of a history, and its columns; a row without values in each pause leaves the line open there. */
  cut(history, columns) {
    const times = history.columns.time_s ?? [], places = times.map((time) => this.placeOf(time));
    const gaps = new Set(history.pauses);
    const opened = (values, between) => values.flatMap((value, row) => (gaps.has(row) ? [between(row), value] : [value]));
    return [opened(places, (row) => (places[row - 1] + places[row]) / 2), ...columns.map((values) => opened(values, () => null))];
  }

  /** Marks between two places as [place, words], by the pulse that they follow. */
  marksOfPulses(low, high) {
    const isTrain = this.pulses.length > 0;
    const starts = isTrain ? this.pulses.filter((start) => this.pieces.some(({ first, last }) => first <= start && start <= last)) : this.pieces.map(({ first }) => first);
    const anchors = starts.map((start, k) => [this.placeOf(start), isTrain ? `pulse ${k + 1}` : quantityOf(start)]);
    const rough = (high - low) / PARTS, ten = 10 ** Math.floor(Math.log10(rough)), step = ten * [1, 2, 5, 10].find((one) => one * ten >= rough * 0.999);
    const [name, size] = fittingUnit(step, "s");
    const found = [];
    for (const [k, [place, words]] of anchors.entries()) {
      const next = anchors[k + 1]?.[0] ?? high + step;
      const since = place - found.findLast((one) => one.isPulse)?.place;
      if (place >= low && place <= high && !(since < CLOSEST * step)) found.push({ place, words: isTrain && since < NARROW * step ? `${k + 1}` : words, isPulse: true });
      for (let since = step; place + since < next - CLOSEST * step; since += step)
        if (place + since >= low && place + since <= high) found.push({ place: place + since, words: `+${number(since / size)} ${name}` });
    }
    return found.map(({ place, words }) => [place, words]);
  }
}

function quantityOf(time) {
  const [name, size] = fittingUnit(time, "s");
  return `${number(time / size)} ${name}`;
}
