/** The form: essentials open, the rest in sections. */

import { Accordion, Badge, Box, Button, Group as Row, Stack, Text, TextInput } from "@mantine/core";
import { memo, useEffect, useMemo, useState } from "react";
import { focusField, revealed, useAction, useActionButton } from "../../lab/actions";
import { useEdit, useFromScenario, useLab, useReadOnly } from "../../lab/context";
import classes from "./editor.module.css";
import { changedPointers, leavesOf, resetMember, type Leaf, OWN, completed } from "../../scenario/differences";
import { useSelector } from "@tanstack/react-store";
import { Members } from "./Members";
import { hasWords, wordsOf } from "../../lib/search";
import { type Pointer, getAt, sameValue, setAt } from "../../scenario/path";
import { type Group, findMember, optionTitle, type Member } from "../../scenario/schema";
import { Icon } from "../../ui/icons";
import { Fault } from "../../ui/Messages";
import { unitWords } from "../../units/quantity";
import { BumpDrawing } from "./BumpDrawing";
import { useQuery } from "@tanstack/react-query";
import { type JsonObject } from "../../api/types";
import { useExportItem } from "../library/open";
import { OpenFiles } from "../library/OpenFiles";
import { dialog, useItems } from "../../scenario/library";
import { vehiclesQuery } from "../../server/queries";
import { CharacteristicsTable } from "./CharacteristicsTable";
import { Choice, labelled } from "../../ui/Entry";

/** The options of controllers of one's own; each has a section of its own, there while the controller is chosen. */
const isLaw = (pointer: Pointer) => pointer.startsWith(OWN);

const [VEHICLE, BUMP] = ["/vehicle", "/road/bump"];
/** What the section says of the vehicle as a whole. */
const VEHICLE_WORDS = "car natural frequencies damping ratios static sag data sheet total mass axle loads";

export function Editor({ form }: { readonly form: Group }) {
  const edit = useEdit();
  const readOnly = useReadOnly();
  const rejected = useLab((state) => state.invalidInput);
  const refused = useLab((state) => state.serverErrors);
  const switchedOn = useLab((state) => state.strategies);
  const all = useMemo(
    () => sections(form).filter(({ key }) => !isLaw(key) || switchedOn.some((id) => key === `${OWN}${id}`)),
    [form, switchedOn],
  );
  const [opened, setOpened] = useState(() => essentials(form));

  const [search, setSearch] = useState("");
  const searching = search.trim() !== "";
  const { sourced, own } = useVehicles();
  const vehicles = [...sourced, ...own].map(({ label }) => `${label} ${VEHICLE_WORDS}`);
  const shownSections = searching ? foundIn(all, search, { [VEHICLE]: vehicles }) : all;
  const sought = useSelector(revealed);
  const itsSection = sought && all.find((section) => contains(section, [sought]))?.key;
  if (itsSection && !opened.includes(itsSection)) setOpened([...opened, itsSection]);
  if (sought && searching) setSearch("");
  useEffect(() => {
    if (sought === null) return;
    focusField(sought);
    revealed.set(null);
  }, [sought]);

  const wrong = [...Object.keys(rejected), ...Object.keys(refused.fields)] as Pointer[];
  // A section with an error is open whatever was clicked: an error nobody sees helps nobody.
  const forced = shownSections
    .filter((section) => searching || contains(section, wrong))
    .map(({ key }) => key as string);
  const changed = useFromScenario((scenario) => changedPointers(scenario, form).length);
  const resetAll = () => {
    for (const pointer of Object.keys(rejected)) edit.clearInvalid(pointer as Pointer);
    edit.commit(resetMember(edit.newest(), form));
  };
  useAction("reset", readOnly || changed === 0 ? null : resetAll);
  const { label: resetLabel, ...resetButton } = useActionButton("reset");

  return (
    <div className={classes.editor} data-scenario data-read-only={readOnly || undefined}>
      <Row justify="space-between" wrap="nowrap" h="2.5rem" p="0.25rem 0.75rem 0.25rem 1rem">
        <Text c="dimmed" truncate>
          {changed === 0
            ? "The paper’s scenario"
            : `${changed} ${changed === 1 ? "value differs" : "values differ"} from the paper`}
        </Text>
        {!readOnly && (
          <Button size="compact-xs" variant="subtle" data-testid="reset-all" {...resetButton}>
            {resetLabel}
          </Button>
        )}
      </Row>
      <TextInput
        p="0 0.75rem 0.5rem 1rem"
        aria-label="Find a field"
        placeholder="Find a field"
        autoComplete="off"
        leftSection={<Icon name="Search" size={14} />}
        value={search}
        onChange={(event) => setSearch(event.currentTarget.value)}
        onKeyDown={(event) => {
          if (event.key !== "Escape" || search === "") return;
          event.preventDefault(); // it closes nothing else
          setSearch("");
        }}
      />
      {shownSections.length === 0 && (
        <Text p="0.3rem 1rem" fz="sm" c="dimmed">
          No field, option, unit or help text has these words.
        </Text>
      )}
      {refused.general.length > 0 && (
        <Fault px="md" pb="xs">
          {refused.general.join(". ")}
        </Fault>
      )}
      <Accordion
        multiple
        chevronPosition="left"
        variant="default"
        order={2}
        value={[...new Set([...opened, ...forced])]}
        onChange={(next) => !searching && setOpened(next)}
        styles={{
          item: { borderColor: "var(--line)" },
          control: { paddingInline: "0.75rem", minHeight: "2.5rem" },
          label: { display: "flex", alignItems: "center", gap: "0.5rem", paddingBlock: "0.4rem" },
          content: { padding: "0.1rem 1rem 0.9rem" },
        }}
        transitionDuration={0}
      >
        {shownSections.map((section) => (
          <SectionItem
            key={section.key}
            section={section}
            isOpen={opened.includes(section.key) || forced.includes(section.key)}
          />
        ))}
      </Accordion>
    </div>
  );
}

