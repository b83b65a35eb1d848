/** A value whose run opens in the lab, with short names of the fields a study varies. */

import { Button } from "@mantine/core";
import { Icon } from "../../ui/icons";
import type { ExtremeRun } from "./study";
import { type Opening, showCell, type Cell } from "../../features/sweep/table";
import type { Batch } from "../../api/types";
import { inShownUnit } from "../../scenario/limits";
import type { Group } from "../../scenario/schema";
import { useForm } from "../../server/useCatalogues";
import { sweepFields } from "../../scenario/fields";

interface Props {
  readonly run: ExtremeRun | null;
  readonly text: string;
  /** Which value it is, in words. */
  readonly what: string;
  readonly opening: Opening;
}

export function RunButton({ run, text, what, opening }: Props) {
  const fieldText = useFieldText();
  if (run === null) return <>–</>;
  const fields = Object.entries(run.at).map(([name, value]) => `${nameOf(name)} ${fieldText(name, value)}`);
  return (
    <Button
      data-hint={`Open run ${run.run} in the lab: ${fields.join(", ")}`}
      size="compact-xs"
      variant="subtle"
      px="0.3rem"
      fw={500}
      loading={opening.opening?.run === run.run}
      rightSection={<Icon name="ExternalLink" size={13} />}
      aria-label={`${what} ${text}: open run ${run.run} in the lab`}
      onClick={() => opening.open(run)}
    >
      {text}
    </Button>
  );
}

const NAMES: Readonly<Record<string, string>> = {
  "mismatch.body_mass": "body mass",
  "mismatch.springs": "springs",
  "mismatch.damping": "damping",
  "mismatch.tyres": "tyres",
  "mismatch.preview_offset": "preview offset",
  "mismatch.preview_gain": "preview gain",
  "mismatch.preview_noise": "preview noise",
  "mismatch.preview_delay": "preview delay",
  "actuator.bandwidth": "actuator bandwidth",
  "actuator.saturation": "saturation",
  "road.seed": "road",
};

/** Any other field by its title where it is known, else by the end of its dotted name. */
export const nameOf = (field: string, fields: Batch["fields"] = []): string =>
  NAMES[field] ?? fields.find(({ name }) => name === field)?.title ?? field.replace(/^.*\./, "").replace(/_/g, " ");

/** A field's value in the unit the form shows it in. */
export function fieldText(form: Group | undefined, name: string, value: Cell): string {
  const leaf = form && sweepFields(form).find((each) => each.name === name)?.leaf;
  return leaf?.kind === "number" && typeof value === "number"
    ? showCell(inShownUnit(leaf, value), leaf.shown.unit)
    : showCell(value);
}

export function useFieldText(): (name: string, value: Cell) => string {
  const form = useForm();
  return (name, value) => fieldText(form, name, value);
}
