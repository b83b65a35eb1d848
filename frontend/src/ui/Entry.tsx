/** A text that somebody types, most often a number, with its unit; and a choice among a few. */

import {
  NativeSelect,
  TextInput,
  type NativeSelectProps,
  type TextInputProps,
  ActionIcon,
  Box,
  Group,
  Select,
  type SelectProps,
} from "@mantine/core";
import { type ReactNode, useState } from "react";
import { prettyUnit } from "../units/format";
import ui from "./ui.module.css";
import { Icon } from "./icons";
import { Fault } from "./Messages";

interface EntryProps extends Omit<TextInputProps, "onChange" | "value" | "className"> {
  readonly value: string;
  readonly unit?: string | undefined;
  readonly className?: string | undefined;
  readonly onType: (text: string) => void;
}

export function Entry({ unit = "1", className = "", onType, ...props }: EntryProps) {
  const shown = prettyUnit(unit);
  const beside =
    shown === ""
      ? {}
      : {
          rightSection: <span className={ui.dim}>{shown}</span>,
          rightSectionWidth: 48,
          rightSectionPointerEvents: "none" as const,
        };
  return (
    <TextInput
      inputMode="decimal"
      className={className}
      {...beside}
      {...props}
      onChange={(event) => onType(event.currentTarget.value)}
    />
  );
}

interface ChoiceProps extends Omit<NativeSelectProps, "onChange" | "data"> {
  readonly data: NonNullable<NativeSelectProps["data"]>;
  readonly onPick: (value: string) => void;
}

export function Choice({ onPick, ...props }: ChoiceProps) {
  return <NativeSelect {...props} onChange={(event) => onPick(event.currentTarget.value)} />;
}

/** Choices side by side that scroll where there is no room for all. */
export const SCROLLED = { maw: "100%", style: { overflowX: "auto" } } as const;

/** Things with an id and a label, to choose from. */
export const labelled = (all: readonly { readonly id: string; readonly label: string }[]) =>
  all.map(({ id, label }) => ({ value: id, label }));

/** Values with a label each, to choose from. */
export const choicesOf = <Value extends string>(labels: Readonly<Record<Value, string>>) =>
  (Object.keys(labels) as Value[]).map((value) => ({ value, label: labels[value] }));

interface Props {
  readonly title: string;
  /** Its accessible name. */
  readonly name?: string;
  /** What is removed; the title where it is left out. */
  readonly removal?: string;
  readonly beside: ReactNode;
  readonly error: string | undefined;
  /** Left out where it cannot be removed. */
  readonly onRemove?: () => void;
  readonly children?: ReactNode;
}

/** An entry of a form's list: its title, what stands beside it, its own inputs and its error; it can be removed. */
export function EntryRow({ title, name = title, removal = title, beside, error, onRemove, children }: Props) {
  return (
    <Box
      p="0.4rem 0.5rem 0.5rem 0.7rem"
      bd={`1px solid var(--${error === undefined ? "line" : "danger"})`}
      bdrs={8}
      bg="var(--raised)"
      role="group"
      aria-label={name}
    >
      <Group gap="0.1rem 0.7rem" pos="relative" pr="1.8rem">
        <Box component="span" fz="md" fw={600}>
          {title}
        </Box>
        {beside}
        {onRemove && (
          <ActionIcon
            pos="absolute"
            top={0}
            right={0}
            size={24}
            variant="subtle"
            color="gray"
            aria-label={`Remove ${removal}`}
            onClick={onRemove}
          >
            <Icon name="X" size={15} />
          </ActionIcon>
        )}
      </Group>
      {children}
      {error !== undefined && <Fault>{error}</Fault>}
    </Box>
  );
}

interface FinderProps extends Omit<SelectProps, "onChange" | "value"> {
  readonly onPick: (value: string) => void;
}

/** Finds something by a part of its name and hands it on; it stays empty itself. */
export function Finder({ onPick, ...props }: FinderProps) {
  const [search, setSearch] = useState("");
  return (
    <Select
      searchable
      value={null}
      searchValue={search}
      onSearchChange={setSearch}
      maxDropdownHeight={300}
      {...props}
      onChange={(value) => {
        if (value === null) return;
        setSearch("");
        onPick(value);
      }}
    />
  );
}
