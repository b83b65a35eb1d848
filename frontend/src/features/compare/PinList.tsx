/** The state before the last edit and the pinned variants, each with its line in the plots and what can be done with it. */

import { Checkbox, Group, Menu, TextInput } from "@mantine/core";
import { useQueryClient } from "@tanstack/react-query";
import { IconChevronDown } from "../../ui/icons";
import { useOpenInLab } from "../../ui/useOpenInLab";
import { useReadOnly } from "../../lab/context";
import { LONGEST_NAME } from "../../scenario/library";
import { BEFORE_WIDTH, PIN_WIDTH, pinDash } from "../../plots/curves";
import { useSelector } from "@tanstack/react-store";
import { LineKey } from "../../ui/StrategyKey";
import classes from "./compare.module.css";
import {
  BEFORE_EDIT,
  beforeShown,
  showBefore,
  useBefore,
  ownPins,
  pinnedKey,
  usePins,
  type PinnedRun,
} from "./useCompared";
import ui from "../../ui/ui.module.css";

export function PinList() {
  const pins = usePins();
  const readOnly = useReadOnly();
  if (readOnly && pins.length === 0) return null;
  return (
    <Group
      component="ul"
      className={`${ui.list} ${classes.pins}`}
      gap="0.3rem 0.4rem"
      miw={0}
      aria-label={pins.length > 0 ? "Pinned results" : "Other results"}
    >
      {!readOnly && (
        <li>
          <BeforeSwitch />
        </li>
      )}
      {pins.map((pin, index) => (
        <li key={pin.run}>
          {readOnly ? (
            <span className={`${ui.pill} ${classes.pin}`}>
              <PinName pin={pin} index={index} />
            </span>
          ) : (
            <PinMenu pin={pin} index={index} />
          )}
        </li>
      ))}
    </Group>
  );
}

/** There before the first edit too, so that the table below never moves. */
function BeforeSwitch() {
  const before = useBefore();
  const isShown = useSelector(beforeShown);
  const name = before?.name ?? BEFORE_EDIT;
  return (
    <Checkbox
      classNames={{ root: ui.pill ?? "", label: ui.named ?? "" }}
      label={
        <>
          <LineKey width={BEFORE_WIDTH} /> {`B${name.slice(1)}`}
        </>
      }
      disabled={before === null}
      checked={isShown}
      onChange={({ currentTarget: { checked } }) => showBefore(checked)}
    />
  );
}

interface Props {
  readonly pin: PinnedRun;
  readonly index: number;
}

function PinName({ pin, index }: Props) {
  return (
    <>
      <LineKey width={PIN_WIDTH} dash={pinDash(index)} />
      <span className={classes.pinName}>{pin.name}</span>
      {pin.missing !== null && <span className={classes.missing}>({pin.missing})</span>}
    </>
  );
}

function PinMenu({ pin, index }: Props) {
  const queries = useQueryClient();
  const open = useOpenInLab();
  const rename = (name: string) => ownPins.rename(pin.run, name);
  return (
    <Menu position="bottom-start" width={260} withinPortal trapFocus>
      <Menu.Target>
        <button
          type="button"
          className={`${ui.pill} ${classes.pin}`}
          data-missing={pin.missing !== null || undefined}
          title={pin.missing === null ? pin.name : `${pin.name}: ${pin.missing}`}
        >
          <PinName pin={pin} index={index} />
          <IconChevronDown size={13} aria-hidden />
        </button>
      </Menu.Target>
      <Menu.Dropdown>
        <TextInput
          p={6}
          aria-label="Name"
          maxLength={LONGEST_NAME}
          defaultValue={pin.name}
          onBlur={(event) => rename(event.currentTarget.value)}
          onKeyDown={(event) => {
            event.stopPropagation(); // letters are not the menu's keys here
            if (event.key === "Enter") rename(event.currentTarget.value);
          }}
        />
        {pin.missing !== null && !pin.isGone && (
          <Menu.Item onClick={() => void queries.refetchQueries({ queryKey: pinnedKey(pin.run) })}>Try again</Menu.Item>
        )}
        <Menu.Item disabled={pin.isGone} onClick={() => open()({ id: pin.run })}>
          Open
        </Menu.Item>
        <Menu.Item onClick={() => ownPins.remove(pin.run)}>Unpin</Menu.Item>
      </Menu.Dropdown>
    </Menu>
  );
}
