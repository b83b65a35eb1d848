/** The sets of one variable as curves; the selected one's points are dragged, or typed. */

import { Button, Group, NativeSelect, TextInput } from "@mantine/core";
import { useState } from "react";
import type { FieldError as Refused } from "../../api/problem";
import type { FuzzySet, FuzzyVariable } from "../../api/types";
import { useEdit, useReadOnly } from "../../lab/context";
import { EditableCurves } from "../../plots/EditableCurves";
import { child } from "../../scenario/path";
import { formatExact } from "../../units/format";
import { FieldError } from "../editor/FieldFrame";
import { PartEntry } from "../editor/PartEntry";
import classes from "./fuzzy.module.css";
import { argumentsOf, converted, FUNCTIONS, moved, pointsOf, withCorner } from "./functions";
import { setPointer, TITLES, withNewSet, withSet, type Rewritten, type RuleBase, type Variable } from "./ruleBase";

interface Props {
  readonly variable: Variable;
  readonly base: RuleBase;
  /** As the service draws it. */
  readonly drawn: FuzzyVariable;
  readonly errors: readonly Refused[];
  readonly rewritten: Rewritten;
}

/** No two places are nearer to each other than this part of the universe, where they must not coincide. */
const NEAREST = 1e-3;
const FARTHEST = 10_000;

export function SetsEditor({ variable, base, drawn, errors, rewritten }: Props) {
  const [edit, readOnly] = [useEdit(), useReadOnly()];
  const [picked, setPicked] = useState(0);
  const sets = base[variable];
  const selected = Math.min(picked, sets.length - 1);
  const set = sets[selected];
  const end = drawn.universe.at(-1) ?? 1;
  if (!set) return null;
  const pointer = setPointer(variable, selected);
  const error = errors.find((each) => each.pointer.startsWith(`/scenario${pointer}`))?.message;
  const places = pointsOf(set);
  const replaced = (next: FuzzySet | null) =>
    rewritten(edit.newest(), (before) => withSet(before, variable, selected, next));
  return (
    <>
      <EditableCurves
        label={`Sets of the ${TITLES[variable].toLowerCase()}`}
        height={150}
        xRange={[0, end]}
        yRange={[0, 1]}
        curves={sets.map(({ name }, index) => ({ name, x: drawn.universe, y: drawn.memberships[index] ?? [] }))}
        points={places.map((place) => ({ ...place, text: formatExact(place.x, drawn.unit) }))}
        onChoose={setPicked}
        onMove={(point, x) => edit.drag(replaced(moved(set, places[point]?.index ?? 0, x, NEAREST * end)))}
        onRelease={() => edit.commit(edit.newest())}
        {...{ selected, readOnly }}
      />
      <div className={classes.fields} data-pointer={pointer}>
        <NativeSelect
          label="Set"
          value={selected}
          data={sets.map(({ name }, index) => ({ value: String(index), label: name }))}
          onChange={({ currentTarget: { value } }) => setPicked(Number(value))}
        />
        <SetName
          key={`${selected} ${set.name}`}
          name={set.name}
          onRename={(name) => edit.commit(replaced({ ...set, name }))}
        />
        <NativeSelect
          label="Function"
          value={set.function}
          disabled={readOnly}
          data={Object.entries(FUNCTIONS).map(([value, { title }]) => ({ value, label: title }))}
          onChange={({ currentTarget: { value } }) =>
            edit.commit(replaced(converted(set, value, drawn.universe, drawn.memberships[selected] ?? [])))
          }
        />
        {argumentsOf(set).map(({ name, at }, index) => (
          <PartEntry
            key={`${selected} ${name}`}
            {...{ name, error }}
            range={[0, end]}
            farthest={FARTHEST}
            pointer={child(child(pointer, "corners"), index)}
            unit={at === undefined ? "1" : drawn.unit}
            value={set.corners[index]}
            written={(value) => replaced(withCorner(set, index, value))}
          />
        ))}
      </div>
      <FieldError id={pointer} error={error} />
      {!readOnly && (
        <Group gap="xs">
          <Button
            size="compact-sm"
            onClick={() => {
              edit.commit(rewritten(edit.newest(), (before) => withNewSet(before, variable, end)));
              setPicked(sets.length);
            }}
          >
            Add a set
          </Button>
          <Button size="compact-sm" disabled={sets.length === 1} onClick={() => edit.commit(replaced(null))}>
            Remove {set.name} and its rules
          </Button>
        </Group>
      )}
    </>
  );
}

function SetName({ name, onRename }: { readonly name: string; readonly onRename: (name: string) => void }) {
  const [typed, setTyped] = useState(name);
  const readOnly = useReadOnly();
  const rename = () => {
    if (typed !== name) onRename(typed);
  };
  return (
    <TextInput
      label="Name"
      value={typed}
      maxLength={30}
      disabled={readOnly}
      onChange={(event) => setTyped(event.currentTarget.value)}
      onBlur={rename}
      onKeyDown={(event) => {
        if (event.key === "Enter") rename();
      }}
    />
  );
}
