/** The lab and the address, for components. */

import { useQuery } from "@tanstack/react-query";
import { createContext, use, useMemo, type ReactNode } from "react";
import type { Scenario } from "../api/types";
import type { View } from "./address";
import type { Lab, LabState } from "./labState";
import type { LabAddress } from "./labAddress";
import { createAtom, useSelector, type ReadonlyAtom } from "@tanstack/react-store";
import { paperScenarioOf } from "../scenario/differences";
import { schemaQuery } from "../server/queries";

interface LabContextValue {
  readonly lab: Lab;
  readonly labAddress: LabAddress;
  /** The paper's scenario, as the schema states it: what is edited until a run has been opened. */
  readonly paperScenario: Scenario;
  /** The scenario as the form shows it: under a moving slider, else the last one set. */
  readonly scenario: ReadonlyAtom<Scenario>;
  /** What a closed tab came back with. */
  readonly restored: Scenario | null;
}

const LabContext = createContext<LabContextValue | null>(null);

interface LabContextProviderProps {
  readonly value: Omit<LabContextValue, "paperScenario" | "scenario">;
  readonly children: ReactNode;
}

export function LabContextProvider({ value, children }: LabContextProviderProps) {
  // Fetched by the pages that need it.
  const form = useQuery({ ...schemaQuery, enabled: false }).data;
  const context = useMemo(() => {
    const paperScenario = form ? paperScenarioOf(form) : {};
    const scenario = createAtom(() => {
      const { drag, history } = value.lab.get();
      return drag ?? history?.present ?? paperScenario;
    });
    return { ...value, paperScenario, scenario };
  }, [value, form]);
  return <LabContext value={context}>{children}</LabContext>;
}

export function useLabContext(): LabContextValue {
  const value = use(LabContext);
  if (value === null) throw new Error("useLabContext needs a LabContextProvider above it");
  return value;
}

export function useLab<Part>(select: (state: LabState) => Part): Part {
  return useSelector(useLabContext().lab, select);
}

export function useView(): View {
  return useSelector(useLabContext().labAddress, (address) => address.view);
}

/** Nothing can be edited: the page shows a shared result. */
export function useReadOnly(): boolean {
  return useLab((state) => state.shared !== null);
}

export function useScenario(): Scenario {
  return useSelector(useLabContext().scenario);
}

/** One stable piece of the edited scenario: the component renders anew only when that piece changes. */
export function useFromScenario<Part>(select: (scenario: Scenario) => Part): Part {
  return useSelector(useLabContext().scenario, select);
}

/** How a field changes the scenario, always from its newest state. */
export function useEdit() {
  const { lab, scenario } = useLabContext();
  return {
    newest: (): Scenario => scenario.get(),
    drag: lab.drag,
    commit: lab.commit,
    reject: lab.reject,
    clearInvalid: lab.clearInvalid,
  };
}
