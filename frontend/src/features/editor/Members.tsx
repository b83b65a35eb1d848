/** Chooses the control for each member of a section. */

import { Button, Stack, Text, SegmentedControl, Group } from "@mantine/core";
import { memo, use, useId } from "react";
import { useActionButton } from "../../lab/actions";
import { DamperCurveRow } from "./DamperCurveRow";
import {
  ChoiceFieldRow,
  FieldFrame,
  FieldError,
  Help,
  ResetButton,
  SaidAbove,
  UnusedText,
  useLeaf,
  useUnused,
  type LeafState,
} from "./FieldFrame";
import { NumberFieldRow, NumberEntry, NumberSlider } from "./NumberFieldRow";
import { RoadProfileRow } from "./RoadProfileRow";
import type { ChoiceField, Member, NumberField, VectorField, DataField } from "../../scenario/schema";
import { useFromScenario, useLab } from "../../lab/context";
import { formatInput } from "../../units/format";
import classes from "./editor.module.css";
import { isChanged } from "../../scenario/differences";

const [ROUGHNESS, FUZZY] = ["/road/roughness", "/fuzzy/"];

export const Members = memo(function Members({ members }: { readonly members: readonly Member[] }) {
  const vectors = members.filter((member): member is VectorField => member.kind === "vector");
  const fields = members.filter((member) => member.kind !== "group");
  const unused = useUnused(fields.map(({ pointer }) => pointer));
  const isSaidOnce = unused !== null && fields.length > 1;
  return (
    <SaidAbove value={isSaidOnce}>
      {isSaidOnce && <UnusedText>{unused}</UnusedText>}
      {vectors.length > 0 && <WeightsMatrix vectors={vectors} />}
      {members.map((member) => (
        <MemberControl key={member.pointer} member={member} />
      ))}
    </SaidAbove>
  );
});

function MemberControl({ member }: { readonly member: Member }) {
  switch (member.kind) {
    case "group":
      return (
        <Stack gap="0.6rem" pt="0.4rem">
          <Text fz="xs" fw={600} c="dimmed">
            {member.title}
          </Text>
          <Members members={member.members} />
        </Stack>
      );
    case "vector":
      return null; // together in one table above
    case "text":
      return <RoadProfileRow field={member} />;
    case "data":
      return member.pointer.startsWith(FUZZY) ? <DataRow field={member} /> : <DamperCurveRow field={member} />;
    default:
      return <Leaf field={member} />;
  }
}

function Leaf({ field }: { readonly field: NumberField | ChoiceField }) {
  const leaf = useLeaf(field);
  if (field.kind === "choice") return <ChoiceFieldRow {...{ field, leaf }} />;
  return field.pointer === ROUGHNESS ? <RoadClassRow {...{ field, leaf }} /> : <NumberFieldRow {...{ field, leaf }} />;
}

const SMOOTH = "smooth";

function describe(roughness: number): string {
  if (roughness === 0) return "Smooth road";
  const exact = exactClass(roughness);
  const name = exact ? `Class ${exact.letter}` : `Within class ${nearestClass(roughness)?.letter ?? ""}`;
  return `${name} · Gd = ${inMillionths(roughness)}`;
}

/** Gd is written as so many 10⁻⁶ m³ in the standard's own tables. */
function inMillionths(roughness: number): string {
  return `${Number((roughness * 1e6).toPrecision(6))}×10⁻⁶ m³`;
}

/** The road's roughness: a class of ISO 8608 by its letter, its number always beside it. */
function RoadClassRow({ field, leaf }: { readonly field: NumberField; readonly leaf: LeafState }) {
  const id = useId();
  const roughness = typeof leaf.value === "number" ? leaf.value : 0;
  const roadClass = roughness === 0 ? SMOOTH : (exactClass(roughness)?.letter ?? "");
  const options = [
    { value: SMOOTH, label: "0" },
    ...ROAD_CLASSES.map(({ letter }) => ({ value: letter, label: letter })),
  ];
  return (
    <FieldFrame
      {...{ id, field, leaf }}
      paperText={typeof field.paperValue === "number" ? inMillionths(field.paperValue) : ""}
      aside={<NumberEntry id={id} field={field} leaf={leaf} />}
    >
      <SegmentedControl
        fullWidth
        mt={4}
        aria-label="Road class (ISO 8608)"
        value={roadClass}
        disabled={leaf.readOnly}
        data={options}
        onChange={(value) => leaf.commit(ROAD_CLASSES.find(({ letter }) => letter === value)?.roughness ?? 0)}
      />
      <Text size="xs" mt={4} c="dimmed">
        {describe(roughness)}
      </Text>
    </FieldFrame>
  );
}

