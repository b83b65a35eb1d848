/** Shares a page whose address says all that it shows. */

import { ShareLink } from "./ShareLink";

interface Props {
  /** What is shown, such as `study`. */
  readonly what: string;
  readonly ready: boolean;
}

export function ShareAddress({ what, ready }: Props) {
  return (
    <ShareLink
      make={() => Promise.resolve({ url: window.location.href })}
      obstacle={ready ? null : `There is no ${what} to share yet`}
      opens={`It opens this ${what}, for anyone who reaches this server.`}
    />
  );
}
