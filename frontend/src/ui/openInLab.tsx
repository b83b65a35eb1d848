/** From another page to a run in the lab, which leads back to that page. */

import { useMutation } from "@tanstack/react-query";
import { useRouter, type NavigateOptions, Link } from "@tanstack/react-router";
import { useCallback, type ReactNode } from "react";
import { explain } from "../api/problem";
import { Anchor, type MantineSize } from "@mantine/core";

interface Run {
  readonly id: string;
}

/** To be called at the click, and what it returns with the run. */
export function useOpenInLab(): () => (run: Run) => void {
  const router = useRouter();
  return useCallback(() => {
    const { href, go } = navigateIfStillHere(router);
    return ({ id }) => go({ to: "/r/$id", params: { id }, search: { from: href } });
  }, [router]);
}

export interface RunInLab<What> {
  readonly open: (what: What) => void;
  /** What is being run. */
  readonly opening: What | null;
  readonly error: string | null;
}

/** Runs something first; one thing at a time. */
export function useRunInLab<What>(run: (what: What) => Promise<Run>): RunInLab<What> {
  const openInLab = useOpenInLab();
  const { mutate, isPending, variables, error } = useMutation({ mutationFn: run });
  return {
    open: (what) => {
      if (!isPending) mutate(what, { onSuccess: openInLab() });
    },
    opening: isPending ? variables : null,
    error: error && explain(error),
  };
}

/** Of the browser's router what this needs. */
interface Pages {
  readonly latestLocation: { readonly href: string; readonly pathname: string };
  readonly navigate: (address: NavigateOptions) => unknown;
}

/** A way to another page that waits for an answer: whoever has left meanwhile stays where they are.
 *
 * As `onSuccess` of one `mutate` (not of `useMutation`) it is not called for a page that is gone, one come back to included. */
export function navigateIfStillHere(pages: Pages) {
  const { href, pathname } = pages.latestLocation;
  const go = (address: NavigateOptions): void => {
    if (pages.latestLocation.pathname === pathname) void pages.navigate(address);
  };
  return { href, go };
}

interface Props {
  readonly run?: string | undefined;
  readonly size?: MantineSize;
  readonly children: ReactNode;
}

/** To a run in the lab; without one to the lab as it was left. */
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