/** Road classes of ISO 8608: mean displacement PSD at 0.1 1/m, A to H, each four times rougher than the last. */
interface RoadClass {
  readonly letter: string;
  /** Gd(n0) [m^3]. */
  readonly roughness: number;
}

const CLASS_A = 16e-6;

const ROAD_CLASSES: readonly RoadClass[] = Array.from("ABCDEFGH", (letter, index) => ({
  letter,
  roughness: Number((CLASS_A * 4 ** index).toPrecision(12)),
}));

/** The class whose mean this is, if it is one. */
function exactClass(roughness: number): RoadClass | undefined {
  return ROAD_CLASSES.find((entry) => Math.abs(entry.roughness - roughness) <= 1e-9 * entry.roughness);
}

/** The class a roughness falls into: boundaries are the geometric means of neighbours (ISO 8608, table C.1). */
function nearestClass(roughness: number): RoadClass | undefined {
  return ROAD_CLASSES.find((entry) => roughness > 0 && roughness < 2 * entry.roughness) ?? ROAD_CLASSES.at(-1);
}

/** A part of the fuzzy speed controller's rule base: whether it is the paper's, a way back to it, and one to its panel. */
function DataRow({ field }: { readonly field: DataField }) {
  const leaf = useLeaf(field);
  const name = `data-${field.pointer}`;
  const { label, ...button } = useActionButton("fuzzy");
  return (
    <FieldFrame
      id={name}
      {...{ field, leaf }}
      paperText="Table 1"
      aside={
        <Button size="compact-xs" aria-label={`${label} ${field.title}`} {...button}>
          {leaf.readOnly ? "Show" : label}
        </Button>
      }
    >
      <Text component="output" id={name} size="xs" mt={4} c="dimmed">
        {leaf.changed ? "The scenario has its own." : "As in the paper."}
      </Text>
    </FieldFrame>
  );
}

/** Long words may break, with a hyphen: the columns are narrow. */
const breakable = (title: string) => title.replace(/\p{L}{7}(?=\p{L}{5})/gu, "$&\u00AD");

function WeightsMatrix({ vectors }: { readonly vectors: readonly VectorField[] }) {
  const titles = vectors[0]?.items.map((item) => item.title) ?? [];
  return (
    <div
      style={{
        display: "grid",
        gridTemplateColumns: `3.9rem repeat(${titles.length}, minmax(0, 1fr))`,
        gap: "0.35rem",
        alignItems: "start",
      }}
    >
      <span />
      {titles.map((title) => (
        <Text span key={title} fz="xs" lh={1.2} ta="center" c="dimmed" style={{ alignSelf: "end" }}>
          {breakable(title)}
        </Text>
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
  const unused = useUnused([vector.pointer]);
  const isSaidAbove = use(SaidAbove);
  return (
    <>
      <div className={classes.rowTitle} data-changed={changed || undefined}>
        <span className={classes.label} data-unused={unused !== null || undefined}>
          {vector.title}
        </span>
        <Group gap={3} wrap="nowrap">
          <Help field={vector} />
          <ResetButton
            field={vector}
            paperText={vector.items
              .map(({ paperValue }) => (typeof paperValue === "number" ? formatInput(paperValue) : "–"))
              .join(", ")}
            changed={changed}
          />
        </Group>
      </div>
      {vector.items.map((item) => (
        <MatrixCell key={item.pointer} field={item} rowTitle={vector.title} />
      ))}
      {unused !== null && !isSaidAbove && (
        <div style={{ gridColumn: "1 / -1" }}>
          <UnusedText>{unused}</UnusedText>
        </div>
      )}
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
