/** A part of the page whose code is fetched when it is wanted. */

import { CatchBoundary } from "@tanstack/react-router";
import { lazy, Suspense, type ReactNode } from "react";
import { firstCurves } from "../lib/firstCurves";

interface Props {
  /** What stands in its place until it is there, and where it fails. */
  readonly fallback?: ReactNode;
  /** Takes it away again; without it the page cannot be used until it is there. */
  readonly onClose?: (() => void) | undefined;
  readonly children: ReactNode;
}

// Fetched ahead: where another part's code is missing, so would be its own.
const partFailed = firstCurves.then(() => import("./PartFailed"));
const PartFailed = lazy(async () => ({ default: (await partFailed).PartFailed }));

/** Where its code is missing (after an update of the server) or it fails, a dialog says so and the rest of the page stays. */
export function LazyPart({ fallback = null, onClose, children }: Props) {
  return (
    <CatchBoundary
      getResetKey={() => "part"}
      errorComponent={({ reset }) => (
        <>
          {fallback}
          <Suspense>
            <PartFailed
              onClose={
                onClose &&
                (() => {
                  reset();
                  onClose();
                })
              }
            />
          </Suspense>
        </>
      )}
    >
      <Suspense fallback={fallback}>{children}</Suspense>
    </CatchBoundary>
  );
}
