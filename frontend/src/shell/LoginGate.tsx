/** The page, or what asks for a token where the service wants one. */

import { lazy, type ReactNode } from "react";
import { tokenWanted } from "../api/connection";
import { useStore } from "../state/store";

const Login = lazy(async () => ({ default: (await import("./Login")).Login }));

export function LoginGate({ children }: { readonly children: ReactNode }) {
  return useStore(tokenWanted) ? <Login /> : children;
}
