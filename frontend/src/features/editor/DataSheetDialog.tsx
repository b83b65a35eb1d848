/** A whole car's data sheet, typed in: what becomes of it as a half-car, before it is the scenario's vehicle. */

import { Box, Button, Group as Row, Modal, Stack, Text } from "@mantine/core";
import { useDebouncedValue } from "@mantine/hooks";
import { keepPreviousData, queryOptions, useQuery } from "@tanstack/react-query";
import { createAtom, useSelector } from "@tanstack/react-store";
import { useMemo } from "react";
import { ask } from "../../api/http";
import { ApiProblem } from "../../api/problem";
import type { DataSheet, HalfCarAnswer, JsonObject } from "../../api/types";
import { useEdit, useFromScenario } from "../../lab/context";
import { useForm } from "../../server/useCatalogues";
import { completed, leavesOf } from "../../scenario/differences";
import { parseTyped, typedText, valueText } from "../../scenario/limits";
import { getAt, sameValue, setAt, type Pointer } from "../../scenario/path";
import { findMember, type Group, type NumberField } from "../../scenario/schema";
import { Caution, Fault } from "../../ui/Messages";
import { DataTable } from "../../ui/DataTable";
import { Entry } from "../../ui/Entry";
import { formatExact } from "../../units/format";
import { submits } from "../../ui/ListEntry";
import { CharacteristicsTable } from "./CharacteristicsTable";
import classes from "./editor.module.css";

const VEHICLE = "/vehicle";
/** Of what becomes of the car: whole on a laptop, its heads in sight on a phone. */
const TABLE_HEIGHT = "min(26rem, 50dvh)";
/** A number that is being typed is not asked about at each digit [ms]. */
const TYPED_MS = 300;

/** Front and rear side by side. */
const PAIRS = { display: "grid", gridTemplateColumns: "repeat(auto-fit, minmax(15rem, 1fr))", gap: "0.5rem 1rem" };

/** What is typed, by field; it stays while the page does. */
const typed = createAtom<Readonly<Record<Pointer, string>>>({});

const halfCarQuery = (sheet: Sheet | null) =>
  queryOptions({
    queryKey: ["half-car", sheet],
    queryFn: ({ signal }) => ask("post", "/vehicles/from-data-sheet", { body: sheet as unknown as DataSheet }, signal),
    enabled: sheet !== null,
    placeholderData: keepPreviousData,
    staleTime: Infinity,
  });

export function DataSheetDialog({ onClose }: { readonly onClose: () => void }) {
  const { dataSheet } = useForm();
  const fields = useMemo(() => leavesOf(dataSheet).filter((leaf) => leaf.kind === "number"), [dataSheet]);
  const texts = useSelector(typed);
  const { sheet, wrong } = readSheet(fields, texts);
  const [asked] = useDebouncedValue(sheet === null ? null : JSON.stringify(sheet), TYPED_MS);
  const answer = useQuery(halfCarQuery(asked === null ? null : (JSON.parse(asked) as Sheet)));
  const refused = answer.error instanceof ApiProblem ? answer.error.errors : [];
  const isNewest = sheet !== null && asked === JSON.stringify(sheet) && !answer.isPlaceholderData;
  const errorOf = ({ pointer }: NumberField) =>
    wrong[pointer] ?? (isNewest ? refused.find((each) => each.pointer === pointer)?.message : undefined);
  const edit = useEdit();
  const half = isNewest && answer.data && !answer.error ? answer.data : null;
  const vehicle = useVehicleOf(half);
  const apply = () => {
    if (vehicle === undefined) return;
    if (!sameValue(vehicle, getAt(edit.newest(), VEHICLE))) edit.commit(setAt(edit.newest(), VEHICLE, vehicle));
    onClose();
  };
  return (
    <Modal opened onClose={onClose} title="A whole car’s data sheet" size="xl">
      <form onSubmit={submits(apply)}>
        <Box style={PAIRS}>
          {fields.map((field) => (
            <Entry
              key={field.pointer}
              label={field.title}
              description={field.description}
              required={isRequired(field)}
              unit={field.shown.unit}
              value={texts[field.pointer] ?? defaultText(field)}
              error={errorOf(field)}
              autoComplete="off"
              inputWrapperOrder={["label", "description", "input", "error"]}
              styles={{ root: { display: "flex", flexDirection: "column", justifyContent: "space-between" } }}
              onType={(text) => typed.set({ ...texts, [field.pointer]: text })}
            />
          ))}
        </Box>
        {answer.error && refused.length === 0 && <Fault mt="xs">{answer.error.message}</Fault>}
        {half && sheet && vehicle !== undefined ? (
          <Outcome half={half} vehicle={vehicle as JsonObject} total={totalOf(sheet)} />
        ) : (
          <Text size="sm" c="dimmed" mt="md">
            Filled in, it shows here what becomes of it: one track of the car, with its sag and frequencies.
          </Text>
        )}
        <Row justify="end" gap="xs" mt="md">
          <Button variant="default" onClick={onClose}>
            Cancel
          </Button>
          <Button variant="filled" type="submit" disabled={half === null}>
            Take it as the vehicle
          </Button>
        </Row>
      </form>
    </Modal>
  );
}

