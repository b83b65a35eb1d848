/** Shares a page that an address says all of. */

import { ShareLink } from "./ShareLink";

interface Props {
  /** What is shown, such as `study`. */
  readonly what: string;
  readonly ready: boolean;
  /** By default the page's own. */
  readonly path?: string;
}

export function ShareAddress({ what, ready, path }: Props) {
  return (
    <ShareLink
      make={() => Promise.resolve({ url: path ?? window.location.href })}
      obstacle={ready ? null : `There is no ${what} to share yet`}
      opens={`It opens this ${what}, for anyone who reaches this server.`}
    />
  );
}
