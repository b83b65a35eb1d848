/** A line that says something: a note, a fault, the problems of a form. */

import { Alert, Text, type AlertProps, type TextProps, Group } from "@mantine/core";
import { type ComponentProps, type ReactNode } from "react";
import ui from "./ui.module.css";
import { Icon } from "./icons";

export function Fault({
  className = "",
  ...props
}: TextProps & { readonly className?: string; readonly id?: string; readonly children: ReactNode }) {
  return <Text size="xs" className={`${ui.error} ${className}`} role="alert" {...props} />;
}

/** What is said in small beside something. */
export const Note = (props: TextProps & Omit<ComponentProps<"p">, keyof TextProps>) => (
  <Text size="xs" c="dimmed" {...props} />
);

export function Problems({ messages, ...props }: AlertProps & { readonly messages: readonly string[] }) {
  return messages.map((message) => (
    <Alert key={message} color="red" variant="light" p="xs" role="alert" {...props}>
      {message}
    </Alert>
  ));
}

/** Something to beware of, with its sign. */
interface Props {
  readonly text: string;
}

export function Caution({ text }: Props) {
  return (
    <Group gap="0.3rem" wrap="nowrap" align="start" c="var(--worse)" data-testid="caution">
      <Icon name="AlertTriangle" size={14} style={{ flex: "none", marginTop: 2 }} />
      <Text size="xs">{text}</Text>
    </Group>
  );
}
