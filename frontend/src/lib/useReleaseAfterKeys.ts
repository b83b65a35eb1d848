/** The end of changes that no release of a pointer ends. */

import { useDebouncedCallback } from "@mantine/hooks";

const KEY_PAUSE_MS = 350;

/** Changes made with keys or by assistive technology: a pause ends them, and so does leaving the control. */
export const useReleaseAfterKeys = (release: () => void) =>
  useDebouncedCallback(release, { delay: KEY_PAUSE_MS, flushOnUnmount: true });
