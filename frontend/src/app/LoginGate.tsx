/** The page, or what asks for a token where the service wants one. */

import { lazy, type ReactNode } from "react";
import { tokenWanted } from "../api/connection";
import { useStore } from "../lib/store";
import { LazyPart } from "../ui/LazyPart";

const Login = lazy(async () => ({ default: (await import("./Login")).Login }));

export function LoginGate({ children }: { readonly children: ReactNode }) {
  if (!useStore(tokenWanted)) {
    return children;
  }
  return (
    <LazyPart>
      <Login />
    </LazyPart>
  );
}
