/** The rules as a table: a row for each set of the distance, a column for each of the speed error, the torque in between. */

import { NativeSelect } from "@mantine/core";
import { useEdit, useReadOnly } from "../../lab/context";
import classes from "./fuzzy.module.css";
import { conclusions, withConclusion, type Rewritten, type RuleBase } from "./ruleBase";

interface Props {
  readonly base: RuleBase;
  readonly rewritten: Rewritten;
}

const NO_RULE = "";
const nameOf = (set: string | null) => set ?? "any";

export function RulesTable({ base, rewritten }: Props) {
  const [edit, readOnly] = [useEdit(), useReadOnly()];
  const [rows, columns] = [base.distance, base.speed_error].map((sets) => [...sets.map(({ name }) => name), null]);
  return (
    <div className={classes.scrolled}>
      <table className={classes.rules} aria-label="Rules: the torque for each distance and speed error">
        <thead>
          <tr>
            <th scope="col">distance ↓ error →</th>
            {columns?.map((name) => (
              <th key={nameOf(name)} scope="col">
                {nameOf(name)}
              </th>
            ))}
          </tr>
        </thead>
        <tbody>
          {rows?.map((distance) => (
            <tr key={nameOf(distance)}>
              <th scope="row">{nameOf(distance)}</th>
              {columns?.map((speed_error) => {
                const cell = { speed_error, distance };
                const then = conclusions(base, cell);
                const several = then.length > 1 ? [{ value: "several", label: then.join(", "), disabled: true }] : [];
                return (
                  <td key={nameOf(speed_error)}>
                    {(distance !== null || speed_error !== null) && (
                      <NativeSelect
                        size="xs"
                        aria-label={`Distance ${nameOf(distance)}, speed error ${nameOf(speed_error)}`}
                        disabled={readOnly}
                        value={several[0]?.value ?? then[0] ?? NO_RULE}
                        data={[{ value: NO_RULE, label: "–" }, ...base.torque.map(({ name }) => name), ...several]}
                        onChange={({ currentTarget: { value } }) =>
                          edit.commit(
                            rewritten(edit.newest(), (before) =>
                              withConclusion(before, cell, value === NO_RULE ? null : value),
                            ),
                          )
                        }
                      />
                    )}
                  </td>
                );
              })}
            </tr>
          ))}
        </tbody>
      </table>
    </div>
  );
}
