/** What every field shares: its value and how it is changed; label, help, mark of a change and error around it. */

import { ActionIcon, Box, Group, Text } from "@mantine/core";
import { createContext, memo, use, useEffect, useRef, type ReactNode, useId } from "react";
import { Icon } from "../../ui/icons";
import { ManualLink } from "../../ui/ManualLink";
import { useEdit, useReadOnly, useFromScenario, useLab } from "../../lab/context";
import classes from "./editor.module.css";
import { type Leaf, valueAt } from "../../scenario/differences";
import { setAt, sameValue, type Pointer } from "../../scenario/path";
import { type Field, optionOf, optionTitle, optionValue, type ChoiceField } from "../../scenario/schema";
import { Choice } from "../../ui/Entry";
import type { JsonValue, Scenario } from "../../api/types";
import { Caution } from "../../ui/Messages";
import { dotted } from "../../scenario/fields";
import type { InvalidInput } from "../../lab/labState";
import { useForm, useStrategies } from "../../server/useCatalogues";
import { isUsed, unusedText } from "../../scenario/effect";

interface Props {
  readonly id: string;
  readonly field: Leaf;
  readonly leaf: LeafState;
  /** The paper's value as text. */
  readonly paperText: string;
  /** What stands at the right end of the label's row. */
  readonly aside?: ReactNode;
  readonly children?: ReactNode;
}

export function FieldFrame({ id, field, leaf: { changed, error, unused }, paperText, aside, children }: Props) {
  const { pointer, title } = field;
  const isSaidAbove = use(SaidAbove);
  return (
    <div
      className={classes.field}
      data-pointer={pointer}
      data-changed={changed || undefined}
      data-error={error !== undefined || undefined}
    >
      <Group gap="0.25rem" wrap={aside === undefined ? "nowrap" : "wrap"} mih={30}>
        <div className={classes.label} data-unused={unused !== undefined || undefined}>
          <label htmlFor={id} id={`${id}-label`}>
            {title}
          </label>
          {field.note && (
            <Text size="xs" lh={1.2} c="dimmed" data-testid="note">
              {field.note}
            </Text>
          )}
        </div>
        <Help field={field} />
        <Box component="span" flex={1} />
        <ResetButton {...{ field, paperText, changed }} />
        {aside}
      </Group>
      {children}
      {unused !== undefined && !isSaidAbove && <UnusedText>{unused}</UnusedText>}
      <FieldCautions pointer={pointer} />
      <FieldError id={id} error={error} />
    </div>
  );
}

/** What the newest answer says to beware of at a field. */
function FieldCautions({ pointer }: { readonly pointer: Pointer }) {
  const cautions = useLab((state) => state.shown?.cautions);
  return cautions
    ?.filter(({ field }) => field === dotted(pointer))
    .map(({ text }) => <Caution key={text} text={text} />);
}

/** Why a field, or several, have no effect. */
export function UnusedText({ children }: { readonly children: string }) {
  return (
    <Text size="xs" mt={4} c="dimmed" data-testid="unused">
      {children}
    </Text>
  );
}

/** Opens the manual where it says what the field is. */
export function Help({ field: { pointer, title, description } }: { readonly field: Field }) {
  return <ManualLink name={pointer.slice(1).replaceAll("/", ".")} label={title} text={description} />;
}

interface ResetProps {
  readonly field: Field;
  /** The paper's value as text. */
  readonly paperText: string;
  readonly changed: boolean;
}

// As it was while a slider moves.
/** Keeps its place while hidden, so nothing moves when a value first differs from the paper. */
export const ResetButton = memo(function ResetButton({ field, paperText, changed }: ResetProps) {
  const edit = useEdit();
  const disabled = useReadOnly() || !changed;
  const reset = () => {
    for (const { pointer } of field.kind === "vector" ? field.items : [field]) edit.clearInvalid(pointer);
    edit.commit(setAt(edit.newest(), field.pointer, field.paperValue));
  };
  return (
    <ActionIcon
      data-hint={`Differs from the paper (${paperText}). Reset`}
      flex="none"
      style={{ visibility: disabled ? "hidden" : "visible" }}
      variant="subtle"
      size={24}
      aria-label={`Reset ${field.title} to the paper's ${paperText}`}
      disabled={disabled}
      onClick={reset}
    >
      <Icon name="ArrowBackUp" size={15} stroke={1.8} />
    </ActionIcon>
  );
});

