/** From another page to a run in the lab, which leads back to that page. */

import { useRouter } from "@tanstack/react-router";
import { useCallback } from "react";
import { fromHere } from "./fromHere";

/** To be called at the click, and what it returns with the run. */
export function useOpenInLab(): () => (run: { readonly id: string }) => void {
  const router = useRouter();
  return useCallback(() => {
    const { href, go } = fromHere(router);
    return ({ id }) => go({ to: "/r/$id", params: { id }, search: { from: href } });
  }, [router]);
}
