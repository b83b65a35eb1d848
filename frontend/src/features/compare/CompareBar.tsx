/** What is compared with what: the choice, and in words what differs. */

import { Box, Checkbox, Group, Button, Menu, TextInput } from "@mantine/core";
import { changedFields, changesText, nameByChanges } from "../../scenario/differences";
import { referenceTo, whyNotCompared, type Reference } from "../../lab/compare";
import { useAction, useActionButton } from "../../lab/actions";
import { useLabContext, useLab, useEdit, useFromScenario, useReadOnly } from "../../lab/context";
import { useForm } from "../../server/useCatalogues";
import { type ResultView } from "../../lab/resultView";
import { Icon } from "../../ui/icons";
import { defaultName, MOST_PINS } from "../../lab/pins";
import { useSelector } from "@tanstack/react-store";
import {
  ownPins,
  BEFORE_EDIT,
  beforeShown,
  showBefore,
  useBefore,
  pinnedKey,
  usePins,
  type PinnedRun,
} from "./useCompared";
import { getAt, setAt } from "../../scenario/path";
import { findMember, optionOf, optionTitle } from "../../scenario/schema";
import { useQueryClient } from "@tanstack/react-query";
import { useOpenInLab } from "../../ui/openInLab";
import { LONGEST_NAME } from "../../scenario/library";
import { BEFORE_WIDTH, PIN_WIDTH, pinDash } from "../../plots/curves";
import { LineKey } from "../../ui/StrategyKey";
import ui from "../../ui/ui.module.css";
import { Choice } from "../../ui/Entry";
import { type Strategy } from "../../api/types";
import { isRecording } from "../../lib/recording";

const STRATEGY = "strategy:";
const BESIDE = { gap: "0.4rem", wrap: "nowrap", fz: "xs", c: "dimmed" } as const;

export function CompareBar({ resultView }: { readonly resultView: ResultView }) {
  const { labAddress } = useLabContext();
  const { differences } = resultView;
  useAction("differences", () => labAddress.setView({ differences: !differences }));
  const { label, onClick } = useActionButton("differences");
  return (
    <Group
      gap="0.3rem 0.9rem"
      p="0.4rem 0.9rem 0.3rem"
      style={{ borderBottom: "1px solid var(--line)" }}
      data-unprinted
    >
      <AgainstSelect resultView={resultView} />
      <SpeedSelect />
      <Checkbox label={label} checked={differences} onChange={onClick} />
      <PinButton />
      <Group gap="0.3rem 0.9rem" flex="1 1 100%" miw={0}>
        <PinList />
        <Differences resultView={resultView} />
      </Group>
    </Group>
  );
}

interface AgainstSelectProps {
  readonly resultView: ResultView;
}

function AgainstSelect({ resultView }: AgainstSelectProps) {
  const { pins, before, reference, baseline } = resultView;
  const { labAddress } = useLabContext();
  const variants = [
    ...(before ? [{ value: "before" satisfies Reference, label: `B${before.name.slice(1)}` }] : []),
    ...pins.map((pin) => ({ value: referenceTo(pin), label: pin.name })),
  ];
  const selected =
    reference === null ? `${STRATEGY}${baseline}` : reference === before ? "before" : referenceTo(reference);
  return (
    <Group component="label" {...BESIDE}>
      Change against
      <Choice
        value={selected}
        data={[
          {
            group: "Another strategy",
            items: possibleBaselines(resultView).map(({ id, label }) => ({ value: `${STRATEGY}${id}`, label })),
          },
          ...(variants.length > 0 ? [{ group: "The same strategy", items: variants }] : []),
        ]}
        onPick={(value) =>
          labAddress.setView(
            value.startsWith(STRATEGY)
              ? { baseline: value.slice(STRATEGY.length), reference: "baseline" }
              : { reference: value as Reference },
          )
        }
      />
    </Group>
  );
}

/** Of the variant that changes are against, or of the state before the last edit. */
function Differences({ resultView: { shown, before, reference } }: { readonly resultView: ResultView }) {
  const form = useForm();
  const other = reference ?? before;
  const changes = other ? changedFields(form, other.shown.scenario, shown.scenario) : [];
  const unlike = reference && whyNotCompared(shown, reference.shown);
  const all = changes.map(({ name, change }) => `${name} ${change}`).join("\n");
  return (
    <Box component="p" flex="1 1 12rem" miw={0} m={0} fz="xs" c="dimmed" title={all} data-testid="differences">
      {other === null
        ? "\u00a0"
        : `${other === before ? "Changed" : `Against ${other.name}`}: ${changesText(changes) || "the same scenario"}${unlike === null ? "" : `; that is ${unlike}, so no change is shown`}`}
    </Box>
  );
}

