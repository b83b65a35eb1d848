/** Vectors of equal make as a table: a row each, a column per entry, every entry with its own slider. */

import { Group } from "@mantine/core";
import { useId } from "react";
import { useFromScenario, useLab } from "../../lab/context";
import { formatInput } from "../../units/format";
import classes from "./editor.module.css";
import { isChanged } from "../../scenario/differences";
import { FieldError, Help, ResetButton } from "./FieldFrame";
import { NumberEntry, NumberSlider } from "./NumberFieldRow";
import type { NumberField, VectorField } from "../../scenario/schema";
import { useLeaf } from "./useLeaf";

/** Long words may break, with a hyphen: the columns are narrow. */
const breakable = (title: string) => title.replace(/\p{L}{9}(?=\p{L}{5})/gu, "$&\u00AD");

export function WeightsMatrix({ vectors }: { readonly vectors: readonly VectorField[] }) {
  const titles = vectors[0]?.items.map((item) => item.title) ?? [];
  return (
    <div className={classes.matrix} style={{ "--columns": titles.length } as React.CSSProperties}>
      <span />
      {titles.map((title) => (
        <span key={title} className={classes.columnTitle}>
          {breakable(title)}
        </span>
      ))}
      {vectors.map((vector) => (
        <MatrixRow key={vector.pointer} vector={vector} />
      ))}
    </div>
  );
}

function MatrixRow({ vector }: { readonly vector: VectorField }) {
  const id = useId();
  const refused = useLab((state) => state.serverErrors.fields);
  const rejected = useLab((state) => state.invalidInput);
  const changed = useFromScenario((scenario) => vector.items.some((item) => isChanged(scenario, item)));
  const wrong = vector.items.find((item) => rejected[item.pointer] ?? refused[item.pointer]);
  const message = wrong && (rejected[wrong.pointer]?.message ?? refused[wrong.pointer]);
  return (
    <>
      <div className={classes.rowTitle} data-changed={changed || undefined}>
        <span className={classes.label}>{vector.title}</span>
        <Group gap={3} wrap="nowrap">
          <Help field={vector} />
          <ResetButton
            field={vector}
            standard={vector.items
              .map(({ paperValue }) => (typeof paperValue === "number" ? formatInput(paperValue) : "–"))
              .join(", ")}
            changed={changed}
          />
        </Group>
      </div>
      {vector.items.map((item) => (
        <MatrixCell key={item.pointer} field={item} rowTitle={vector.title} />
      ))}
      {wrong && (
        <div style={{ gridColumn: "1 / -1" }}>
          <FieldError id={`${id}-row`} error={`${wrong.title}: ${message ?? ""}`} />
        </div>
      )}
    </>
  );
}

function MatrixCell({ field, rowTitle }: { readonly field: NumberField; readonly rowTitle: string }) {
  const id = useId();
  const leaf = useLeaf(field);
  const label = `${rowTitle}, ${field.title}`;
  return (
    <div className={classes.cell} data-changed={leaf.changed || undefined}>
      <NumberEntry id={id} field={field} leaf={leaf} label={`${label}, value`} withUnit={false} />
      <NumberSlider field={field} leaf={leaf} label={label} />
    </div>
  );
}
