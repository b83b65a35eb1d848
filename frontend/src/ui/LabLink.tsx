/** To a run in the lab; without one to the lab as it was left. */

import { Anchor, type MantineSize } from "@mantine/core";
import { Link } from "@tanstack/react-router";
import type { ReactNode } from "react";

interface Props {
  readonly run?: string | undefined;
  readonly size?: MantineSize;
  readonly children: ReactNode;
}

export function LabLink({ run, size = "xs", children }: Props) {
  return (
    <Anchor
      {...{ size }}
      underline="always"
      renderRoot={(props) =>
        run === undefined ? <Link to="/" {...props} /> : <Link to="/r/$id" params={{ id: run }} {...props} />
      }
    >
      {children}
    </Anchor>
  );
}