type Sheet = Readonly<Record<string, number>>;

const isRequired = ({ nullable, paperValue }: NumberField) => !nullable && paperValue === null;

const defaultText = (field: NumberField) =>
  typeof field.paperValue === "number" ? typedText(field, field.paperValue) : "";

/** The values, where all that are needed are there and right; and what is wrong with those that were typed. */
export function readSheet(
  fields: readonly NumberField[],
  texts: Readonly<Record<Pointer, string>>,
): { readonly sheet: Sheet | null; readonly wrong: Readonly<Record<Pointer, string>> } {
  const sheet: Record<string, number> = {};
  const wrong: Record<Pointer, string> = {};
  let isWhole = true;
  for (const field of fields) {
    const text = texts[field.pointer] ?? defaultText(field);
    if (text.trim() === "") {
      isWhole &&= !isRequired(field);
      continue;
    }
    const parsed = parseTyped(field, text);
    if (parsed.ok) sheet[field.pointer.slice(1)] = parsed.value;
    else wrong[field.pointer] = parsed.message;
  }
  return { sheet: isWhole && Object.keys(wrong).length === 0 ? sheet : null, wrong };
}

/** The scenario's vehicle as the half-car would have it. */
function useVehicleOf(half: HalfCarAnswer | null) {
  const form = useForm();
  const group = findMember(form, VEHICLE);
  return useMemo(
    () => (half && group ? getAt(completed(group, { vehicle: half.vehicle }), VEHICLE) : undefined),
    [half, group],
  );
}

/** What the whole car weighs [kg]. */
const totalOf = (sheet: Sheet) => (sheet.front_axle_load ?? 0) + (sheet.rear_axle_load ?? 0);

interface OutcomeProps {
  readonly half: HalfCarAnswer;
  readonly vehicle: JsonObject;
  readonly total: number;
}

/** The fields that it gives, beside what they are now; sag and frequencies, and what is odd about them. */
function Outcome({ half, vehicle, total }: OutcomeProps) {
  const group = findMember(useForm(), VEHICLE) as Group;
  const now = useFromScenario((scenario) => getAt(scenario, VEHICLE));
  const rows = leavesOf(group).flatMap((leaf) => {
    if (leaf.kind !== "number") return [];
    const [from, to] = [now, vehicle].map((values) => getAt({ vehicle: values ?? null }, leaf.pointer));
    if (typeof to !== "number" || (from === to && to === leaf.paperValue)) return [];
    return [
      {
        leaf,
        from: typeof from === "number" ? valueText(leaf, rounded(from)) : "none",
        to: valueText(leaf, rounded(to)),
      },
    ];
  });
  return (
    <Stack gap="sm" mt="md" className={classes.outcome ?? ""}>
      {half.cautions.map(({ kind, text }) => (
        <Caution key={kind} text={text} />
      ))}
      <DataTable
        label={`What becomes of a car of ${formatExact(total, "kg")}: one track of two`}
        captioned
        height={TABLE_HEIGHT}
        attributes={{ "data-dense": true, style: { fontSize: "var(--mantine-font-size-xs)" } }}
        rows={rows}
        rowKey={({ leaf }) => leaf.pointer}
        columns={[
          {
            key: "field",
            head: "",
            text: true,
            cell: ({ leaf }) => `${leaf.title}${leaf.note ? `, ${leaf.note}` : ""}`,
          },
          { key: "now", head: "Now", cell: ({ from }) => from },
          { key: "sheet", head: "From the data sheet", cell: ({ to }) => to },
        ]}
      />
      <CharacteristicsTable of={half.characteristics} />
    </Stack>
  );
}

const DIGITS = 5;
const rounded = (value: number) => Number(value.toPrecision(DIGITS));
