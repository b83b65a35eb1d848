/** The token that a service may want, which it keeps in a cookie so that event streams and downloads send it along. */

import { queryOptions } from "@tanstack/react-query";
import { BASE, get, remove, send, sending } from "./http";

export const login = {
  /** Whose token the cookie stands for. */
  query: queryOptions({
    queryKey: ["login"],
    queryFn: ({ signal }) => get<{ readonly required: boolean; readonly name: string | null }>("/login", signal),
    staleTime: Infinity,
  }),
  logIn: (token: string) => send(`${BASE}/login`, sending("POST", { token })),
  logOut: () => remove("/login"),
};