/** What opens by itself, the options of controllers that are not chosen yet included. */
const essentials = (form: Group): readonly string[] =>
  sections(form)
    .filter(({ essential }) => essential)
    .map(({ key }) => key);

function contains(section: Section, pointers: readonly Pointer[]): boolean {
  return pointers.some((pointer) =>
    section.members.some((member) => pointer === member.pointer || pointer.startsWith(`${member.pointer}/`)),
  );
}

interface ItemProps {
  readonly section: Section;
  readonly isOpen: boolean;
}

const SectionItem = memo(function SectionItem({ section, isOpen }: ItemProps) {
  const changed = useFromScenario(
    (scenario) => section.members.flatMap((member) => changedPointers(scenario, member)).length,
  );
  return (
    <Accordion.Item value={section.key}>
      <Accordion.Control>
        <Box component="span" fw={600} fz="md">
          {section.title}
        </Box>
        {changed > 0 && (
          <Badge size="sm" variant="light" flex="none" tt="none">
            {changed} changed
          </Badge>
        )}
      </Accordion.Control>
      <Accordion.Panel>
        {isOpen && (
          <Stack gap="0.6rem">
            {section.key === VEHICLE && <VehicleChoice group={section.whole} />}
            {section.key === BUMP && <BumpDrawing members={section.members} />}
            <Members members={section.members} />
          </Stack>
        )}
      </Accordion.Panel>
    </Accordion.Item>
  );
});

/** What most people come to change. */
const ESSENTIALS: readonly Pointer[] = ["/road/bump", "/speed", "/mpc/stage_weights"];

/** Which parts of the schema stand first, and how the rest falls into sections. */
export interface Section {
  readonly key: Pointer;
  readonly title: string;
  readonly essential: boolean;
  /** Those that are shown: not all of them where the form is searched. */
  readonly members: readonly Member[];
  readonly whole: Group;
}

function section(group: Group, essential: boolean): Section {
  const { pointer, title, members } = group;
  return { key: pointer, title, essential, members, whole: group };
}

function without(group: Group, pointers: readonly Pointer[]): Group {
  const members = group.members
    .filter((member) => !pointers.includes(member.pointer))
    .map((member) => (member.kind === "group" ? without(member, pointers) : member))
    .filter((member) => member.kind !== "group" || member.members.length > 0);
  return { ...group, members };
}

/** Essentials first, then every top-level part with what is left of it; nothing of the schema is lost. */
export function sections(form: Group): readonly Section[] {
  const first = ESSENTIALS.map((pointer) => findMember(form, pointer)).filter((member) => member?.kind === "group");
  const rest = without(form, ESSENTIALS).members;
  const loose = rest.filter((member) => member.kind !== "group");
  const groups = rest
    .filter((member) => member.kind === "group")
    .flatMap((group) =>
      `${group.pointer}/` === OWN ? group.members.filter((member) => member.kind === "group") : [group],
    );
  return [
    ...first.map((group) => section(group, true)),
    ...groups.filter(({ pointer }) => isLaw(pointer)).map((group) => section(group, true)),
    ...groups.filter(({ pointer }) => !isLaw(pointer)).map((group) => section(group, false)),
    ...(loose.length > 0
      ? [section({ kind: "group", pointer: "/", title: "Other", description: "", members: loose }, false)]
      : []),
  ];
}

/** What a section offers as a whole, by name: vehicles. */
type Offers = Readonly<Record<Pointer, readonly string[]>>;

/** Fields and what a section offers by name; where none has the words, fields by options, units and help texts. */
export function foundIn(all: readonly Section[], text: string, offers: Offers = {}): readonly Section[] {
  const words = wordsOf(text);
  const isOffered = ({ key }: Section) => offers[key]?.some((name) => hasWords(name, words));
  const named = all.flatMap(
    (section) => matching(section, text) ?? (isOffered(section) ? [{ ...section, members: [] }] : []),
  );
  return named.length > 0 ? named : all.flatMap((section) => matching(section, text, textsOf) ?? []);
}

