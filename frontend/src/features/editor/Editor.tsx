/** The form: essentials open, the rest in sections. */

import { Accordion, Badge, Box, Button, Text, TextInput } from "@mantine/core";
import { memo, useEffect, useMemo, useState } from "react";
import { useEdit, useFromScenario, useLab, useReadOnly } from "../../lab/context";
import classes from "./editor.module.css";
import { changedPointers, resetMember } from "../../scenario/differences";
import { matching, sections, type Section } from "./layout";
import { focusField, revealed } from "../../lab/reveal";
import { useStore } from "../../lib/store";
import { Members } from "./Members";
import type { Pointer } from "../../scenario/path";
import type { Group } from "../../scenario/schema";
import { IconSearch } from "../../ui/icons";
import { Fault } from "../../ui/Fault";
import { BumpDrawing } from "./BumpDrawing";
import { VehicleChoice } from "./VehicleChoice";

const [VEHICLE, BUMP] = ["/vehicle", "/road/bump"];

export function Editor({ form }: { readonly form: Group }) {
  const edit = useEdit();
  const readOnly = useReadOnly();
  const rejected = useLab((state) => state.rejected);
  const refused = useLab((state) => state.refused);
  const all = useMemo(() => sections(form), [form]);
  const [opened, setOpened] = useState(() => all.filter(({ essential }) => essential).map(({ key }) => key as string));

  const [search, setSearch] = useState("");
  const searching = search.trim() !== "";
  const found = useMemo(
    () => (searching ? all.flatMap((section) => matching(section, search) ?? []) : all),
    [all, search, searching],
  );
  const sought = useStore(revealed);
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
  const forced = found.filter((section) => searching || contains(section, wrong)).map(({ key }) => key as string);
  const changed = useFromScenario((scenario) => changedPointers(scenario, form).length);

  return (
    <div className={classes.editor} data-scenario data-read-only={readOnly || undefined}>
      <div className={classes.summary}>
        <Text size="sm" c="dimmed">
          {changed === 0
            ? "The paper’s scenario"
            : `${changed} ${changed === 1 ? "value differs" : "values differ"} from the paper`}
        </Text>
        {!readOnly && (
          <Button
            size="compact-xs"
            variant="subtle"
            disabled={changed === 0}
            data-testid="reset-all"
            onClick={() => {
              for (const pointer of Object.keys(rejected)) edit.accept(pointer as Pointer);
              edit.commit(resetMember(edit.newest(), form));
            }}
          >
            Reset all
          </Button>
        )}
      </div>
      <TextInput
        size="xs"
        p="0 0.75rem 0.5rem 1rem"
        aria-label="Find a field"
        placeholder="Find a field"
        autoComplete="off"
        leftSection={<IconSearch size={14} />}
        value={search}
        onChange={(event) => setSearch(event.currentTarget.value)}
        onKeyDown={(event) => {
          if (event.key === "Escape") setSearch("");
        }}
      />
      {found.length === 0 && (
        <Text p="0.3rem 1rem" fz="0.8125rem" c="dimmed">
          No field has this name.
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
        classNames={{
          item: classes.item ?? "",
          control: classes.control ?? "",
          label: classes.controlLabel ?? "",
          content: classes.content ?? "",
        }}
        transitionDuration={0}
      >
        {found.map((section) => (
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
        <Box component="span" fw={600} fz="sm">
          {section.title}
        </Box>
        {changed > 0 && (
          <Badge size="sm" variant="light" className={classes.badge ?? ""}>
            {changed} changed
          </Badge>
        )}
      </Accordion.Control>
      <Accordion.Panel>
        {isOpen && section.key === VEHICLE && (
          <VehicleChoice group={{ ...section, kind: "group", pointer: section.key }} />
        )}
        {isOpen && section.key === BUMP && <BumpDrawing members={section.members} />}
        {isOpen && <Members members={section.members} />}
      </Accordion.Panel>
    </Accordion.Item>
  );
});
