/** What is compared with what: the choice, and in words what differs. */

import { Box, Checkbox, Group, NativeSelect } from "@mantine/core";
import { useQuery } from "@tanstack/react-query";
import { changedFields, changesText } from "../../scenario/differences";
import { againstVariant, whyNotCompared, type Against } from "../../lab/compare";
import { useLabContext } from "../../lab/context";
import { schemaQuery } from "../../server/queries";
import type { Scene } from "../../lab/resultView";
import classes from "./compare.module.css";
import { PinButton } from "./PinButton";
import { PinList } from "./PinList";
import { SpeedSelect } from "./SpeedSelect";

const STRATEGY = "strategy:";

export function CompareBar({ scene }: { readonly scene: Scene }) {
  const { router } = useLabContext();
  return (
    <div className={classes.bar} data-unprinted>
      <AgainstSelect scene={scene} />
      <SpeedSelect />
      <Checkbox
        size="xs"
        label="Plot differences"
        checked={scene.differences}
        onChange={({ currentTarget: { checked } }) => router.setView({ differences: checked })}
      />
      <PinButton />
      <Group gap="0.3rem 0.9rem" flex="1 1 100%" miw={0}>
        <PinList />
        <Differences scene={scene} />
      </Group>
    </div>
  );
}

function AgainstSelect({ scene: { strategies, pins, before, against, baseline } }: { readonly scene: Scene }) {
  const { router } = useLabContext();
  const variants = [
    ...(before ? [{ value: "before" satisfies Against, label: `B${before.name.slice(1)}` }] : []),
    ...pins.map((pin) => ({ value: againstVariant(pin), label: pin.name })),
  ];
  const selected =
    against === null ? `${STRATEGY}${baseline}` : against === before ? "before" : againstVariant(against);
  return (
    <label className={classes.choice}>
      Change against
      <NativeSelect
        size="xs"
        value={selected}
        onChange={({ currentTarget: { value } }) =>
          router.setView(
            value.startsWith(STRATEGY)
              ? { baseline: value.slice(STRATEGY.length), against: "baseline" }
              : { against: value as Against },
          )
        }
      >
        <optgroup label="Another strategy">
          {strategies.map(({ id, label }) => (
            <option key={id} value={`${STRATEGY}${id}`}>
              {label}
            </option>
          ))}
        </optgroup>
        {variants.length > 0 && (
          <optgroup label="The same strategy">
            {variants.map(({ value, label }) => (
              <option key={value} value={value}>
                {label}
              </option>
            ))}
          </optgroup>
        )}
      </NativeSelect>
    </label>
  );
}

/** Of the variant that changes are against, or of the state before the last edit. */
function Differences({ scene: { shown, before, against } }: { readonly scene: Scene }) {
  const form = useQuery(schemaQuery).data;
  const other = against ?? before;
  const changes = form && other ? changedFields(form, other.shown.scenario, shown.scenario) : [];
  const unlike = against && whyNotCompared(shown, against.shown);
  const all = changes.map(({ name, change }) => `${name} ${change}`).join("\n");
  return (
    <Box component="p" flex="1 1 12rem" miw={0} m={0} fz="xs" c="dimmed" title={all} data-testid="differences">
      {other === null
        ? "\u00a0"
        : `${other === before ? "Changed" : `Against ${other.name}`}: ${changesText(changes) || "the same scenario"}${unlike === null ? "" : `; that is ${unlike}, so no change is shown`}`}
    </Box>
  );
}