/** Keeps the shown result under a name, beside whatever comes next. */
function PinButton() {
  const { lab, paperScenario } = useLabContext();
  const form = useForm();
  const pins = useSelector(ownPins);
  const run = useLab(({ shown, stale, shared }) =>
    shown?.source === "exact" && !stale && !shared ? shown.runId : null,
  );
  const isPinned = pins.some((pin) => pin.run === run);
  const isFull = pins.length >= MOST_PINS;
  const pin = () => {
    const { shown } = lab.get();
    if (run === null || !shown) return;
    const differs = nameByChanges(changedFields(form, paperScenario, shown.scenario)) || "Paper’s scenario";
    ownPins.add({ name: defaultName(differs, pins), run });
  };
  useAction("pin", run === null || isPinned || isFull ? null : pin);
  const { label, ...button } = useActionButton("pin");
  const why = isPinned
    ? "Pinned: compared with whatever comes next"
    : isFull
      ? `At most ${MOST_PINS} results are pinned`
      : "Keeps this result here, to compare others with it";
  return (
    <Button data-hint={why} leftSection={<Icon name="Pin" size={15} />} {...button}>
      {label}
    </Button>
  );
}

const POLICY = "/speed/policy";

/** Each strategy's as it controls it, or all alike, so that only the suspensions differ: the form's field, at the table. */
function SpeedSelect() {
  const edit = useEdit();
  const readOnly = useReadOnly();
  const policy = useFromScenario((scenario) => getAt(scenario, POLICY));
  const field = findMember(useForm(), POLICY);
  if (field?.kind !== "choice") return null;
  return (
    <Group
      component="label"
      {...BESIDE}
      data-hint="Planned: all slow down for the bump. Constant: none does. At equal speed, the remaining difference comes from the suspension"
    >
      {field.title}
      <Choice
        disabled={readOnly}
        value={optionOf(policy)}
        data={field.options.map((value) => ({ value, label: optionTitle(value) }))}
        onPick={(value) => edit.commit(setAt(edit.newest(), POLICY, value))}
      />
    </Group>
  );
}

const WIDTH = { miw: 0, maw: "min(100%, 20rem)" };
const WRAPPED = { overflowWrap: "anywhere", textAlign: "left" } as const;

function PinList() {
  const pins = usePins();
  const readOnly = useReadOnly();
  if (readOnly && pins.length === 0) return null;
  return (
    <Group
      component="ul"
      className={ui.list ?? ""}
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
        <Box component="li" key={pin.run} {...WIDTH}>
          {readOnly ? (
            <Box component="span" className={ui.pill ?? ""} {...WIDTH}>
              <PinName pin={pin} index={index} />
            </Box>
          ) : (
            <PinMenu pin={pin} index={index} />
          )}
        </Box>
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
      <span style={WRAPPED}>{pin.name}</span>
      {pin.missing !== null && <span style={WRAPPED}>({pin.missing})</span>}
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
        <Box
          component="button"
          type="button"
          className={ui.pill ?? ""}
          {...WIDTH}
          {...(pin.missing !== null && { c: "dimmed" })}
          title={pin.missing === null ? pin.name : `${pin.name}: ${pin.missing}`}
        >
          <PinName pin={pin} index={index} />
          <Icon name="ChevronDown" size={13} />
        </Box>
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

/** The strategies that changes can refer to: those that are shown, and others of the result, which say that they are not. */
export function possibleBaselines({
  catalogue,
  ids,
  baseline,
  summaries,
  shown: { source },
}: Pick<ResultView, "catalogue" | "ids" | "baseline" | "summaries" | "shown">): readonly Pick<
  Strategy,
  "id" | "label"
>[] {
  const isToCome = (id: string) => source === "live" && isRecording(id) && !(id in summaries);
  return catalogue
    .filter(({ id }) => id in summaries || id === baseline)
    .map(({ id, label }) => ({
      id,
      label: ids.includes(id) || isToCome(id) ? label : `${label} (${id in summaries ? "hidden" : "failed"})`,
    }));
}
