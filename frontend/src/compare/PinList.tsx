/** The pinned variants by name, each with its line in the plots and what can be done with it. */

import { Menu, TextInput } from "@mantine/core";
import { useQueryClient } from "@tanstack/react-query";
import { IconChevronDown } from "../icons";
import { useOpenInLab } from "../shell/useOpenInLab";
import { useReadOnly } from "../state/context";
import { LONGEST_NAME } from "../state/pins";
import { pinDash } from "../plots/layers";
import classes from "./compare.module.css";
import { ownPins, pinnedKey, usePins, type PinnedRun } from "./usePins";

export function PinList() {
  const pins = usePins();
  const readOnly = useReadOnly();
  if (pins.length === 0) return null;
  return (
    <ul className={classes.pins} aria-label="Pinned results">
      {pins.map((pin, index) => (
        <li key={pin.run}>{readOnly ? <span className={classes.pin}><PinName pin={pin} index={index} /></span> : <PinMenu pin={pin} index={index} />}</li>
      ))}
    </ul>
  );
}

interface Props {
  readonly pin: PinnedRun;
  readonly index: number;
}

function PinName({ pin, index }: Props) {
  return (
    <>
      <svg width="24" height="10" viewBox="0 0 24 10" aria-hidden>
        <line x1="1" x2="23" y1="5" y2="5" stroke="currentColor" strokeWidth="1.5" strokeDasharray={pinDash(index)} />
      </svg>
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
        <button type="button" className={classes.pin} data-missing={pin.missing !== null || undefined} title={pin.missing === null ? pin.name : `${pin.name}: ${pin.missing}`}>
          <PinName pin={pin} index={index} />
          <IconChevronDown size={13} aria-hidden />
        </button>
      </Menu.Target>
      <Menu.Dropdown>
        <TextInput
          size="xs"
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
        {pin.missing !== null && !pin.isGone && <Menu.Item onClick={() => void queries.refetchQueries({ queryKey: pinnedKey(pin.run) })}>Try again</Menu.Item>}
        <Menu.Item disabled={pin.isGone} onClick={() => open()({ id: pin.run })}>
          Open
        </Menu.Item>
        <Menu.Item onClick={() => ownPins.remove(pin.run)}>Unpin</Menu.Item>
      </Menu.Dropdown>
    </Menu>
  );
}
