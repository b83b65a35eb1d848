/** What an instant's limits, terms and parts are called. */

const NAMES: Readonly<Record<string, string>> = {
  force: "force",
  deflection: "travel",
  force_change: "force change in a step",
  actuator_force: "actuator’s own force",
};

/** `rear_force_change` → `Rear force change in a step`. */
export function limitName(name: string): string {
  const [, where = "", kind = ""] = /^(front|rear)_(.*)$/.exec(name) ?? [];
  return where === "" ? name : `${where === "front" ? "Front" : "Rear"} ${NAMES[kind] ?? kind.replaceAll("_", " ")}`;
}

/** `after_horizon` → `After horizon`. */
export const termName = (name: string): string => {
  const words = name.replaceAll("_", " ");
  return words.charAt(0).toUpperCase() + words.slice(1);
};
