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
import {
  type ChoiceField,
  type Member,
  type NumberField,
  type VectorField,
  type DataField,
  type TextField,
} from "../../scenario/schema";
import { useFromScenario, useLab, useEdit } from "../../lab/context";
import { formatInput, formatNumber } from "../../units/format";
import classes from "./editor.module.css";
import { isChanged } from "../../scenario/differences";
import { useQuery } from "@tanstack/react-query";
import { address } from "../../api/http";
import { useOpenItem } from "../library/open";
import { OpenFiles } from "../library/OpenFiles";
import { ProfileSketch } from "../library/ProfileSketch";
import { useItems } from "../../scenario/library";
import { roadQuery } from "../../server/queries";
import { getAt, setAt } from "../../scenario/path";
import { onBump } from "../../scenario/withItem";
import { type MeasuredRoad } from "../../api/types";
import { Caution } from "../../ui/Messages";
import { Choice } from "../../ui/Entry";

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

/** A measured road in place of a made one: of the library, or opened from a file; drawn, with the bump that counts; and saved as a file. */
const NONE = { value: "", label: "None" };
const FORMATS = [
  { format: "csv", name: "CSV" },
  { format: "crg", name: "OpenCRG" },
] as const;

function RoadProfileRow({ field }: { readonly field: TextField }) {
  const leaf = useLeaf(field);
  const edit = useEdit();
  const openItem = useOpenItem();
  const own = useItems("road");
  const id = typeof leaf.value === "string" ? leaf.value : "";
  const road = useQuery(roadQuery(id)).data;
  const bumps = road?.bumps ?? [];
  const labels = bumps.map(
    ({ start, width, height }) => `${(1000 * height).toFixed(0)} mm at ${start} m over ${width} m`,
  );
  const place = useFromScenario((scenario) => getAt(scenario, "/road/bump/start"));
  const counting = bumps.findIndex(({ start }) => Math.max(1, start) === place);
  const saved = own.flatMap(({ name, value }) =>
    typeof value.id === "string" ? [{ value: value.id, label: name }] : [],
  );
  const name = `profile-${field.pointer}`;

  const choose = (value: string) => {
    const item = own.find((each) => each.value.id === value);
    if (item) openItem(item);
    else if (value === "") edit.commit(setAt(edit.newest(), field.pointer, null));
  };

  return (
    <FieldFrame
      id={name}
      {...{ field, leaf }}
      paperText="none"
      aside={
        <>
          {road &&
            FORMATS.map(({ format, name: called }) => (
              <Button
                key={format}
                component="a"
                size="compact-xs"
                href={address("/roads/{id}", { path: { id }, query: { format } })}
                download={`ridelab-road-${id}.${format}`}
              >
                Save {called}
              </Button>
            ))}
          {!leaf.readOnly && <OpenFiles name="Road file">Open file</OpenFiles>}
        </>
      }
    >
      {(own.length > 0 || id !== "") && (
        <Choice
          id={name}
          value={id}
          disabled={leaf.readOnly}
          data={[
            NONE,
            ...(id === "" || saved.some(({ value }) => value === id)
              ? []
              : [{ value: id, label: "A measured road, not in the library" }]),
            ...(saved.length > 0 ? [{ group: "Your measured roads", items: saved }] : []),
          ]}
          onPick={choose}
        />
      )}
      {road && (
        <>
          <ProfileSketch
            label="The road that is driven"
            distance={road.distance}
            tracks={[road.height]}
            marks={bumps.map((bump, index) => ({ ...bump, counts: index === counting }))}
          />
          <Text size="xs" mt={4} c="dimmed">
            {road.length} m measured, in place of roughness and seed.{" "}
            {labels.length > 0 ? `Bumps in it: ${labels.join(", ")}.` : "No bump was found in it."}
          </Text>
          {road.cautions.map(({ kind, text }) => (
            <Caution key={kind} text={text} />
          ))}
          {bumps.length > 1 && (
            <Choice
              label="Bump that counts"
              description="The car brakes for it, and the stages and windows go by it."
              value={counting}
              disabled={leaf.readOnly}
              data={[
                ...(counting < 0 ? [{ value: "-1", label: "None of them" }] : []),
                ...labels.map((label, index) => ({ value: String(index), label })),
              ]}
              onPick={(value) => {
                const bump = bumps[Number(value)];
                if (bump) edit.commit(onBump(edit.newest(), road.length, bump));
              }}
            />
          )}
          {indicesText(road) !== null && (
            <Text size="xs" mt={4} c="dimmed">
              {indicesText(road)}
            </Text>
          )}
        </>
      )}
    </FieldFrame>
  );
}

type Analysis = Pick<MeasuredRoad, "iri" | "iso_class" | "roughness" | "waviness">;

const range = ({ low, high }: { readonly low: number; readonly high: number }, scale = 1) =>
  `${formatNumber(scale * low)} to ${formatNumber(scale * high)}`;

/** `null` where nothing is known of it. */
function indicesText({ iri, iso_class, roughness, waviness }: Analysis): string | null {
  if (!iri) return null;
  const [left, right] = iri.tracks.map((each) => formatNumber(each));
  const index = `IRI ${formatNumber(iri.mean)} m/km${right === undefined ? "" : ` (left ${left}, right ${right})`}.`;
  if (!iso_class || !roughness || !waviness) return index;
  const rough = `${formatNumber(1e6 * roughness.value)} (${range(roughness, 1e6)}) × 10⁻⁶ m³`;
  return `${index} ISO 8608 class ${iso_class}: roughness ${rough}, waviness ${formatNumber(waviness.value)} (${range(waviness)}); 95 % intervals in brackets.`;
}
