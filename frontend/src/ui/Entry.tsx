/** A text that somebody types, most often a number, with its unit; and a choice among a few. */

import { NativeSelect, TextInput, type NativeSelectProps, type TextInputProps } from "@mantine/core";
import { prettyUnit } from "../units/format";
import ui from "./ui.module.css";

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
      size="xs"
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
  return <NativeSelect size="xs" {...props} onChange={(event) => onPick(event.currentTarget.value)} />;
}

/** Things with an id and a label, to choose from. */
export const labelled = (all: readonly { readonly id: string; readonly label: string }[]) =>
  all.map(({ id, label }) => ({ value: id, label }));
