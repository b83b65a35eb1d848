/** A way to another page that waits for an answer: whoever has left meanwhile stays where they are.
 *
 * As `onSuccess` of one `mutate` (not of `useMutation`) it is not called for a page that is gone, one come back to included. */

import type { NavigateOptions } from "@tanstack/react-router";

/** Of the browser's router what this needs. */
interface Pages {
  readonly latestLocation: { readonly href: string; readonly pathname: string };
  readonly navigate: (address: NavigateOptions) => unknown;
}

export function fromHere(pages: Pages) {
  const { href, pathname } = pages.latestLocation;
  const go = (address: NavigateOptions): void => {
    if (pages.latestLocation.pathname === pathname) void pages.navigate(address);
  };
  return { href, go };
}
