/** From another page to a run in the lab, which leads back to that page. */

import { useRouter } from "@tanstack/react-router";
import { useCallback } from "react";

export function useOpenInLab(): (run: { readonly id: string }) => void {
  const router = useRouter();
  return useCallback(({ id }) => void router.navigate({ to: "/r/$id", params: { id }, search: { from: router.latestLocation.href } }), [router]);
}
