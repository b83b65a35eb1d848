/** What the page of a sweep shows where there is none, or none yet. */

import { Anchor, Button, Skeleton } from "@mantine/core";
import { Blank } from "../shell/Blank";
import classes from "./batch.module.css";

export function NoBatch() {
  return (
    <Blank title="There is no sweep at this address" text="The address may be cut short, or the sweep was made on another server.">
      <Anchor href="/">Open the paper’s scenario</Anchor>
    </Blank>
  );
}

export function BatchFault({ message, onRetry }: { readonly message: string; readonly onRetry: () => void }) {
  return (
    <Blank title="This sweep could not be shown" text={message}>
      <Button onClick={onRetry}>Try again</Button>
    </Blank>
  );
}

export function BatchLoading() {
  return (
    <div className={classes.loading} aria-busy aria-label="Loading the sweep">
      <Skeleton height={28} width="45%" />
      <Skeleton height={96} radius={8} />
      <Skeleton height={440} radius={8} />
      <Skeleton height={320} radius={8} />
    </div>
  );
}
