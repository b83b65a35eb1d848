/** Who slows down for the bump: each strategy as it controls, or all alike, so that only the suspensions differ. */

import { NativeSelect, Tooltip } from "@mantine/core";
import { getAt, setAt } from "../../scenario/path";
import { useEdit, useFromScenario, useReadOnly } from "../../lab/context";
import classes from "./compare.module.css";

const POLICY = "/speed/policy";

const CHOICES = [
  { value: "by_strategy", label: "By strategy" },
  { value: "planned", label: "All" },
  { value: "constant", label: "Nobody" },
];

export function SpeedSelect() {
  const edit = useEdit();
  const readOnly = useReadOnly();
  const policy = useFromScenario((scenario) => getAt(scenario, POLICY));
  return (
    <Tooltip
      label="At equal speed, the remaining difference comes from the suspension"
      multiline
      w={240}
      openDelay={500}
    >
      <label className={classes.choice}>
        Who slows down
        <NativeSelect
          size="xs"
          disabled={readOnly}
          value={typeof policy === "string" ? policy : "by_strategy"}
          data={CHOICES}
          onChange={({ currentTarget: { value } }) => edit.commit(setAt(edit.newest(), POLICY, value))}
        />
      </label>
    </Tooltip>
  );
}