/** What is left of a section where every word has to stand in a field's name, in the names of the parts it lies in, in what it may be looked for by, or in what else it says. */
export function matching(section: Section, text: string, more: (leaf: Leaf) => string = () => ""): Section | null {
  const members = withWords(section.members, section.title, wordsOf(text), more);
  return members.length === 0 ? null : { ...section, members };
}

/** A field's options, unit and help text. */
function textsOf(leaf: Leaf): string {
  const options = leaf.kind === "choice" ? leaf.options.map(optionTitle).join(" ") : "";
  const units = leaf.kind === "number" ? unitWords(leaf.unit) : "";
  return `${options} ${units} ${leaf.description}`;
}

function withWords(
  members: readonly Member[],
  parts: string,
  words: readonly string[],
  more: (leaf: Leaf) => string,
): readonly Member[] {
  return members.flatMap((member): readonly Member[] => {
    const inside = `${parts} ${member.title}`;
    if (member.kind === "group") {
      const below = withWords(member.members, inside, words, more);
      return below.length === 0 ? [] : [{ ...member, members: below }];
    }
    const entries = member.kind === "vector" ? member.items.map(({ title }) => title).join(" ") : "";
    const texts = `${member.kind === "vector" ? member.description : ""} ${leavesOf(member).map(more).join(" ")}`;
    const names = `${inside} ${entries} ${member.pointer.slice(1).replace(/\//g, ".")} ${texts}`;
    return hasWords(names, words, member.searchWords) ? [member] : [];
  });
}

/** Those with sources, and those of the library. */
function useVehicles() {
  const sourced = useQuery(vehiclesQuery).data ?? [];
  const own = useItems("vehicle").map(({ name, value }) => ({ id: `own ${name}`, label: name, vehicle: value }));
  return { sourced, own };
}

const PAPER = { id: "paper", label: "The paper\u2019s", vehicle: {} };
const OTHER = "";

function VehicleChoice({ group }: { readonly group: Group }) {
  const edit = useEdit();
  const exportItem = useExportItem();
  const readOnly = useReadOnly();
  const vehicle = useFromScenario((scenario) => getAt(scenario, group.pointer));
  const { sourced, own } = useVehicles();
  const whole = (values: JsonObject) => getAt(completed(group, { vehicle: values }), group.pointer);
  const choices = [PAPER, ...sourced, ...own];
  const current = choices.find((each) => sameValue(whole(each.vehicle), vehicle));
  const source = sourced.find((each) => each === current);

  const choose = (id: string) => {
    const choice = choices.find((each) => each.id === id);
    const next = choice && whole(choice.vehicle);
    if (next !== undefined && !sameValue(next, vehicle)) edit.commit(setAt(edit.newest(), group.pointer, next));
  };
  const save = () =>
    void exportItem({ kind: "vehicle", name: current?.label ?? "Own vehicle", value: vehicle as JsonObject });

  return (
    <Row gap="0.4rem">
      <Choice
        aria-label="Vehicle"
        flex="1 1 8rem"
        value={current?.id ?? OTHER}
        disabled={readOnly}
        data={[
          ...(current ? [] : [{ value: OTHER, label: "Own values" }]),
          ...labelled([PAPER, ...sourced]),
          ...(own.length > 0 ? [{ group: "Your vehicles", items: labelled(own) }] : []),
        ]}
        onPick={choose}
      />
      {!readOnly && <DataSheetButton />}
      {!readOnly && (
        <OpenFiles name="Vehicle file" wanted="vehicle">
          Open file
        </OpenFiles>
      )}
      <Button size="compact-xs" onClick={save}>
        Save file
      </Button>
      {!readOnly && (
        <Button size="compact-xs" onClick={() => dialog.set("vehicle")}>
          Save in the library
        </Button>
      )}
      {source && (
        <Text size="xs" mt={4} c="dimmed" title={source.sources.join("\n")}>
          {source.description} {source.sources[0]}
        </Text>
      )}
      <VehicleFacts pointer={group.pointer} />
    </Row>
  );
}

function DataSheetButton() {
  const { label, ...button } = useActionButton("dataSheet");
  return (
    <Button size="compact-xs" {...button}>
      {label}
    </Button>
  );
}

/** What the vehicle’s values come to: of the newest answer, which is of the values before while a slider moves on. */
function VehicleFacts({ pointer }: { readonly pointer: Pointer }) {
  const of = useLab(({ shown }) => shown?.characteristics);
  const clearance = useFromScenario((scenario) => getAt(scenario, `${pointer}/bump_stop_clearance`));
  if (!of) return null;
  return (
    <Box flex="1 0 calc(100% + 1.8rem)" mx="-0.9rem">
      <CharacteristicsTable of={of} clearance={typeof clearance === "number" ? clearance : null} />
    </Box>
  );
}
