/** Whether this browser's user still has to be asked for the tour. */

import { createAtom } from "@tanstack/react-store";
import { readStored, writeStored } from "../../lib/storage";

const NAME = "ridelab.tour";

/** Until it was taken or refused once. */
export const tourOffered = createAtom(readStored(NAME) !== true);

export function endOffer(): void {
  writeStored(NAME, true);
  tourOffered.set(false);
}
