/** From another page to a run in the lab: the same page to the browser, so back leads to where one was. */

import { useNavigate } from "@tanstack/react-router";
import { useCallback } from "react";

export function useOpenInLab(): (run: { readonly id: string }) => void {
  const navigate = useNavigate();
  return useCallback(({ id }) => void navigate({ to: "/r/$id", params: { id } }), [navigate]);
}
