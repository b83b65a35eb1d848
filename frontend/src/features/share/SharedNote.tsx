/** Says that this is shared, when it was computed and by what, and what can be done with it. */

import { Text } from "@mantine/core";
import type { ReactNode } from "react";
import type { Link } from "../../api/types";
import { IconLock } from "../../ui/icons";
import { formatDay } from "../../units/dates";
import classes from "./share.module.css";

export function SharedNote({
  link,
  what,
  children,
}: {
  readonly link: Link;
  readonly what: "result" | "sweep";
  readonly children?: ReactNode;
}) {
  return (
    <section className={classes.banner} aria-label="Shared result">
      <IconLock size={17} stroke={1.7} aria-hidden />
      <Text size="sm" flex="1 1 14rem">
        Shared {what}, computed on {formatDay(link.computed_at)} by core {link.core_version}. Read-only.
        {link.damaged_at !== null &&
          ` Something stored of it was found damaged on ${formatDay(link.damaged_at)} and computed again by that core: it may differ from what was shared.`}
        {link.core_version !== link.current_core_version && ` This server now runs core ${link.current_core_version}.`}
      </Text>
      {children}
    </section>
  );
}