/** Comes into sight by itself: an error of the server may concern a field nobody is looking at. */
export function FieldError({ id, error }: { readonly id: string; readonly error: string | undefined }) {
  const ref = useRef<HTMLParagraphElement>(null);
  useEffect(() => {
    ref.current?.scrollIntoView({ block: "nearest" });
  }, [error]);
  if (error === undefined) return null;
  return (
    <Text ref={ref} mt={2} fz="xs" lh="1.35" c="var(--danger)" id={`${id}-error`} role="alert">
      {error}
    </Text>
  );
}

/** A choice between names. */
export function ChoiceFieldRow({ field, leaf }: { readonly field: ChoiceField; readonly leaf: LeafState }) {
  const id = useId();
  return (
    <FieldFrame
      {...{ id, field, leaf }}
      paperText={optionTitle(optionOf(field.paperValue))}
      aside={
        <Choice
          id={id}
          w={142}
          flex="none"
          value={optionOf(leaf.value)}
          disabled={leaf.readOnly}
          error={leaf.error !== undefined}
          data={field.options.map((value) => ({ value, label: optionTitle(value) }))}
          onPick={(value) => leaf.commit(optionValue(field, value))}
        />
      }
    />
  );
}

export type LeafState = ReturnType<typeof useValue> & {
  /** Why the field has no effect on any strategy that is shown. */
  readonly unused?: string;
};

export function useLeaf({ pointer, paperValue }: Leaf): LeafState {
  const value = useFromScenario((scenario) => valueAt(scenario, { pointer, paperValue }));
  const unused = useUnused([pointer]);
  const [form, strategies] = [useForm(), useStrategies()];
  const isUsable = useFromScenario((scenario) => strategies.some((each) => isUsed(each, pointer, { form, scenario })));
  const leaf = useValue(pointer, value, (scenario, next) => setAt(scenario, pointer, next));
  const changed = !sameValue(value, paperValue);
  // What others use may be meant for them; what nobody can use is switched on elsewhere first.
  return unused === null ? { ...leaf, changed } : { ...leaf, changed, readOnly: leaf.readOnly || !isUsable, unused };
}

/** Why fields have no effect on any strategy that is shown, where that is the same of all of them; else `null`. */
export function useUnused(pointers: readonly Pointer[]): string | null {
  const [form, strategies] = [useForm(), useStrategies()];
  const on = useLab((state) => state.strategies);
  const what = pointers.length > 1 ? "these" : "this";
  return useFromScenario((scenario) => {
    const [first = null, ...others] = pointers.map((each) =>
      unusedText({ form, scenario }, each, { strategies, on }, what),
    );
    return others.every((text) => text === first) ? first : null;
  });
}

/** Whether what surrounds a field says why it has no effect, of all its fields. */
export const SaidAbove = createContext(false);

type Written = (scenario: Scenario, next: JsonValue) => Scenario;

/** A value that is written in a way of its own. */
export function useValue(pointer: Pointer, value: JsonValue | undefined, written: Written) {
  const rejected = useLab((state) => state.invalidInput[pointer]);
  const refused = useLab((state) => state.serverErrors.fields[pointer]);
  const edit = useEdit();
  return {
    value,
    readOnly: useReadOnly(),
    changed: false,
    rejected,
    error: rejected?.message ?? refused,
    drag: (next: JsonValue) => {
      edit.clearInvalid(pointer);
      edit.drag(written(edit.newest(), next));
    },
    release: () => edit.commit(edit.newest()),
    commit: (next: JsonValue) => {
      edit.clearInvalid(pointer);
      const scenario = written(edit.newest(), next);
      if (!sameValue(scenario, edit.newest())) edit.commit(scenario);
    },
    reject: (next: InvalidInput) => edit.reject(pointer, next),
    clearInvalid: () => edit.clearInvalid(pointer),
  };
}
