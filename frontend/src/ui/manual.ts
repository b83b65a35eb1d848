/** Places in the manual; apart from what opens them, whose code comes after the first curves. */

export const MANUAL = "/manual/";
const NAMES = `${MANUAL}reference/scenario/`;
const OWN_CONTROLLERS = `${MANUAL}how-to/own-controller/`;
const RECORDINGS = `${MANUAL}tutorials/validate/`;

/** The strategies side by side. */
export const STRATEGIES = `${NAMES}#strategies`;

/** Of a field's dotted name, a signal's or an event's key, a strategy's id. What is one's own is in no list. */
export const placeOf = (name: string): string =>
  name.startsWith("own.") ? OWN_CONTROLLERS : name.startsWith("recording:") ? RECORDINGS : `${NAMES}#${name}`;
