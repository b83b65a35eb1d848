/** The page, or what asks for a token where the service wants one. */

import { lazy, useSyncExternalStore, type ReactNode } from "react";
import { login } from "../api/login";

const Login = lazy(async () => ({ default: (await import("./Login")).Login }));

export function LoginGate({ children }: { readonly children: ReactNode }) {
  return useSyncExternalStore(login.subscribe, login.wanted) ? <Login /> : children;
}
