/** To a run in the lab; without one to the lab as it was left. */

import { Anchor } from "@mantine/core";
import { Link } from "@tanstack/react-router";
import type { ReactNode } from "react";

export function LabLink({ run, children }: { readonly run: string | undefined; readonly children: ReactNode }) {
  return (
    <Anchor size="xs" underline="always" renderRoot={(props) => (run === undefined ? <Link to="/" {...props} /> : <Link to="/r/$id" params={{ id: run }} {...props} />)}>
      {children}
    </Anchor>
  );
}
